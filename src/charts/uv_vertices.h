// The vertices of the UV surface: what two faces must share for their charts to be one.
#pragma once

#include <cstdint>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// Corners that weld_corners joins and that have equal UV values (-0 == 0) have the same vertex.
struct UvVertices {
  std::vector<std::uint32_t> of_corner;  ///< numbered by first use; kNone on faces without UVs
  std::vector<std::uint32_t> position;   ///< per vertex: number of weld_corners
  std::vector<Vec2> uv;                  ///< per vertex
  std::uint32_t faces_without_uv = 0;
};

/// A face without a UV at any one of its corners counts as a face without UVs. O(corners).
UvVertices find_uv_vertices(const Mesh& mesh);

}  // namespace wrapatlas
