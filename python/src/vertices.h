// An atlas as graphics cards want it: one index a corner, for position and UV together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wrapatlas/atlas.h"

namespace wrapatlas::python {

/// A vertex for each pair of a source vertex (or a point on a cut) and a UV, numbered as corners
/// first meet them.
struct Vertices {
  std::vector<std::uint32_t> of_corner;
  std::vector<float> uv;  ///< two each; 0 for vertices without a UV
  /// Position (or any other attribute): the sum of weights * that of the mesh's vertices.
  std::vector<std::array<std::uint32_t, 3>> sources;
  std::vector<std::array<double, 3>> weights;
  std::vector<std::uint32_t> mapping;  ///< the source of the largest weight
};

/// O(n log n).
Vertices split_vertices(const Mesh& mesh, const AtlasMesh& atlas);

}  // namespace wrapatlas::python
