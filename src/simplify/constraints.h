// Lindstrom & Turk 1998, vertex placement: up to three planes that a point must lie in,
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
///
/// Kept as a point in all of them, and an orthonormal basis of the directions in which it may still
/// be moved.
class Constraints {
 public:
  [[nodiscard]] bool complete() const { return free_ == 0; }

  /// A normal whose square is no more than `least2` is rounding, and the plane is left out.
  void add(const Vec3& normal, double offset, double least2 = 0) {
    const double size2 = dot(normal, normal);
    if (!(size2 > least2)) return;
    if (free_ == 3) return add_first(normal, size2, offset);
    const double missing = offset - dot(normal, point_);
    if (free_ == 2) return add_second(normal, size2, missing);
    if (free_ == 1) return add_third(normal, size2, missing);
  }

  /// Those of the planes grad(½vᵀHv + cᵀv) = 0 that the directions left free allow.
  void minimise(const Symmetric3& h, const Vec3& c) {
    const double least = kNoRow * h.trace();
    const std::array<Vec3, 3> directions = direction_;
    for (int i = 0, count = free_; i < count; ++i) {
      const Vec3& along = directions[i];
      add(h * along, -dot(c, along), least * least);
    }
  }

  /// Needs complete().
  [[nodiscard]] const Vec3& point() const { return point_; }

 private:
  static constexpr double kSinAlpha2 = 3.0458649045213493e-4;  ///< squared, of 1 degree
  static constexpr double kNoRow = 1e-12;  ///< of a matrix' trace: rows shorter are rounding

  void add_first(const Vec3& normal, double size2, double offset) {
    point_ = offset / size2 * normal;
    direction_[0] = perpendicular(normal);
    direction_[1] = 1 / std::sqrt(size2) * cross(normal, direction_[0]);
    free_ = 2;
  }

  void add_second(const Vec3& normal, double size2, double missing) {
    const Vec3 a = direction_[0], b = direction_[1];
    const double x = dot(normal, a), y = dot(normal, b), free2 = x * x + y * y;
    if (!(free2 > kSinAlpha2 * size2)) return;
    point_ = point_ + missing / free2 * (x * a + y * b);
    direction_[0] = 1 / std::sqrt(free2) * (x * b - y * a);
    free_ = 1;
  }

  void add_third(const Vec3& normal, double size2, double missing) {
    const double along = dot(normal, direction_[0]);
    if (!(along * along > kSinAlpha2 * size2)) return;
    point_ = point_ + missing / along * direction_[0];
    free_ = 0;
  }

  Vec3 point_;
  std::array<Vec3, 3> direction_{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  int free_ = 3;  ///< of the directions
};

}  // namespace wrapatlas
