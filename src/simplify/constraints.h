// Lindstrom & Turk 1998, section 3 (vertex placement): up to three planes that a point must lie in,
// the earlier ones first.
#pragma once

#include <array>
#include <cmath>

#include "mesh/perpendicular.h"
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

  static constexpr double kCosAlpha = 0.99984769515639123916;  // of 1 degree
  static constexpr double kSinAlpha = 0.01745240643728351282;
  static constexpr double kNoRow = 1e-12;  ///< of a matrix' trace: shorter rows are rounding

  std::array<Vec3, 3> normal_;  ///< unit vectors
  std::array<double, 3> offset_{};
  Vec3 line_;  ///< normal_[0] x normal_[1], from two planes on
  int count_ = 0;
};

// Here, as it is what most of the time goes into.

inline bool Constraints::is_compatible(const Vec3& unit_normal) const {
  if (count_ == 0) return true;
  if (count_ == 1) return std::abs(dot(normal_[0], unit_normal)) < kCosAlpha;
  return std::abs(dot(line_, unit_normal)) > kSinAlpha * length(line_);
}

inline void Constraints::add(const Vec3& normal, double offset, double least) {
  const double size = length(normal);
  if (complete() || !(size > least)) return;
  const Vec3 unit_normal = 1 / size * normal;
  if (!is_compatible(unit_normal)) return;
  normal_[count_] = unit_normal;
  offset_[count_] = offset / size;
  ++count_;
  if (count_ == 2) line_ = cross(normal_[0], normal_[1]);
}

inline void Constraints::minimise(const Symmetric3& h, const Vec3& c) {
  const double least = kNoRow * h.trace();
  const auto along = [&](const Vec3& direction) { add(h * direction, -dot(c, direction), least); };
  if (count_ == 0) {
    along({1, 0, 0});
    along({0, 1, 0});
    along({0, 0, 1});
  } else if (count_ == 1) {
    const Vec3 n = normal_[0], side = perpendicular(n);
    along(side);
    along(cross(n, side));
  } else if (count_ == 2) {
    along(1 / length(line_) * line_);
  }
}

inline Vec3 Constraints::point() const {
  const auto& [a, b, c] = normal_;
  const Vec3 bc = cross(b, c);
  const Vec3 sum = offset_[0] * bc + offset_[1] * cross(c, a) + offset_[2] * line_;
  return 1 / dot(a, bc) * sum;
}

}  // namespace wrapatlas
