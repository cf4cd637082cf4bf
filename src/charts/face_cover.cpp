#include "charts/face_cover.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "charts/hull.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A triangle turned over by less than this share of the polygon's box is so by rounding.
constexpr double kNoise = 1e-12;

double area_of(std::span<const Vec2> polygon) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    area += signed_area2(polygon[0], polygon[i], polygon[i + 1]);
  }
  return area;
}

bool any_turned_over(std::span<const Vec2> polygon, const Triangles& triangles) {
  const double sign = area_of(polygon) < 0 ? -1 : 1;
  Box2 box;
  for (const Vec2 p : polygon) box.add(p);
  const double noise = kNoise * dot(box.size(), box.size());
  return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
    return sign * signed_area2(polygon[t[0]], polygon[t[1]], polygon[t[2]]) < -noise;
  });
}

bool cross_inside(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto apart = [](double s, double t) { return (s < 0 && t > 0) || (s > 0 && t < 0); };
  return apart(signed_area2(a, b, c), signed_area2(a, b, d)) &&
         apart(signed_area2(c, d, a), signed_area2(c, d, b));
}

bool sides_cross(std::span<const Vec2> polygon) {
  const std::size_t count = polygon.size();
  const auto end_of = [&](std::size_t side) { return polygon[(side + 1) % count]; };
  const auto left_of = [&](std::size_t side) { return std::min(polygon[side].x, end_of(side).x); };
  std::vector<std::size_t> sides(count);
  std::iota(sides.begin(), sides.end(), std::size_t{0});
  std::sort(sides.begin(), sides.end(), [&](std::size_t i, std::size_t j) {
    return std::tuple(left_of(i), i) < std::tuple(left_of(j), j);
  });
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = polygon[sides[i]], b = end_of(sides[i]);
    const double right = std::max(a.x, b.x);
    for (std::size_t j = i + 1; j < count && left_of(sides[j]) < right; ++j) {
      if (cross_inside(a, b, polygon[sides[j]], end_of(sides[j]))) return true;
    }
  }
  return false;
}

Triangles hull_of(std::span<const Vec2> polygon) {
  std::vector<std::uint32_t> order(polygon.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [](Vec2 a, Vec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return before(polygon[i], polygon[j]);
  });
  std::vector<std::uint32_t> hull;
  for (const Vec2 p : convex_hull(polygon)) {
    hull.push_back(
        *std::lower_bound(order.begin(), order.end(), p,
                          [&](std::uint32_t i, Vec2 value) { return before(polygon[i], value); }));
  }
  if (area_of(polygon) < 0) std::reverse(hull.begin(), hull.end());
  Triangles triangles;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    triangles.push_back({hull[0], hull[i], hull[i + 1]});
  }
  return triangles;
}

}  // namespace

bool cover_face(std::span<const Vec2> polygon, Triangles& triangles) {
  Triangles cut;
  triangulate_polygon(polygon, cut);
  // A triangle cannot cross itself, and two that are not turned over lie beside each other.
  const bool crosses = polygon.size() > 3 && (any_turned_over(polygon, cut) ||
                                              (polygon.size() > 4 && sides_cross(polygon)));
  if (crosses) {
    const Triangles hull = hull_of(polygon);
    if (!hull.empty()) cut = hull;
  }
  triangles.insert(triangles.end(), cut.begin(), cut.end());
  return crosses;
}

}  // namespace wrapatlas
