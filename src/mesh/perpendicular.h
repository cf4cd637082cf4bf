#pragma once

#include <cmath>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// A unit vector at a right angle to v.
inline Vec3 perpendicular(const Vec3& v) {
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  // The axis that is farthest from v.
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 side = cross(v, axis);
  const double size = length(side);
  return size > 0 ? 1 / size * side : Vec3{1, 0, 0};
}

}  // namespace wrapatlas
