// Faces of the atlas to vertices and triangles of each primitive.
#include <fmt/format.h>

#include <algorithm>

#include "io/gltf_layers.h"

namespace wrapatlas {
namespace {

Error foreign_atlas(const GltfContents& contents) {
  return {ErrorKind::usage, contents.file.name, "the atlas was not made from this model",
          "pack the mesh of the model that is saved"};
}

/// Whether the mesh is still made of these primitives. (That the atlas is of the mesh is known.)
bool consistent(const Mesh& mesh, const std::vector<GltfPrimitive>& primitives) {
  std::size_t triangles = 0;
  for (const GltfPrimitive& primitive : primitives) triangles += primitive.face_count;
  if (mesh.face_count() != triangles || mesh.corner_count() != 3 * triangles) return false;
  for (const GltfPrimitive& primitive : primitives) {
    const std::size_t end = 3 * (std::size_t{primitive.first_face} + primitive.face_count);
    const std::size_t last = std::size_t{primitive.first_position} + primitive.vertex_count;
    if (end > mesh.corner_count() || last > mesh.positions.size()) return false;
    bool fits = true;
    for (std::size_t c = 3 * std::size_t{primitive.first_face}; c < end; ++c) {
      fits &= mesh.corner_position[c] - primitive.first_position < primitive.vertex_count;
      fits &= !primitive.has_texcoords || mesh.corner_texcoord[c] < mesh.texcoords.size();
    }
    if (!fits) return false;
  }
  return true;
}

class Planner {
 public:
  Planner(const GltfContents& contents, const Mesh& mesh, const AtlasMesh& atlas)
      : contents_(contents), mesh_(mesh), atlas_(atlas) {
    place_cut_points();
  }

  Status plan_all() {
    std::size_t face = 0;
    for (const GltfPrimitive& primitive : contents_.primitives) {
      const std::size_t first = face;
      const std::uint32_t end = primitive.first_face + primitive.face_count;
      while (face < atlas_.face_count() && atlas_.face_source[face] < end) ++face;
      if (first == face) continue;
      const bool same_faces =
          face - first == primitive.face_count &&
          atlas_.face_begin[face] - atlas_.face_begin[first] == 3 * (face - first);
      if (!primitive.has_texcoords && same_faces && !gets_texcoords(first, face)) continue;
      if (Status planned = plan(primitive, first, face, same_faces); !planned) return planned;
    }
    return Done{};
  }

  GltfPlans take() { return std::move(result_); }

 private:
  /// Both sides of an edge must get the same bits, whatever their accessors are.
  void place_cut_points() {
    cut_positions_.resize(atlas_.cut_position_count);
    std::vector<bool> placed(atlas_.cut_position_count);
    for (const AtlasMesh::CutPoint& point : atlas_.cut_points) {
      if (placed[point.position]) continue;
      placed[point.position] = true;
      Vec3 sum;
      for (std::size_t k = 0; k < 3; ++k) {
        if (point.weights[k] == 0) continue;
        sum = sum + point.weights[k] * mesh_.positions[mesh_.corner_position[point.corners[k]]];
      }
      cut_positions_[point.position] = sum;
    }
  }

  [[nodiscard]] std::uint32_t vertex_of(const GltfPrimitive& primitive,
                                        std::uint32_t corner) const {
    return mesh_.corner_position[corner] - primitive.first_position;
  }

  [[nodiscard]] GltfUv uv_of(const GltfPrimitive& primitive, std::uint32_t corner) const {
    Vec2 uv;
    if (atlas_.corner_texcoord[corner] != kNone) {
      uv = atlas_.texcoords[atlas_.corner_texcoord[corner]];
    } else if (primitive.has_texcoords && atlas_.corner_source[corner] != kNone) {
      uv = mesh_.texcoords[mesh_.corner_texcoord[atlas_.corner_source[corner]]];
    }
    return {static_cast<float>(uv.x), static_cast<float>(uv.y)};
  }

  [[nodiscard]] bool gets_texcoords(std::size_t first, std::size_t end) const {
    const auto begin = atlas_.corner_texcoord.begin();
    return std::any_of(begin + atlas_.face_begin[first], begin + atlas_.face_begin[end],
                       [](std::uint32_t texcoord) { return texcoord != kNone; });
  }

  /// The layer for the faces: the last one with the same attributes, or a new one.
  std::size_t layer_for(const GltfPrimitive& primitive, std::size_t first, std::size_t end) {
    const Json& json = primitive_json(contents_.file.json, primitive);
    const std::string key = json["attributes"].dump() + array_member(json, "targets").dump();
    const auto [found, fresh] = layer_of_.try_emplace(key, result_.layers.size());
    if (!fresh) {
      const GltfLayer& layer = result_.layers[found->second];
      const std::uint32_t corner_end = atlas_.face_begin[end];
      std::size_t corners = 0, conflicts = 0;
      for (std::uint32_t c = atlas_.face_begin[first]; c < corner_end; ++c) {
        if (atlas_.corner_source[c] == kNone) continue;
        ++corners;
        const std::uint32_t vertex = vertex_of(primitive, atlas_.corner_source[c]);
        if (layer.conflicts(vertex, uv_of(primitive, c))) ++conflicts;
      }
      // A whole new layer for a few corners would make large files out of small ones.
      if (2 * conflicts <= corners || primitive.vertex_count > 4 * corners) return found->second;
      found->second = result_.layers.size();
    }
    result_.layers.emplace_back(old_uvs(json, primitive));
    return found->second;
  }

  [[nodiscard]] std::vector<GltfUv> old_uvs(const Json& json,
                                            const GltfPrimitive& primitive) const {
    std::vector<GltfUv> uvs(primitive.vertex_count);
    if (!primitive.has_texcoords) return uvs;
    const Json& index = json["attributes"][contents_.texcoord_name];
    const Result<GltfAccessor> accessor = open_accessor(contents_.file, *as_integer(index));
    if (accessor) read_floats(*accessor, 2, uvs.front().data());
    return uvs;
  }

  std::uint32_t new_vertex(GltfLayer& layer, const GltfPrimitive& primitive,
                           std::uint32_t corner) const {
    const GltfUv uv = uv_of(primitive, corner);
    const std::uint32_t source = atlas_.corner_source[corner];
    if (source != kNone) return layer.vertex(vertex_of(primitive, source), uv);
    const AtlasMesh::CutPoint& point = atlas_.cut_points[atlas_.corner_cut[corner]];
    GltfBlend blend;
    blend.weights = point.weights;
    blend.position = cut_positions_[point.position];
    for (std::size_t k = 0; k < 3; ++k) {
      if (point.weights[k] != 0) blend.vertices[k] = vertex_of(primitive, point.corners[k]);
    }
    return layer.cut_vertex(point.position, blend, uv);
  }

  /// A corner in the plane of its source triangle, whose corners are (0,0), (1,0) and (0,1).
  [[nodiscard]] Vec2 flat_point(std::uint32_t corner) const {
    std::array<double, 3> weights{};
    if (atlas_.corner_source[corner] != kNone) {
      weights[atlas_.corner_source[corner] % 3] = 1;
    } else {
      const AtlasMesh::CutPoint& point = atlas_.cut_points[atlas_.corner_cut[corner]];
      for (std::size_t k = 0; k < 3; ++k) weights[point.corners[k] % 3] += point.weights[k];
    }
    return {weights[1], weights[2]};
  }

  Status plan(const GltfPrimitive& primitive, std::size_t first, std::size_t end, bool same_faces) {
    GltfPlan plan;
    plan.primitive = &primitive;
    plan.layer = layer_for(primitive, first, end);
    plan.has_texcoords = primitive.has_texcoords || gets_texcoords(first, end);
    if (!same_faces) begin_indices(plan, first, first, end);
    GltfLayer& layer = result_.layers[plan.layer];
    for (std::size_t f = first; f < end; ++f) {
      const std::uint32_t begin = atlas_.face_begin[f], corners = atlas_.face_begin[f + 1] - begin;
      if (corners != 3) {
        add_piece(layer, f, plan);
        continue;
      }
      std::array<std::uint32_t, 3> triangle{};
      bool kept = true;  // has every corner its old vertex?
      for (std::uint32_t k = 0; k < 3; ++k) {
        triangle[k] = new_vertex(layer, primitive, begin + k);
        const std::uint32_t source = atlas_.corner_source[begin + k];
        kept = kept && source != kNone && triangle[k] == vertex_of(primitive, source);
      }
      if (kept && !plan.new_indices) continue;
      if (!plan.new_indices) begin_indices(plan, first, f, end);
      plan.indices.insert(plan.indices.end(), triangle.begin(), triangle.end());
    }
    if (layer.uvs().size() >= kNone) {
      return Error{ErrorKind::output, contents_.file.name, "it would need too many vertices",
                   "split the model into several"};
    }
    result_.plans.push_back(std::move(plan));
    return Done{};
  }

  /// Most often no index changes, so they are listed from the first that does: `face`. Those of
  /// the triangles from `first` up to it are the old ones.
  void begin_indices(GltfPlan& plan, std::size_t first, std::size_t face, std::size_t end) const {
    plan.new_indices = true;
    plan.indices.reserve(3 * (end - first));
    for (std::uint32_t c = atlas_.face_begin[first]; c < atlas_.face_begin[face]; ++c) {
      plan.indices.push_back(vertex_of(*plan.primitive, atlas_.corner_source[c]));
    }
  }

  /// The triangles of a face with more than three corners.
  void add_piece(GltfLayer& layer, std::size_t face, GltfPlan& plan) {
    vertices_.clear();
    points_.clear();
    triangles_.clear();
    for (std::uint32_t c = atlas_.face_begin[face]; c < atlas_.face_begin[face + 1]; ++c) {
      vertices_.push_back(new_vertex(layer, *plan.primitive, c));
      points_.push_back(flat_point(c));
    }
    triangulate_piece(points_, triangles_);
    for (const auto& triangle : triangles_) {
      for (const std::uint32_t offset : triangle) plan.indices.push_back(vertices_[offset]);
    }
  }

  const GltfContents& contents_;
  const Mesh& mesh_;
  const AtlasMesh& atlas_;
  std::vector<Vec3> cut_positions_;  ///< per position number
  std::map<std::string, std::size_t> layer_of_;
  GltfPlans result_;
  std::vector<std::uint32_t> vertices_;  ///< of one face; and what is made of it:
  std::vector<Vec2> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

Result<GltfPlans> plan_vertices(const GltfContents& contents, const Mesh& mesh,
                                const AtlasMesh& atlas) {
  if (!consistent(mesh, contents.primitives)) return foreign_atlas(contents);
  Planner planner(contents, mesh, atlas);
  if (Status planned = planner.plan_all(); !planned) return planned.error();
  return planner.take();
}

}  // namespace wrapatlas
