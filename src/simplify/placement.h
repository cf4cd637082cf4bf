// Lindstrom & Turk, "Fast and memory efficient polygonal simplification", IEEE Visualization 1998:
// where the point goes that an edge collapses to, and what that costs. "Memoryless":
// errors are to the triangles that are there, not to those of the beginning.
#pragma once

#include <cstdint>
#include <span>

#include "simplify/collapse_mesh.h"
#include "simplify/patch_geometry.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas {

struct EdgePlacement {
  Vec3 point;
  double cost = 0;  ///< length to the sixth power, >= 0
};

/// Of the edge of c. `is_seam` per number of an edge: a line that is to stay in its place, as
/// borders are; or empty. O(1) inside, O(d) for vertices of degree d at lines.
EdgePlacement place(const CollapseMesh& mesh, const PatchGeometry& geometry, std::uint32_t c,
                    std::span<const std::uint8_t> is_seam);

}  // namespace wrapatlas
