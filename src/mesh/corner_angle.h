#pragma once

#include <cmath>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// Radians, 0 if one of them has no length.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace wrapatlas
