// Lindstrom & Turk 1998, section 3 (vertex placement): up to three planes that a point must lie in,
// the earlier ones first.
#pragma once

#include <array>

#include "simplify/symmetric3.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// Planes a·v = b. A further one counts only if its normal is at more than 1 degree to what the
/// normals before it span (the paper's alpha), so that the point is well defined.
class Constraints {
 public:
  [[nodiscard]] bool complete() const { return count_ == 3; }

  /// A normal no longer than `least` is rounding, and the plane is left out.
  void add(const Vec3& normal, double offset, double least = 0);

  /// Those of the planes grad(½vᵀHv + cᵀv) = 0 that the directions left free allow.
  void minimise(const Symmetric3& h, const Vec3& c);

  /// Needs complete().
  [[nodiscard]] Vec3 point() const;

 private:
  [[nodiscard]] bool is_compatible(const Vec3& unit_normal) const;

  std::array<Vec3, 3> normal_;  ///< unit vectors
  std::array<double, 3> offset_{};
  Vec3 line_;  ///< normal_[0] x normal_[1], from two planes on
  int count_ = 0;
};

}  // namespace wrapatlas
