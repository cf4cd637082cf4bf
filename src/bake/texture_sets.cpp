#include "wrapatlas/texture_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/select_faces.h"

namespace wrapatlas {
namespace {

/// What of a material tells whether another one's faces may share its textures.
std::string read_from(const TextureUse& use) {
  return fmt::format("{} {} {} {} {} {}", static_cast<int>(use.role), use.image,
                     static_cast<int>(use.source.across), static_cast<int>(use.source.down),
                     fmt::join(use.source.matrix, ","), use.place);
}

/// Materials of one look: those whose uses are the same.
struct Look {
  std::vector<std::size_t> uses;  ///< of all its materials, those of the first one first
  std::size_t uses_of_one = 0;
};

class Looks {
 public:
  explicit Looks(const ModelTextures& textures) : textures_(textures) {
    std::map<std::uint32_t, std::vector<std::size_t>> of_material;
    for (std::size_t i = 0; i < textures.uses.size(); ++i) {
      of_material[textures.uses[i].material].push_back(i);
    }
    std::map<std::string, std::uint32_t> known;
    for (const auto& [material, uses] : of_material) {
      std::vector<std::string> parts;
      for (const std::size_t use : uses) parts.push_back(read_from(textures.uses[use]));
      std::sort(parts.begin(), parts.end());
      const auto next = static_cast<std::uint32_t>(looks_.size());
      const auto [found, is_new] =
          known.try_emplace(fmt::format("{}", fmt::join(parts, ";")), next);
      if (is_new) looks_.push_back({{}, uses.size()});
      std::vector<std::size_t>& all = looks_[found->second].uses;
      all.insert(all.end(), uses.begin(), uses.end());
      of_material_[material] = found->second;
    }
  }

  /// kNone: it has no textures.
  [[nodiscard]] std::uint32_t of_material(std::uint32_t material) const {
    const auto found = of_material_.find(material);
    return found == of_material_.end() ? kNone : found->second;
  }
  [[nodiscard]] const Look& operator[](std::uint32_t look) const { return looks_[look]; }
  [[nodiscard]] std::size_t size() const { return looks_.size(); }

  /// Texels per unit of u and of v, of the finest of its textures.
  [[nodiscard]] Vec2 texels(std::uint32_t look) const {
    Vec2 most{1, 1};
    for (const std::size_t i : looks_[look].uses) {
      const TextureUse& use = textures_.uses[i];
      const auto& m = use.source.matrix;
      const Texture& image = textures_.images[use.image];
      most.x = std::max(most.x, std::hypot(m[0] * image.width, m[3] * image.height));
      most.y = std::max(most.y, std::hypot(m[1] * image.width, m[4] * image.height));
    }
    return most;
  }

 private:
  const ModelTextures& textures_;
  std::vector<Look> looks_;
  std::map<std::uint32_t, std::uint32_t> of_material_;
};

/// Channels that hold what textures of so many hold.
class Channels {
 public:
  void add(int channels) {
    has_color_ = has_color_ || channels >= 3;
    has_alpha_ = has_alpha_ || channels % 2 == 0;
  }
  [[nodiscard]] int count() const { return (has_color_ ? 3 : 1) + (has_alpha_ ? 1 : 0); }

 private:
  bool has_color_ = false, has_alpha_ = false;
};

/// "bump", or "bump-2" if there is one of that name.
std::string unused_name(const std::string& name, std::span<const SetTexture> taken) {
  std::string result = name;
  for (int number = 2; std::any_of(taken.begin(), taken.end(),
                                   [&](const SetTexture& one) { return one.name == result; });
       ++number) {
    result = fmt::format("{}-{}", name, number);
  }
  return result;
}

/// The textures that groups of these looks need together.
std::vector<SetTexture> textures_for(std::span<const std::uint32_t> group_look, const Looks& looks,
                                     const ModelTextures& textures) {
  struct At {
    std::size_t group, use;
  };
  // At one place materials may have different things: an OBJ's bump is heights or normals.
  using Slot = std::pair<std::string, TextureRole>;
  std::map<Slot, std::vector<At>> slots;         // one use for each group
  std::map<Slot, std::vector<std::size_t>> all;  // those of all materials
  for (std::size_t group = 0; group < group_look.size(); ++group) {
    const Look& look = looks[group_look[group]];
    for (std::size_t i = 0; i < look.uses.size(); ++i) {
      const TextureUse& use = textures.uses[look.uses[i]];
      const Slot slot{use.place, use.role};
      if (i < look.uses_of_one) slots[slot].push_back({group, look.uses[i]});
      all[slot].push_back(look.uses[i]);
    }
  }
  std::map<std::string, std::size_t> known;
  std::vector<SetTexture> result;
  for (const auto& [slot, at] : slots) {
    const auto& [place, role] = slot;
    std::string key = std::to_string(static_cast<int>(role));
    for (const At& one : at) {
      const TextureUse& use = textures.uses[one.use];
      key +=
          fmt::format(" {}:{}:{}:{}:{}", one.group, use.image, static_cast<int>(use.source.across),
                      static_cast<int>(use.source.down), fmt::join(use.source.matrix, ","));
    }
    const auto [found, is_new] = known.try_emplace(key, result.size());
    if (is_new) {
      TransferTarget target{role, 1, std::vector<TransferSource>(group_look.size())};
      Channels channels;
      for (const At& one : at) {
        TransferSource& source = target.of_group[one.group];
        source = textures.uses[one.use].source;
        source.texture = &textures.images[textures.uses[one.use].image];
        channels.add(source.texture->channels);
      }
      target.channels = channels.count();
      const std::string name = unused_name(place.substr(place.rfind('/') + 1), result);
      result.push_back({std::move(target), name, {}});
    }
    std::vector<std::size_t>& uses = result[found->second].uses;
    uses.insert(uses.end(), all[slot].begin(), all[slot].end());
  }
  return result;
}

bool has_uvs(const Mesh& mesh, std::uint32_t face) {
  for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
    if (mesh.corner_texcoord[c] == kNone) return false;
  }
  return true;
}

double area_in_uv(const Mesh& mesh, std::uint32_t face) {
  const std::uint32_t first = mesh.face_begin[face];
  const auto uv = [&](std::uint32_t c) { return mesh.texcoords[mesh.corner_texcoord[c]]; };
  double twice = 0;
  for (std::uint32_t c = first + 1; c + 1 < mesh.face_begin[face + 1]; ++c) {
    twice += signed_area2(uv(first), uv(c), uv(c + 1));
  }
  return 0.5 * std::abs(twice);
}

}  // namespace

std::vector<TextureSet> texture_sets(const Mesh& mesh, std::span<const std::uint32_t> face_material,
                                     const ModelTextures& textures, bool merged) {
  const Looks looks(textures);
  std::vector<TextureSet> sets;
  std::vector<std::uint32_t> set_of_look(looks.size(), kNone), group_of_look(looks.size(), kNone);
  std::vector<std::vector<std::uint32_t>> looks_of_set;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t material = face_material.empty() ? 0 : face_material[face];
    const std::uint32_t look = looks.of_material(material);
    if (look == kNone || !has_uvs(mesh, face)) continue;
    if (set_of_look[look] == kNone) {
      if (sets.empty() || !merged) {
        sets.emplace_back();
        looks_of_set.emplace_back();
      }
      set_of_look[look] = static_cast<std::uint32_t>(sets.size() - 1);
      group_of_look[look] = static_cast<std::uint32_t>(looks_of_set.back().size());
      looks_of_set.back().push_back(look);
      sets.back().texels.push_back(looks.texels(look));
    }
    TextureSet& set = sets[set_of_look[look]];
    set.faces.push_back(face);
    set.group.push_back(group_of_look[look]);
    if (!textures.face_has_tangents.empty()) {
      set.keeps_tangents.push_back(textures.face_has_tangents[face]);
    }
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    sets[i].mesh = select_faces(mesh, sets[i].faces);
    sets[i].textures = textures_for(looks_of_set[i], looks, textures);
  }
  return sets;
}

Mesh mesh_in_texels(const TextureSet& set) {
  Mesh mesh = set.mesh;
  struct Extent {
    double begin = std::numeric_limits<double>::infinity(), end = -begin;
  };
  std::vector<Extent> columns(set.texels.size());  // that each group covers
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t group = set.group[face];
    Extent& extent = columns[group];
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      const double x = set.texels[group].x * mesh.texcoords[mesh.corner_texcoord[c]].x;
      extent = {std::min(extent.begin, x), std::max(extent.end, x)};
    }
  }
  std::vector<double> shift(columns.size(), 0);
  for (std::size_t group = 1; group < columns.size(); ++group) {
    const Extent& before = columns[group - 1];
    shift[group] = before.end + shift[group - 1] + 1 - columns[group].begin;
  }
  mesh.texcoords.clear();
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t group = set.group[face];
    const Vec2 size = set.texels[group];
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      const Vec2 uv = set.mesh.texcoords[mesh.corner_texcoord[c]];
      mesh.corner_texcoord[c] = static_cast<std::uint32_t>(mesh.texcoords.size());
      mesh.texcoords.push_back({size.x * uv.x + shift[group], size.y * uv.y});
    }
  }
  return mesh;
}

void scale_to_texels(Mesh& mesh, std::span<const std::uint32_t> face_chart, const Mesh& texels) {
  struct Areas {
    double before = 0, after = 0;
    [[nodiscard]] double scale(double otherwise) const {
      return before > 0 && after > 0 ? std::sqrt(before / after) : otherwise;
    }
  };
  std::vector<Areas> charts(face_chart.size());  // numbers of charts are below that
  Areas all;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const double before = area_in_uv(texels, face), after = area_in_uv(mesh, face);
    for (Areas* areas : {&charts[face_chart[face]], &all}) {
      areas->before += before;
      areas->after += after;
    }
  }
  std::vector<Vec2> scaled(mesh.corner_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const double scale = charts[face_chart[face]].scale(all.scale(1));
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      scaled[c] = scale * mesh.texcoords[mesh.corner_texcoord[c]];
      mesh.corner_texcoord[c] = c;
    }
  }
  mesh.texcoords = std::move(scaled);
}

double share_thinned(const Mesh& mesh, double scale, const Mesh& texels) {
  constexpr double kThinner = 0.9;  // texels along a unit
  double all = 0, thinned = 0;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const double before = area_in_uv(texels, face);
    const double after = scale * scale * area_in_uv(mesh, face);
    all += before;
    if (after < kThinner * kThinner * before) thinned += before;
  }
  return all > 0 ? thinned / all : 0;
}

}  // namespace wrapatlas
