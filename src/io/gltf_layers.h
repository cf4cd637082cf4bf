// New vertex numbers: where one old vertex has got several UVs, and where faces were cut.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/gltf_blend.h"
#include "io/gltf_primitives.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas {

using GltfUv = std::array<float, 2>;

/// The vertices of one set of attributes with one UV each. Old vertices keep their numbers, so
/// that what else refers to them stays right; new ones are behind them.
class GltfLayer {
 public:
  explicit GltfLayer(std::vector<GltfUv> old_uvs);

  /// The vertex that is old vertex `source` with `uv`: itself, an earlier copy, or a new copy.
  std::uint32_t vertex(std::uint32_t source, GltfUv uv) {
    return taken_[source] && uvs_[source] == uv ? source : other_vertex(source, uv);
  }
  /// The vertex of a cut point; equal points of space between equal vertices with equal UVs are
  /// one vertex.
  std::uint32_t cut_vertex(std::uint32_t position_number, const GltfBlend& blend, GltfUv uv);
  /// Whether vertex(source, uv) would have to make a copy.
  [[nodiscard]] bool conflicts(std::uint32_t source, GltfUv uv) const;

  [[nodiscard]] std::size_t old_count() const { return old_count_; }
  [[nodiscard]] const std::vector<GltfUv>& uvs() const { return uvs_; }
  [[nodiscard]] const GltfExtraVertices& extra() const { return extra_; }

 private:
  std::uint32_t other_vertex(std::uint32_t source, GltfUv uv);
  std::uint32_t append(GltfUv uv, GltfExtraVertex vertex);

  std::size_t old_count_;
  std::vector<GltfUv> uvs_;          ///< of all vertices
  std::vector<bool> taken_;          ///< per old vertex: is its UV a new one?
  std::vector<std::uint32_t> next_;  ///< per vertex: the next copy of the same old one, or
                                     ///< kNone. Empty, or too short, until a copy is looked for
  GltfExtraVertices extra_;
  std::map<std::array<std::uint32_t, 6>, std::uint32_t> cut_vertices_;
};

/// What becomes of one primitive.
struct GltfPlan {
  const GltfPrimitive* primitive = nullptr;
  std::size_t layer = 0;
  bool has_texcoords = false;  ///< it had them, or the atlas gives it some
  bool new_indices = false;
  std::vector<std::uint32_t> indices;  ///< of triangles; empty unless new_indices
};

struct GltfPlans {
  std::vector<GltfLayer> layers;
  std::vector<GltfPlan> plans;  ///< primitives that change; the others have none
};

/// Primitives with the same attributes share a layer, unless most of their vertices would need
/// copies there. Error: an atlas that does not belong to the mesh, or too many vertices.
Result<GltfPlans> plan_vertices(const GltfContents& contents, const Mesh& mesh,
                                const AtlasMesh& atlas);

/// Triangulates one face of the atlas into triples of its corner offsets, none of them without
/// area where that can be had. `points` are its corners in the plane of the source triangle.
void triangulate_piece(const std::vector<Vec2>& points,
                       std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace wrapatlas
