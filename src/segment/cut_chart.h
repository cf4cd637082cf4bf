// A region cut open to a disc.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/region.h"

namespace wrapatlas {

/// The region's faces, joined along as many edges as leave it a disc. Corners are numbered within
/// it, those of one face after the other in the region's order.
struct CutChart {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of points
  std::vector<std::uint32_t> corner_begin{0};           ///< per face of the region, and one more
  std::vector<std::uint32_t> corner_point;
  std::vector<std::uint32_t> corner_twin;    ///< where the disc is joined; kNone: its border
  std::vector<std::uint32_t> corner_face;    ///< of the region
  std::vector<std::uint32_t> triangle_face;  ///< of the region
  bool is_closed = false;                    ///< a sphere, cut along a single edge

  [[nodiscard]] std::uint32_t next(std::uint32_t corner) const {
    const std::uint32_t face = corner_face[corner];
    return corner + 1 == corner_begin[face + 1] ? corner_begin[face] : corner + 1;
  }
};

/// Cuts the region to a disc: along the edges in `seams` (corners of the surface, both of each
/// edge, ascending), and where else it has to, far from its first face. First faces are
/// joined along the shortest ways from that one, which gives a disc; then edges of its border that
/// follow one another and are one edge of the surface are closed. What stays open is a seam along
/// which the ways from it meet (a cut locus), with no dead ends but those of `seams`.
/// The region less its seams must be connected. O(n log n).
CutChart cut_to_disc(const Surface& surface, const Region& region, const FaceShapes& shapes,
                     std::span<const std::uint32_t> seams);

}  // namespace wrapatlas
