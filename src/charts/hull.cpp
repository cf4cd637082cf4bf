#include "charts/hull.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {

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

double diameter_direction(std::span<const Vec2> hull) {
  double longest = -1, direction = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      const Vec2 d = hull[j] - hull[i];
      if (dot(d, d) > longest) {
        longest = dot(d, d);
        direction = std::atan2(d.y, d.x);
      }
    }
  }
  return direction;
}

double smallest_box_direction(std::span<const Vec2> hull) {
  double smallest = std::numeric_limits<double>::infinity(), direction = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
    const double norm = length(side);
    if (norm == 0) continue;
    Box2 box;
    for (const Vec2 p : hull) box.add({dot(side, p) / norm, cross(side, p) / norm});
    const double area = box.size().x * box.size().y;
    if (area < smallest) {
      smallest = area;
      direction = std::atan2(side.y, side.x);
    }
  }
  return direction;
}

}  // namespace wrapatlas
