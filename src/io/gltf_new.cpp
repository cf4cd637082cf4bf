// A glTF of positions, faces and UVs alone. No normals: readers then shade flat, as the
// specification says. A .gltf holds its buffer as a data URI, so that it is one file.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "io/formats.h"
#include "io/gltf_arrays.h"
#include "io/gltf_save.h"

namespace wrapatlas {
namespace {

/// The vertices and triangles of the faces with UVs, or of those without.
class FreshPrimitive {
 public:
  FreshPrimitive(const Mesh& mesh, const AtlasMesh& atlas, bool with_texcoords)
      : mesh_(mesh), atlas_(atlas), with_texcoords_(with_texcoords) {
    vertices_of_.resize(mesh.positions.size() + atlas.cut_position_count, kNone);
    for (std::size_t f = 0; f < atlas.face_count(); ++f)
      add_face(atlas.face_begin[f], atlas.face_begin[f + 1]);
    std::vector<std::uint32_t>().swap(vertices_of_);
    std::vector<std::uint32_t>().swap(next_);
  }

  /// Lends its arrays to `edit`.
  void write(GltfEdit& edit) const {
    if (indices_.empty()) return;
    GltfAccessor type;
    type.components = 3;
    std::string bytes(positions_.size() * 12, '\0');
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      char* element = bytes.data() + 12 * i;
      type.store(element, 0, positions_[i].x);
      type.store(element, 1, positions_[i].y);
      type.store(element, 2, positions_[i].z);
    }
    Json json = {{"componentType", 5126}, {"count", positions_.size()}, {"type", "VEC3"}};
    set_bounds(json, type, bytes, 12);
    Json attributes;
    attributes["POSITION"] =
        edit.add_accessor(std::move(json), std::move(bytes), 0, GltfTarget::vertices);
    if (with_texcoords_) attributes["TEXCOORD_0"] = add_uvs(edit, uvs_);
    Json primitive;
    primitive["attributes"] = std::move(attributes);
    primitive["indices"] = add_indices(edit, indices_, positions_.size(), GltfComponent::u16);
    edit.json["meshes"][0]["primitives"].push_back(std::move(primitive));
  }

 private:
  void add_face(std::uint32_t begin, std::uint32_t end) {
    if ((atlas_.corner_texcoord[begin] != kNone) != with_texcoords_) return;
    corners_.clear();
    points_.clear();
    for (std::uint32_t c = begin; c < end; ++c) {
      corners_.push_back(vertex(c));
      points_.push_back(positions_[corners_.back()]);
    }
    triangles_.clear();
    triangulate_piece(flattened(), triangles_);
    for (const auto& triangle : triangles_) {
      for (const std::uint32_t offset : triangle) indices_.push_back(corners_[offset]);
    }
  }

  /// The face seen along the longest axis of its normal (Newell's).
  [[nodiscard]] std::vector<Vec2> flattened() const {
    Vec3 normal;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      normal =
          normal + cross(points_[i] - points_[0], points_[(i + 1) % points_.size()] - points_[0]);
    }
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    std::vector<Vec2> flat;
    for (const Vec3& p : points_) {
      if (x >= y && x >= z) {
        flat.push_back({p.y, p.z});
      } else if (y >= z) {
        flat.push_back({p.z, p.x});
      } else {
        flat.push_back({p.x, p.y});
      }
    }
    return flat;
  }

  std::uint32_t vertex(std::uint32_t corner) {
    const std::uint32_t source = atlas_.corner_source[corner];
    const bool is_cut = source == kNone;
    const std::uint32_t number = is_cut ? static_cast<std::uint32_t>(mesh_.positions.size()) +
                                              atlas_.cut_points[atlas_.corner_cut[corner]].position
                                        : mesh_.corner_position[source];
    GltfUv uv{};
    if (with_texcoords_ && atlas_.corner_texcoord[corner] != kNone) {
      const Vec2 exact = atlas_.texcoords[atlas_.corner_texcoord[corner]];
      uv = {static_cast<float>(exact.x), static_cast<float>(exact.y)};
    }
    std::uint32_t* link = &vertices_of_[number];
    while (*link != kNone && uvs_[*link] != uv) link = &next_[*link];
    if (*link != kNone) return *link;
    const auto fresh = static_cast<std::uint32_t>(positions_.size());
    *link = fresh;  // before next_ grows: link may point into it
    positions_.push_back(is_cut ? cut_position(atlas_.cut_points[atlas_.corner_cut[corner]])
                                : mesh_.positions[number]);
    uvs_.push_back(uv);
    next_.push_back(kNone);
    return fresh;
  }

  [[nodiscard]] Vec3 cut_position(const AtlasMesh::CutPoint& point) const {
    Vec3 sum;
    for (std::size_t k = 0; k < 3; ++k) {
      if (point.weights[k] == 0) continue;
      sum = sum + point.weights[k] * mesh_.positions[mesh_.corner_position[point.corners[k]]];
    }
    return sum;
  }

  const Mesh& mesh_;
  const AtlasMesh& atlas_;
  bool with_texcoords_;
  std::vector<std::uint32_t> vertices_of_, next_;  ///< per position or cut position; per vertex
  std::vector<Vec3> positions_;
  std::vector<GltfUv> uvs_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

Status write_new_gltf(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas,
                      bool binary) {
  GltfFile file;
  file.name = path.string();
  file.binary = binary;
  file.json["asset"] = {{"version", "2.0"}, {"generator", "wrapatlas"}};
  file.json["scene"] = 0;
  file.json["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
  file.json["nodes"] = Json::array({{{"mesh", 0}}});
  GltfEdit edit(file);
  const FreshPrimitive textured(mesh, atlas, true), plain(mesh, atlas, false);
  textured.write(edit);
  plain.write(edit);
  if (!edit.json.contains("meshes")) {
    return Error{ErrorKind::usage, path.string(), "there are no faces to write", ""};
  }
  edit.finish();
  return save_gltf(file, edit, path, binary);
}

}  // namespace wrapatlas
