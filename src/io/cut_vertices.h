// The vertices that cutting a mesh along the border of the atlas adds to it.
#pragma once

#include <cstdint>
#include <vector>

#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// Cut points that are the same point in space and come from the same source vertices become one
/// vertex. (Where a file repeats a vertex along a seam or a hard edge, its repeats may differ in
/// normal or colour; points between them stay apart as they do.)
struct CutVertices {
  std::vector<std::uint32_t> of_point;     ///< per cut point: its vertex
  std::vector<std::uint32_t> first_point;  ///< per vertex: the first cut point it stands for
};

/// Numbers them in the order of their first cut points. O(n log n).
CutVertices number_cut_vertices(const Mesh& mesh, const AtlasMesh& atlas);

/// Sum of weight * attribute(corner) over the corners of a cut point, in their order.
template <typename Attribute>
auto interpolate(const AtlasMesh::CutPoint& point, const Attribute& attribute) {
  auto sum = point.weights[0] * attribute(point.corners[0]);
  for (int i = 1; i < 3; ++i) {
    if (point.weights[i] != 0) sum = sum + point.weights[i] * attribute(point.corners[i]);
  }
  return sum;
}

/// The position of a cut point. Bit-equal for cut points of one `position`.
Vec3 cut_position(const Mesh& mesh, const AtlasMesh::CutPoint& point);

}  // namespace wrapatlas
