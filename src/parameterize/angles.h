// Corner angles of triangles, and what is laid out from them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

using Triangle = std::array<std::uint32_t, 3>;
using Angles = std::array<double, 3>;  ///< radians, of the corners of a triangle

inline double triangle_area(std::span<const Vec3> points, const Triangle& t) {
  return 0.5 * length(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
}

/// Between 3 and 175 degrees, so the sum of a thin triangle's is not pi.
std::vector<Angles> clamped_angles(std::span<const Vec3> points,
                                   std::span<const Triangle> triangles);

/// Which points lie on an edge of one triangle.
std::vector<bool> border_points(std::size_t point_count, std::span<const Triangle> triangles);

/// Angles near `angles` that belong to a map into the plane, by `iterations` linear solves. False
/// if there are none: then `angles` are of no use. `residual` becomes the largest error that is
/// left in the condition on lengths around an interior point.
bool flatten_angles(std::vector<Angles>& angles, std::span<const Triangle> triangles,
                    const std::vector<bool>& is_border, int iterations, double& residual);

/// Points in the plane whose triangles have these angles as nearly as can be, in the sense of least
/// squares; empty if the system cannot be solved.
std::vector<Vec2> lay_out(std::span<const Vec3> points, std::span<const Triangle> triangles,
                          std::span<const Angles> angles, const std::vector<bool>& is_border);

}  // namespace wrapatlas
