#include "validate/crossing.h"

#include <algorithm>

namespace wrapatlas::validate {
namespace {

struct Segment {
  Vec2 left, right;
};

double distance(Vec2 p, const Segment& s) {
  const Vec2 along = s.right - s.left;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - s.left, along) / square, 0.0, 1.0) : 0;
  return length(s.left + t * along - p);
}

bool on_both_sides(const Segment& s, Vec2 p, Vec2 q) {
  const double of_p = signed_area2(s.left, s.right, p), of_q = signed_area2(s.left, s.right, q);
  return (of_p < 0 && of_q > 0) || (of_p > 0 && of_q < 0);
}

/// A crossing can be undone only by taking an end of one segment across the other.
bool cross_clearly(const Segment& a, const Segment& b, double rounding) {
  if (!on_both_sides(a, b.left, b.right) || !on_both_sides(b, a.left, a.right)) return false;
  return std::min({distance(a.left, b), distance(a.right, b), distance(b.left, a),
                   distance(b.right, a)}) > 2 * rounding;
}

}  // namespace

bool crosses_itself(std::span<const Vec2> polygon, double rounding) {
  std::vector<Segment> sides;
  sides.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    sides.push_back(a.x < b.x ? Segment{a, b} : Segment{b, a});
  }
  std::sort(sides.begin(), sides.end(),
            [](const Segment& a, const Segment& b) { return a.left.x < b.left.x; });
  for (auto a = sides.begin(); a != sides.end(); ++a) {
    for (auto b = a + 1; b != sides.end() && b->left.x < a->right.x; ++b) {
      if (cross_clearly(*a, *b, rounding)) return true;
    }
  }
  return false;
}

/// Andrew's monotone chain (1979).
std::vector<Vec2> hull_of(std::span<const Vec2> points) {
  std::vector<Vec2> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(),
            [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Vec2> hull;
  for (const bool back : {false, true}) {
    const std::size_t base = hull.size();
    for (const Vec2 p : sorted) {
      while (hull.size() >= base + 2 && signed_area2(hull[hull.size() - 2], hull.back(), p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // the other chain begins with it
    if (!back) std::reverse(sorted.begin(), sorted.end());
  }
  return hull;
}

}  // namespace wrapatlas::validate
