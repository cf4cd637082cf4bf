// Where a chart lies in the plane, and small corrections of it.
#pragma once

#include <cmath>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// p -> R(angle) p + shift.
struct Pose {
  double angle = 0;
  Vec2 shift;

  [[nodiscard]] Vec2 turned(Vec2 p) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
  }
  [[nodiscard]] Vec2 apply(Vec2 p) const { return turned(p) + shift; }
  /// First `inner`, then this.
  [[nodiscard]] Pose after(const Pose& inner) const {
    return {angle + inner.angle, apply(inner.shift)};
  }
  [[nodiscard]] Pose inverse() const {
    const Pose back{-angle, {}};
    return {-angle, -1.0 * back.turned(shift)};
  }
};

/// What a pose does to points, for many of them.
class PoseMap {
 public:
  explicit PoseMap(const Pose& pose)
      : cosine_(std::cos(pose.angle)), sine_(std::sin(pose.angle)), shift_(pose.shift) {}

  [[nodiscard]] Vec2 turned(Vec2 p) const {
    return {cosine_ * p.x - sine_ * p.y, sine_ * p.x + cosine_ * p.y};
  }
  [[nodiscard]] Vec2 apply(Vec2 p) const { return turned(p) + shift_; }

 private:
  double cosine_, sine_;
  Vec2 shift_;
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
