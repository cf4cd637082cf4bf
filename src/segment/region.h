// A set of faces as a graph of its own: what charts are grown in, cut and split.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/surface.h"

namespace wrapatlas {

/// Per face of a surface.
struct FaceShapes {
  std::vector<Vec3> normal;  ///< of length 1, or 0 for a face of no area
  std::vector<Vec3> centroid;
  std::vector<double> area;
  double whole_area = 0;  ///< of all faces
};
FaceShapes face_shapes(const Surface& surface);

/// Faces are numbered from 0 on within it, in the order of `faces`.
struct Region {
  struct Arc {
    std::uint32_t to = 0;      ///< face within the region
    std::uint32_t corner = 0;  ///< of the surface: the edge it crosses
  };
  std::vector<std::uint32_t> faces;         ///< of the surface
  std::vector<std::uint32_t> arc_begin{0};  ///< per face
  std::vector<Arc> arcs;

  [[nodiscard]] std::span<const Arc> arcs_of(std::uint32_t face) const {
    return {arcs.data() + arc_begin[face], arcs.data() + arc_begin[face + 1]};
  }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(faces.size()); }
};

/// Which chart each face belongs to, and its number within that chart's region. Regions of
/// different charts may be made at the same time.
struct FaceOwners {
  std::vector<std::uint32_t> chart, place;
};

/// The faces of chart `a`, or of charts `a` and `b`: all that `owners.chart` gives to them, in the
/// order wanted. Writes their `owners.place`. O(corners).
Region make_region(const Surface& surface, std::vector<std::uint32_t> faces, FaceOwners& owners,
                   std::uint32_t a, std::uint32_t b = kNone);

}  // namespace wrapatlas
