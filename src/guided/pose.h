// Where a chart lies in the plane, and small corrections of it.
#pragma once

#include <cmath>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// p -> R(angle) p + shift.
struct Pose {
  double angle = 0;
  Vec2 shift;

  /// What it does to points, and to directions: for many of them, as it takes sine and cosine.
  [[nodiscard]] Similarity map() const { return Similarity::from(1, angle, shift); }
  [[nodiscard]] Similarity turn() const { return Similarity::from(1, angle, {}); }
  [[nodiscard]] Vec2 turned(Vec2 p) const { return turn().apply(p); }
  [[nodiscard]] Vec2 apply(Vec2 p) const { return map().apply(p); }
  /// First `inner`, then this.
  [[nodiscard]] Pose after(const Pose& inner) const {
    return {angle + inner.angle, apply(inner.shift)};
  }
  [[nodiscard]] Pose inverse() const {
    const Pose back{-angle, {}};
    return {-angle, -1.0 * back.turned(shift)};
  }
};

/// Least squares for the small motion that takes points to lines: along a line they move almost
/// freely, as nothing says which of its points is theirs.
class MotionFit {
 public:
  explicit MotionFit(Vec2 pivot) : pivot_(pivot) {}

  /// `point` should come to lie on the line through `target` along the unit vector `along`.
  void add(Vec2 point, Vec2 target, Vec2 along) {
    constexpr double kAlong = 0.05;
    add_row(point, target, {-along.y, along.x}, 1);
    add_row(point, target, along, kAlong);
  }
  /// The motion, to be applied after the pose it corrects.
  [[nodiscard]] Pose solve() const;

 private:
  void add_row(Vec2 point, Vec2 target, Vec2 normal, double weight);

  Vec2 pivot_;
  double a_[3][3] = {}, b_[3] = {};
};

}  // namespace wrapatlas
