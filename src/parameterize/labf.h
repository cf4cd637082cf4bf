// Angles of a flat chart that are near those in space.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "parameterize/disc.h"

namespace wrapatlas {

/// Angles at the corners of the triangles in space, in radians; 3 per triangle.
std::vector<double> corner_angles(const Disc& disc);

struct FlatAngles {
  std::vector<double> angles;  ///< as those of corner_angles
  double wheel_residual = 0;   ///< largest error of a wheel (see labf.cpp), in natural logarithms
};

/// Angles after `iterations` solves, each from the angles of the one before. Nothing, if an angle
/// is not between 0 and pi, or the system is singular. O(n^1.5).
std::optional<FlatAngles> flat_angles(const Disc& disc, std::span<const std::uint32_t> order,
                                      int iterations);

}  // namespace wrapatlas
