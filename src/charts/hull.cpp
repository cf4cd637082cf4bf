#include "charts/hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace wrapatlas {
namespace {

/// A corner of a hull that goes around it once while a direction does (Shamos 1978).
class Caliper {
 public:
  explicit Caliper(std::span<const Vec2> hull) : hull_(hull) {}

  /// For what is known of its place, so that rounding cannot leave it behind.
  void at_least(std::size_t corner) { at_ = std::max(at_, corner); }
  [[nodiscard]] std::size_t at() const { return at_ % hull_.size(); }
  [[nodiscard]] std::size_t steps() const { return at_; }

  /// One corner on, if the step to it gains height. Rounding cannot send it around for ever.
  template <typename Height>
  bool advances(const Height& height) {
    const std::size_t n = hull_.size();
    if (at_ >= 3 * n || !(height(hull_[(at_ + 1) % n] - hull_[at_ % n]) > 0)) return false;
    ++at_;
    return true;
  }
  template <typename Height>
  void turn(const Height& height) {
    while (advances(height)) {
    }
  }

 private:
  std::span<const Vec2> hull_;
  std::size_t at_ = 1;
};

}  // namespace

std::vector<Vec2> convex_hull(std::span<const Vec2> points) {
  std::vector<Vec2> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  std::vector<Vec2> hull;
  const auto extend = [&hull](Vec2 p, std::size_t base) {
    while (hull.size() >= base + 2 && signed_area2(hull[hull.size() - 2], hull.back(), p) <= 0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Vec2 p : sorted) extend(p, 0);
  hull.pop_back();
  const std::size_t lower = hull.size();
  for (auto p = sorted.rbegin(); p != sorted.rend(); ++p) extend(*p, lower);
  hull.pop_back();
  return hull;
}

double hull_area(std::span<const Vec2> hull) {
  double twice = 0;
  for (std::size_t i = 2; i < hull.size(); ++i) {
    twice += signed_area2(hull[0], hull[i - 1], hull[i]);
  }
  return twice / 2;
}

double diameter_direction(std::span<const Vec2> hull) {
  const std::size_t n = hull.size();
  if (n < 2) return 0;
  double longest = -1;
  std::pair<std::size_t, std::size_t> ends;
  const auto measure = [&](std::size_t a, std::size_t b) {
    const auto pair = std::minmax({a % n, b % n});
    const Vec2 d = hull[pair.second] - hull[pair.first];
    if (dot(d, d) < longest || (dot(d, d) == longest && ends < pair)) return;
    longest = dot(d, d);
    ends = pair;
  };
  // Two parallel lines with the hull between them touch it in its diameter's ends once, as they
  // are turned around it along one side after the other.
  Caliper opposite(hull);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 side = hull[(i + 1) % n] - hull[i];
    opposite.at_least(i + 2);
    do {
      measure(i, opposite.at());
      measure(i + 1, opposite.at());
    } while (opposite.advances([side](Vec2 step) { return cross(side, step); }));
    measure(i, opposite.at() + 1);  // where it belongs to a side parallel to this one
    measure(i + 1, opposite.at() + 1);
  }
  const Vec2 d = hull[ends.second] - hull[ends.first];
  return std::atan2(d.y, d.x);
}

double smallest_box_direction(std::span<const Vec2> hull) {
  const std::size_t n = hull.size();
  if (n < 2) return 0;
  double smallest = std::numeric_limits<double>::infinity(), direction = 0;
  Caliper right(hull), top(hull), left(hull);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 side = hull[(i + 1) % n] - hull[i];
    right.at_least(i + 1);
    right.turn([side](Vec2 step) { return dot(side, step); });
    top.at_least(std::max(i + 2, right.steps()));
    top.turn([side](Vec2 step) { return cross(side, step); });
    left.at_least(top.steps());
    left.turn([side](Vec2 step) { return -dot(side, step); });
    const double width = dot(side, hull[right.at()] - hull[left.at()]);
    const double height = cross(side, hull[top.at()] - hull[i]);
    const double area = width * height / dot(side, side);
    if (area < smallest) {
      smallest = area;
      direction = std::atan2(side.y, side.x);
    }
  }
  return direction;
}

double square_side(std::span<const Vec2> hull) {
  if (hull.empty()) return 0;
  constexpr int kAngles = 256;  // of a quarter turn: half a step changes a side by 0.3 %
  double side = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kAngles; ++i) {
    const double angle = i * (std::numbers::pi / 2 / kAngles);
    const Vec2 x{std::cos(angle), std::sin(angle)}, y{-x.y, x.x};
    Box2 box;
    for (const Vec2 corner : hull) box.add({dot(corner, x), dot(corner, y)});
    side = std::min(side, std::max(box.size().x, box.size().y));
  }
  return side;
}

}  // namespace wrapatlas
