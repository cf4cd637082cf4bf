#include "io/gltf_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/file.h"
#include "io/gltf_references.h"
#include "io/gltf_shading.h"
#include "io/gltf_textures.h"

namespace wrapatlas {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";

std::vector<GltfTextureUse> uses_that_follow(const GltfContents& contents) {
  std::vector<GltfTextureUse> uses = texture_uses(contents);
  std::erase_if(uses, [](const GltfTextureUse& use) { return !use.follows_atlas; });
  return uses;
}

/// By the name of its place. What is not known is data, which is changed the least.
TextureRole role_of(std::string place) {
  std::transform(place.begin(), place.end(), place.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (place.ends_with("normaltexture")) return TextureRole::normals;
  for (const char* color :
       {"colortexture", "emissivetexture", "diffusetexture", "specularglossinesstexture"}) {
    if (place.ends_with(color)) return TextureRole::color;
  }
  return TextureRole::data;
}

Repeat repeat_of(const Json& sampler, const char* key) {
  constexpr std::uint64_t kClamp = 33071, kMirror = 33648;
  const auto mode = integer_member(sampler, key, 0);
  return mode == kClamp ? Repeat::clamp : mode == kMirror ? Repeat::mirror : Repeat::repeat;
}

/// offset + rotation * (scale * uv), counter-clockwise as one looks at the picture.
std::array<double, 6> matrix_of(const Json& transform) {
  const auto pair = [&](const char* key, double otherwise) {
    const Json& values = array_member(transform, key);
    const bool usable = values.size() == 2 && values[0].is_number() && values[1].is_number();
    return usable ? Vec2{values[0].get<double>(), values[1].get<double>()}
                  : Vec2{otherwise, otherwise};
  };
  const Json* angle = find_member(transform, "rotation");
  const double rotation = angle != nullptr && angle->is_number() ? angle->get<double>() : 0;
  const Vec2 offset = pair("offset", 0), scale = pair("scale", 1);
  const double c = std::cos(rotation), s = std::sin(rotation);
  return {c * scale.x, s * scale.y, offset.x, -s * scale.x, c * scale.y, offset.y};
}

TransferSource source_of(const Json& json, const GltfTextureUse& use) {
  TransferSource source;
  const auto& samplers = array_member(json, "samplers");
  const auto sampler = integer_member(json["textures"][use.texture], "sampler", samplers.size());
  if (sampler && *sampler < samplers.size()) {
    source.across = repeat_of(samplers[*sampler], "wrapS");
    source.down = repeat_of(samplers[*sampler], "wrapT");
  }
  if (use.transformed) source.matrix = matrix_of(json[use.where]["extensions"][kTransform]);
  return source;
}

constexpr std::string_view kMaterials = "/materials/";

/// Of a path that begins with it, as those of all uses do.
std::size_t material_of(const std::string& path) {
  return std::stoul(path.substr(kMaterials.size()));
}

class ImageReader {
 public:
  ImageReader(const GltfContents& contents, bool base_colors_alone)
      : contents_(contents), file_(contents.file), base_colors_alone_(base_colors_alone) {}

  Result<ModelTextures> read() {
    for (const GltfTextureUse& use : uses_that_follow(contents_)) {
      if (base_colors_alone_ && !colors_material(use)) continue;
      if (Status ok = add(use); !ok) return ok.error();
    }
    for (const GltfPrimitive& primitive : contents_.primitives) {
      const Json& json = primitive_json(file_.json, primitive);
      const std::uint8_t has_tangents = json["attributes"].contains("TANGENT") ? 1 : 0;
      std::vector<std::uint8_t>& of_face = textures_.face_has_tangents;
      of_face.resize(primitive.first_face + primitive.face_count, 0);
      std::fill_n(of_face.begin() + primitive.first_face, primitive.face_count, has_tangents);
      const Json* extensions = find_member(json, "extensions");
      textures_.has_variants =
          textures_.has_variants ||
          (extensions != nullptr && extensions->contains("KHR_materials_variants"));
    }
    return std::move(textures_);
  }

 private:
  Status add(const GltfTextureUse& use) {
    const std::string place = fmt::format("texture {}", use.texture);
    const Json& images = array_member(file_.json, "images");
    const auto image = integer_member(file_.json["textures"][use.texture], "source", images.size());
    if (!image || *image >= images.size()) {
      return file_.error(place, "it has no PNG or JPEG picture", "convert its pictures to PNG");
    }
    const auto [found, is_new] =
        number_.try_emplace(place_of(images[*image]), textures_.images.size());
    if (is_new) {
      const std::string name = fmt::format("image {}", *image);
      const auto bytes = bytes_of(images[*image], name);
      if (!bytes) return bytes.error();
      auto texture = decode_texture(*bytes, fmt::format("{}: {}", file_.name, name));
      if (!texture) return texture.error();
      texels_ += texture->texel_count();
      if (texels_ > kMostTexels) {
        return file_.error(name, "its pictures have more than 2^30 texels in all",
                           "make some of them smaller");
      }
      textures_.images.push_back(std::move(*texture));
    }
    const TransferSource source = source_of(file_.json, use);
    for (const double value : source.matrix) {
      if (std::abs(value) < kMostOfMatrix) continue;
      return file_.error(place, "its KHR_texture_transform is out of range", "export it again");
    }
    const std::string path = use.where.to_string();  // "/materials/3/normalTexture"
    const std::size_t begin = path.find('/', kMaterials.size());
    textures_.uses.push_back({static_cast<std::uint32_t>(material_of(path) + 1),
                              path.substr(begin + 1), role_of(path), found->second, source});
    return Done{};
  }

  [[nodiscard]] bool colors_material(const GltfTextureUse& use) const {
    const std::string path = use.where.to_string();
    if (!is_base_color(path)) return false;
    const Json& material = array_member(file_.json, "materials")[material_of(path)];
    return path.ends_with("diffuseTexture") == (specular_glossiness(material) != nullptr);
  }

  /// Where its bytes are: entries that name the same ones are one picture.
  static std::string place_of(const Json& image) {
    const Json* view = find_member(image, "bufferView");
    const Json* uri = find_member(image, "uri");
    return view != nullptr ? view->dump() : uri != nullptr ? uri->dump() : image.dump();
  }

  Result<std::string> bytes_of(const Json& image, const std::string& place) const {
    const Json& views = array_member(file_.json, "bufferViews");
    const auto view = integer_member(image, "bufferView", views.size());
    if (view && *view < views.size()) {
      const auto buffer = integer_member(views[*view], "buffer", 0);
      const auto offset = integer_member(views[*view], "byteOffset", 0);
      const auto length = integer_member(views[*view], "byteLength", 0);
      const std::string_view all = file_.buffers[*buffer].bytes;
      if (all.empty()) return file_.error(place, "its buffer is not in the file");
      return std::string(all.substr(*offset, *length));
    }
    const Json* uri = find_member(image, "uri");
    if (uri == nullptr || !uri->is_string()) return file_.error(place, "it has no data");
    const auto& text = uri->get_ref<const std::string&>();
    if (text.starts_with("data:")) {
      const std::size_t comma = text.find(',');
      const auto bytes = comma == std::string::npos
                             ? std::nullopt
                             : base64_decode(std::string_view(text).substr(comma + 1));
      if (!bytes) return file_.error(place, "its data URI cannot be decoded");
      return *bytes;
    }
    const auto name = is_plain_relative_uri(text) ? percent_decode(text) : std::nullopt;
    if (!name) return file_.error(place, "its URI is no file beside the model");
    return read_file(file_.folder / *name);
  }

  static constexpr std::size_t kMostTexels = std::size_t{1} << 30U;
  static constexpr double kMostOfMatrix = 1e9;

  const GltfContents& contents_;
  const GltfFile& file_;
  bool base_colors_alone_;
  ModelTextures textures_;
  std::map<std::string, std::size_t> number_;  ///< of images, by their places
  std::size_t texels_ = 0;
};

/// Calls visit(index) for each reference to an image, those of extensions of textures included.
template <typename Visit>
void for_each_image_use(Json& json, Visit&& visit) {
  if (!json.contains("textures")) return;
  for (Json& texture : json["textures"]) {
    if (texture.contains("source")) visit(texture["source"]);
    if (!texture.contains("extensions") || !texture["extensions"].is_object()) continue;
    for (auto& [name, extension] : texture["extensions"].items()) {
      if (extension.is_object() && extension.contains("source")) visit(extension["source"]);
    }
  }
}

/// Does the file have a part that may name textures and images by numbers we do not know of?
bool has_unknown_parts(const Json& json) {
  const Json* extensions = find_member(json, "extensions");
  if (extensions == nullptr || !extensions->is_object()) return false;
  for (const auto& [name, part] : extensions->items()) {
    const bool known = name == "KHR_lights_punctual" || name == "KHR_materials_variants" ||
                       name == "KHR_xmp_json_ld";
    if (!known) return true;
  }
  return false;
}

/// Textures from `first_new` on take the places of candidates that no material names any more; what
/// is left of those lets go of its picture. All others keep their numbers, as extensions that we do
/// not know of may name them.
void reuse_unused_textures(Json& json, const std::set<std::uint64_t>& candidates,
                           std::size_t first_new, const GltfContents& contents) {
  if (candidates.empty() || has_unknown_parts(json)) return;
  std::vector<Json*> indices;
  std::set<std::uint64_t> unused = candidates;
  for (const GltfTextureUse& use : texture_uses(contents)) {
    const auto now = integer_member(json[use.where], "index", 0);
    if (!now) continue;
    indices.push_back(&json[use.where]["index"]);
    unused.erase(*now);
  }
  Json& textures = json["textures"];
  while (!unused.empty() && textures.size() > first_new) {
    const std::uint64_t from = textures.size() - 1, to = *unused.begin();
    unused.erase(unused.begin());
    textures[to] = std::move(textures[from]);
    textures.erase(from);
    for (Json* index : indices) {
      if (as_integer(*index) == from) *index = to;
    }
  }
  for (const std::uint64_t texture : unused) {
    textures[texture].erase("source");
    textures[texture].erase("extensions");
  }
}

/// Renumbers the images that are left. Not where an unknown part of the file may name images.
void drop_unused_images(Json& json) {
  if (has_unknown_parts(json) || !json.contains("images")) return;
  Json& images = json["images"];
  std::vector<bool> used(images.size());
  for_each_image_use(json, [&](Json& index) {
    const auto number = as_integer(index);
    if (number && *number < used.size()) used[*number] = true;
  });
  std::vector<std::uint64_t> number(images.size());
  Json kept = Json::array();
  for (std::size_t i = 0; i < images.size(); ++i) {
    number[i] = kept.size();
    if (used[i]) kept.push_back(std::move(images[i]));
  }
  for_each_image_use(json, [&](Json& index) {
    const auto old = as_integer(index);
    if (old && *old < number.size()) index = number[*old];
  });
  images = std::move(kept);
  if (images.empty()) json.erase("images");
}

}  // namespace

Result<ModelTextures> read_gltf_textures(const GltfContents& contents, bool base_colors_alone) {
  return ImageReader(contents, base_colors_alone).read();
}

void replace_gltf_textures(const GltfContents& contents, std::span<const NewTexture> textures,
                           GltfEdit& edit) {
  const std::vector<GltfTextureUse> uses = uses_that_follow(contents);
  const int set = std::stoi(contents.texcoord_name.substr(std::string("TEXCOORD_").size()));
  std::set<std::uint64_t> replaced;
  const std::size_t first_new = array_member(edit.json, "textures").size();
  for (const NewTexture& made : textures) {
    if (made.uses.empty()) continue;
    const GltfTextureUse& first = uses[made.uses.front()];
    // Its sampler, which may be new since the file was read, its name and its extras.
    const auto now = integer_member(edit.json[first.where], "index", first.texture);
    Json texture = edit.json["textures"][now.value_or(first.texture)];
    texture.erase("extensions");
    texture["source"] = edit.add_image(made.name, made.png, "image/png");
    const std::size_t number = edit.json["textures"].size();
    edit.json["textures"].push_back(std::move(texture));
    for (const std::size_t use : made.uses) {
      replaced.insert(uses[use].texture);
      Json& info = edit.json[uses[use].where];
      if (const auto clone = integer_member(info, "index", 0); clone && *clone < first_new) {
        replaced.insert(*clone);  // as its sampler had to be another
      }
      info["index"] = number;
      if (uses[use].transformed) remove_extension(info, kTransform);
      // A transform may have named the UV set in its place.
      info.erase("texCoord");
      if (set != 0) info["texCoord"] = set;
    }
  }
  reuse_unused_textures(edit.json, replaced, first_new, contents);
  drop_unused_images(edit.json);
  unlist_extension(edit.json, kTransform);
}

}  // namespace wrapatlas
