#include "validate/triangle_pair.h"

#include <vector>

namespace wrapatlas::validate {
namespace {

struct Interval {
  double lo, hi;
};

Interval shadow(const Triangle& t, Vec2 axis, Vec2 origin) {
  const double a = dot(axis, t[0] - origin);
  const double b = dot(axis, t[1] - origin);
  const double c = dot(axis, t[2] - origin);
  return {std::min(a, std::min(b, c)), std::max(a, std::max(b, c))};
}

Vec2 nearest_on_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  if (!(square > 0)) return a;
  return a + std::clamp(dot(p - a, along) / square, 0.0, 1.0) * along;
}

bool strictly_inside(Vec2 p, const Triangle& t) {
  const double a = signed_area2(t[0], t[1], p);
  const double b = signed_area2(t[1], t[2], p);
  const double c = signed_area2(t[2], t[0], p);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

bool cross_properly(Vec2 a, Vec2 b, Vec2 c, Vec2 d, Vec2& at) {
  const double to_c = signed_area2(a, b, c), to_d = signed_area2(a, b, d);
  const double to_a = signed_area2(c, d, a), to_b = signed_area2(c, d, b);
  if (!((to_c > 0) != (to_d > 0) && (to_a > 0) != (to_b > 0))) return false;
  if (to_c == 0 || to_d == 0 || to_a == 0 || to_b == 0) return false;
  at = a + to_a / (to_a - to_b) * (b - a);
  return true;
}

}  // namespace

double overlap_depth(const Triangle& a, const Triangle& b, double tolerance) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle* owner : {&a, &b}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 origin = (*owner)[i];
      const Vec2 edge = (*owner)[(i + 1) % 3] - origin;
      const double square = dot(edge, edge);
      if (!(square > 0)) continue;
      const Vec2 axis{-edge.y, edge.x};
      const Interval of_a = shadow(a, axis, origin), of_b = shadow(b, axis, origin);
      const double common = std::min(of_a.hi, of_b.hi) - std::max(of_a.lo, of_b.lo);
      if (!(common > 0) || common * common <= tolerance * tolerance * square) return 0;
      least = std::min(least, common * common / square);
    }
  }
  return least < std::numeric_limits<double>::infinity() ? std::sqrt(least) : 0;
}

bool surely_apart(const Triangle& a, const Triangle& b, double distance) {
  const double squared = distance * distance * (1 + 1e-9);
  for (const Triangle* owner : {&a, &b}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 origin = (*owner)[i];
      const Vec2 edge = (*owner)[(i + 1) % 3] - origin;
      const Vec2 axis{-edge.y, edge.x};
      const Interval of_a = shadow(a, axis, origin), of_b = shadow(b, axis, origin);
      const double gap = std::max(of_a.lo, of_b.lo) - std::min(of_a.hi, of_b.hi);
      if (gap > 0 && gap * gap > squared * dot(edge, edge)) return true;
    }
  }
  return false;
}

Closest closest_points(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (strictly_inside(a[i], b)) return {0, a[i], a[i]};
    if (strictly_inside(b[i], a)) return {0, b[i], b[i]};
    for (std::size_t j = 0; j < 3; ++j) {
      Vec2 at;
      if (cross_properly(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], at)) return {0, at, at};
    }
  }
  Closest best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec2 on_b = nearest_on_segment(a[i], b[j], b[(j + 1) % 3]);
      if (const Vec2 way = on_b - a[i]; dot(way, way) < least) {
        least = dot(way, way);
        best = {0, a[i], on_b};
      }
      const Vec2 on_a = nearest_on_segment(b[j], a[i], a[(i + 1) % 3]);
      if (const Vec2 way = on_a - b[j]; dot(way, way) < least) {
        least = dot(way, way);
        best = {0, on_a, b[j]};
      }
    }
  }
  best.distance = std::sqrt(least);
  return best;
}

Vec2 middle_of_overlap(const Triangle& a, const Triangle& b) {
  std::vector<Vec2> shape(a.begin(), a.end()), kept;
  const double turn = signed_area2(b[0], b[1], b[2]) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 from = b[i], to = b[(i + 1) % 3];
    kept.clear();
    for (std::size_t j = 0; j < shape.size(); ++j) {
      const Vec2 p = shape[j], q = shape[(j + 1) % shape.size()];
      const double side_p = turn * signed_area2(from, to, p);
      const double side_q = turn * signed_area2(from, to, q);
      if (side_p >= 0) kept.push_back(p);
      if ((side_p >= 0) != (side_q >= 0)) kept.push_back(p + side_p / (side_p - side_q) * (q - p));
    }
    shape.swap(kept);
  }
  if (shape.empty()) return closest_points(a, b).on_a;
  Vec2 sum;
  for (const Vec2 p : shape) sum = sum + p;
  return 1.0 / static_cast<double>(shape.size()) * sum;
}

bool touches_box(const Triangle& t, const Box2& box) {
  Box2 own;
  for (const Vec2 p : t) own.add(p);
  if (own.min.x > box.max.x || own.max.x < box.min.x) return false;
  if (own.min.y > box.max.y || own.max.y < box.min.y) return false;
  const Vec2 middle = 0.5 * (box.min + box.max), half = 0.5 * (box.max - box.min);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 edge = t[(i + 1) % 3] - t[i];
    const Vec2 axis{-edge.y, edge.x};
    const double at = dot(axis, middle - t[i]);
    const double reach = std::abs(axis.x) * half.x + std::abs(axis.y) * half.y;
    const double opposite = dot(axis, t[(i + 2) % 3] - t[i]);
    const double slack = 1e-9 * (std::abs(at) + reach);
    if (at + reach + slack < std::min(0.0, opposite)) return false;
    if (at - reach - slack > std::max(0.0, opposite)) return false;
  }
  return true;
}

}  // namespace wrapatlas::validate
