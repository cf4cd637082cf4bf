// A glTF of positions, faces and UVs alone, a mesh for each object. No normals: readers then shade
// flat, as the specification says. A .gltf holds its buffer as a data URI, so that it is one file.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <unordered_map>

#include "io/formats.h"
#include "io/gltf_arrays.h"
#include "io/gltf_save.h"

namespace wrapatlas {
namespace {

/// The faces of one object.
struct ObjectFaces {
  std::vector<std::uint32_t> with_texcoords, without;
};

/// In the order of their first faces.
std::vector<ObjectFaces> faces_of_objects(const Mesh& mesh, const AtlasMesh& atlas) {
  std::vector<ObjectFaces> objects;
  std::unordered_map<std::uint32_t, std::size_t> place_of;
  for (std::uint32_t f = 0; f < atlas.face_count(); ++f) {
    const std::uint32_t object = mesh.object_of(atlas.face_source[f]);
    const auto [place, is_new] = place_of.try_emplace(object, objects.size());
    if (is_new) objects.emplace_back();
    ObjectFaces& faces = objects[place->second];
    const bool has_texcoords = atlas.corner_texcoord[atlas.face_begin[f]] != kNone;
    (has_texcoords ? faces.with_texcoords : faces.without).push_back(f);
  }
  return objects;
}

/// Makes one primitive after another, and lends their arrays to the edit: to outlive it.
class FreshPrimitive {
 public:
  FreshPrimitive(const Mesh& mesh, const AtlasMesh& atlas)
      : mesh_(mesh),
        atlas_(atlas),
        vertices_of_(mesh.positions.size() + atlas.cut_position_count, kNone) {}

  /// `faces` either all have UVs or all have none.
  void write(GltfEdit& edit, std::size_t to_mesh, const std::vector<std::uint32_t>& faces) {
    if (faces.empty()) return;
    start(atlas_.corner_texcoord[atlas_.face_begin[faces[0]]] != kNone);
    for (const std::uint32_t f : faces) add_face(atlas_.face_begin[f], atlas_.face_begin[f + 1]);
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
    if (with_texcoords_) {
      attributes["TEXCOORD_0"] = add_uvs(edit, lent_uvs_.emplace_back(std::move(uvs_)));
    }
    Json primitive;
    primitive["attributes"] = std::move(attributes);
    primitive["indices"] = add_indices(edit, lent_indices_.emplace_back(std::move(indices_)),
                                       positions_.size(), GltfComponent::u16);
    edit.json["meshes"][to_mesh]["primitives"].push_back(std::move(primitive));
  }

 private:
  void start(bool with_texcoords) {
    with_texcoords_ = with_texcoords;
    for (const std::uint32_t number : numbers_) vertices_of_[number] = kNone;
    numbers_.clear();
    next_.clear();
    positions_.clear();
    uvs_.clear();
    indices_.clear();
  }

  void add_face(std::uint32_t begin, std::uint32_t end) {
    corners_.clear();
    points_.clear();
    for (std::uint32_t c = begin; c < end; ++c) {
      corners_.push_back(vertex(c));
      points_.push_back(positions_[corners_.back()]);
    }
    triangles_.clear();
    triangulate_piece(flattened(), triangles_);
    if (with_texcoords_ && triangles_.size() > 1) keep_to_texcoords();
    for (const auto& triangle : triangles_) {
      for (const std::uint32_t offset : triangle) indices_.push_back(corners_[offset]);
    }
  }

  /// Triangles that are good in space may lie beside the polygon in the texture, where there is
  /// room for the polygon alone.
  void keep_to_texcoords() {
    std::vector<Vec2> flat;
    for (const std::uint32_t vertex : corners_) flat.push_back({uvs_[vertex][0], uvs_[vertex][1]});
    if (!any_turned_over(flat, triangles_)) return;
    std::vector<std::array<std::uint32_t, 3>> others;
    triangulate_piece(flat, others);
    if (!any_turned_over(flat, others)) triangles_ = std::move(others);
  }

  /// By more than rounding.
  static bool any_turned_over(const std::vector<Vec2>& points,
                              const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    Box2 box;
    double area = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      box.add(points[i]);
      area += cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
    }
    const double noise = 1e-6 * dot(box.size(), box.size());
    return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
      const double own = signed_area2(points[t[0]], points[t[1]], points[t[2]]);
      return (area < 0 ? -own : own) < -noise;
    });
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
    numbers_.push_back(number);
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
  bool with_texcoords_ = false;
  std::vector<std::uint32_t> vertices_of_;     ///< per position or cut position
  std::vector<std::uint32_t> next_, numbers_;  ///< per vertex: the next one there, and where
  std::vector<Vec3> positions_;
  std::vector<GltfUv> uvs_;
  std::vector<std::uint32_t> indices_;
  std::deque<std::vector<GltfUv>> lent_uvs_;
  std::deque<std::vector<std::uint32_t>> lent_indices_;
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
  const std::vector<ObjectFaces> objects = faces_of_objects(mesh, atlas);
  if (objects.empty()) {
    return Error{ErrorKind::usage, path.string(), "there are no faces to write", ""};
  }
  Json nodes = Json::array(), numbers = Json::array();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    nodes.push_back({{"mesh", i}});
    numbers.push_back(i);
  }
  file.json["scenes"] = Json::array({{{"nodes", std::move(numbers)}}});
  file.json["nodes"] = std::move(nodes);
  FreshPrimitive primitive(mesh, atlas);
  GltfEdit edit(file);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    primitive.write(edit, i, objects[i].with_texcoords);
    primitive.write(edit, i, objects[i].without);
  }
  edit.finish();
  return save_gltf(file, edit, path, binary);
}

}  // namespace wrapatlas
