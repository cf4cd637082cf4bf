#include "io/gltf_textures.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

namespace wrapatlas {
namespace {

constexpr std::uint64_t kRepeat = 10497;

/// Materials of the primitives that have the rewritten UV set, variants included.
std::set<std::uint64_t> materials_on_atlas(const GltfContents& contents) {
  std::set<std::uint64_t> materials;
  const auto add = [&](const Json& holder) {
    const Json* index = find_member(holder, "material");
    const auto number = index == nullptr ? std::nullopt : as_integer(*index);
    if (number) materials.insert(*number);
  };
  for (const GltfPrimitive& primitive : contents.primitives) {
    if (!primitive.has_texcoords) continue;
    const Json& json = primitive_json(contents.file.json, primitive);
    add(json);
    const Json* extensions = find_member(json, "extensions");
    const Json* variants =
        extensions == nullptr ? nullptr : find_member(*extensions, "KHR_materials_variants");
    if (variants == nullptr) continue;
    for (const Json& mapping : array_member(*variants, "mappings")) add(mapping);
  }
  return materials;
}

class Finder {
 public:
  Finder(std::string texcoord_name, std::size_t texture_count, std::vector<GltfTextureUse>& uses)
      : texcoord_name_(std::move(texcoord_name)), texture_count_(texture_count), uses_(uses) {}

  void find(const Json& value, const Json::json_pointer& where, bool on_atlas) {
    if (!value.is_object()) return;
    for (const auto& [key, member] : value.items()) {
      if (key == "extras" || !member.is_object()) continue;
      if (key.ends_with("exture")) add(member, where / key, on_atlas);
      find(member, where / key, on_atlas);
    }
  }

 private:
  void add(const Json& info, const Json::json_pointer& where, bool on_atlas) {
    const auto texture = integer_member(info, "index", texture_count_);
    if (!texture || *texture >= texture_count_) return;
    auto set = integer_member(info, "texCoord", 0);
    const Json* extensions = find_member(info, "extensions");
    const Json* transform =
        extensions == nullptr ? nullptr : find_member(*extensions, "KHR_texture_transform");
    if (transform != nullptr && set) set = integer_member(*transform, "texCoord", *set);
    const bool follows = on_atlas && set && fmt::format("TEXCOORD_{}", *set) == texcoord_name_;
    uses_.push_back({where, *texture, follows, transform != nullptr});
  }

  std::string texcoord_name_;
  std::size_t texture_count_;
  std::vector<GltfTextureUse>& uses_;
};

std::uint64_t wrap_of(const Json& sampler, const char* key) {
  return integer_member(sampler, key, kRepeat).value_or(kRepeat);
}

std::optional<std::uint64_t> sampler_of(const Json& json, std::uint64_t texture) {
  const Json* index = find_member(json["textures"][texture], "sampler");
  const auto number = index == nullptr ? std::nullopt : as_integer(*index);
  return number && *number < array_member(json, "samplers").size() ? number : std::nullopt;
}

class Samplers {
 public:
  Samplers(Json& json, Wrap wrap) : json_(json), wrap_(wrap) {}

  /// Whether the texture would look different elsewhere, were its sampler to repeat.
  [[nodiscard]] bool changes(std::uint64_t texture) const {
    const auto sampler = sampler_of(json_, texture);
    if (!sampler) return false;
    const Json& json = json_["samplers"][*sampler];
    return (wraps_u(wrap_) && wrap_of(json, "wrapS") != kRepeat) ||
           (wraps_v(wrap_) && wrap_of(json, "wrapT") != kRepeat);
  }

  void repeat(const std::set<std::uint64_t>& textures) {
    const std::set<std::uint64_t> shared = samplers_of_others(textures);
    for (const std::uint64_t texture : textures) {
      std::optional<std::uint64_t> sampler = sampler_of(json_, texture);
      if (!sampler) {
        sampler = default_sampler();
      } else if (changes(texture) && shared.count(*sampler) != 0) {
        sampler = clone_of(*sampler);
      }
      json_["textures"][texture]["sampler"] = *sampler;
      repeated_.insert(*sampler);
    }
    for (const std::uint64_t sampler : repeated_) {
      Json& json = json_["samplers"][sampler];
      json["wrapS"] = wraps_u(wrap_) ? kRepeat : wrap_of(json, "wrapS");
      json["wrapT"] = wraps_v(wrap_) ? kRepeat : wrap_of(json, "wrapT");
    }
  }

 private:
  std::uint64_t append(Json sampler) {
    Json& samplers = json_["samplers"];
    samplers.push_back(std::move(sampler));
    return samplers.size() - 1;
  }

  std::uint64_t default_sampler() {
    if (!default_) default_ = append(Json::object());
    return *default_;
  }

  std::uint64_t clone_of(std::uint64_t sampler) {
    const auto [found, fresh] = clones_.try_emplace(sampler, 0);
    if (fresh) found->second = append(Json(json_["samplers"][sampler]));
    return found->second;
  }

  [[nodiscard]] std::set<std::uint64_t> samplers_of_others(
      const std::set<std::uint64_t>& textures) const {
    std::set<std::uint64_t> samplers;
    for (std::uint64_t t = 0; t < json_["textures"].size(); ++t) {
      const auto sampler = textures.count(t) == 0 ? sampler_of(json_, t) : std::nullopt;
      if (sampler) samplers.insert(*sampler);
    }
    return samplers;
  }

  Json& json_;
  Wrap wrap_;
  std::optional<std::uint64_t> default_;
  std::map<std::uint64_t, std::uint64_t> clones_;
  std::set<std::uint64_t> repeated_;
};

}  // namespace

std::vector<GltfTextureUse> texture_uses(const GltfContents& contents) {
  const Json& json = contents.file.json;
  const std::set<std::uint64_t> on_atlas = materials_on_atlas(contents);
  std::vector<GltfTextureUse> uses;
  Finder finder(contents.texcoord_name, array_member(json, "textures").size(), uses);
  const Json& materials = array_member(json, "materials");
  for (std::size_t i = 0; i < materials.size(); ++i) {
    finder.find(materials[i], Json::json_pointer() / "materials" / i, on_atlas.count(i) != 0);
  }
  return uses;
}

void set_repeating_samplers(Json& json, const std::vector<GltfTextureUse>& uses, Wrap wrap) {
  if (wrap == Wrap::none) return;
  std::set<std::uint64_t> ours, others;
  for (const GltfTextureUse& use : uses) (use.follows_atlas ? ours : others).insert(use.texture);
  if (ours.empty()) return;

  Samplers samplers(json, wrap);
  std::map<std::uint64_t, std::uint64_t> clones;
  for (const std::uint64_t texture : std::set<std::uint64_t>(ours)) {
    if (others.count(texture) == 0 || !samplers.changes(texture)) continue;
    json["textures"].push_back(Json(json["textures"][texture]));
    clones[texture] = json["textures"].size() - 1;
    ours.erase(texture);
    ours.insert(clones[texture]);
  }
  for (const GltfTextureUse& use : uses) {
    const auto clone = clones.find(use.texture);
    if (use.follows_atlas && clone != clones.end()) json[use.where]["index"] = clone->second;
  }
  samplers.repeat(ours);
}

}  // namespace wrapatlas
