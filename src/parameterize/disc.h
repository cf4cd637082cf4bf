// A chart in space that is known to be a disc, and what its algorithms ask of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

using Triangle = std::array<std::uint32_t, 3>;

/// Half-edge h = 3 * t + i goes from corner i of triangle t to corner i + 1.
struct Disc {
  std::vector<Vec3> points;             ///< moved and scaled into a cube of side 1 at the origin
  double size = 0;                      ///< side of that cube in the units of the input
  double area = 0;                      ///< of the triangles, as scaled
  std::span<const Triangle> triangles;  ///< the caller's
  std::vector<std::uint32_t> opposite;  ///< per half-edge that of the neighbour, or kNone
  std::vector<std::uint32_t> border;    ///< points of the border in its order, interior on the left
  std::vector<bool> on_border;          ///< per point
};

/// Errors: input, where it is not a disc (see flatten_disc). O(n log n).
Result<Disc> make_disc(std::span<const Vec3> points, std::span<const Triangle> triangles);

/// Corner after, and before, i in a triangle.
inline std::size_t next3(std::size_t i) { return i == 2 ? 0 : i + 1; }
inline std::size_t prev3(std::size_t i) { return i == 0 ? 2 : i - 1; }

}  // namespace wrapatlas
