#include "validate/polygon.h"

#include <array>
#include <cstdint>

#include "validate/crossing.h"
#include "validate/slabs.h"

namespace wrapatlas::validate {
namespace {

class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec2> polygon)
      : points_(polygon),
        next_(polygon.size()),
        previous_(polygon.size()),
        left_(static_cast<std::uint32_t>(polygon.size())) {
    double area = 0;
    for (std::uint32_t i = 0; i < left_; ++i) {
      next_[i] = (i + 1) % left_;
      previous_[i] = (i + left_ - 1) % left_;
      area += cross(points_[i] - points_[0], points_[next_[i]] - points_[0]);
    }
    sign_ = area < 0 ? -1 : 1;
    for (std::uint32_t i = 0; i < left_; ++i) {
      if (turn(previous_[i], i, next_[i]) < 0) reflex_.push_back(i);
    }
  }

  /// Sides may also go back the way they came, or around twice: then the fan turns over.
  [[nodiscard]] bool convex() const {
    if (!reflex_.empty()) return false;
    for (std::uint32_t i = 1; i + 1 < left_; ++i) {
      if (turn(0, i, i + 1) < 0) return false;
    }
    return true;
  }

  /// False if no ear is left, or what is left is turned over.
  bool clip(std::vector<Triangle>& triangles) {
    std::uint32_t at = 0, failures = 0;
    while (left_ > 3) {
      if (failures == left_) return false;
      if (!is_ear(at)) {
        at = next_[at];
        ++failures;
        continue;
      }
      triangles.push_back({points_[previous_[at]], points_[at], points_[next_[at]]});
      next_[previous_[at]] = next_[at];
      previous_[next_[at]] = previous_[at];
      --left_;
      failures = 0;
      at = next_[at];
      std::erase_if(reflex_, [&](std::uint32_t i) { return turn(previous_[i], i, next_[i]) >= 0; });
    }
    const std::uint32_t b = next_[at], c = next_[b];
    triangles.push_back({points_[at], points_[b], points_[c]});
    return turn(at, b, c) >= 0;
  }

 private:
  [[nodiscard]] double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return sign_ * signed_area2(points_[a], points_[b], points_[c]);
  }

  [[nodiscard]] bool is_ear(std::uint32_t b) const {
    const std::uint32_t a = previous_[b], c = next_[b];
    if (turn(a, b, c) <= 0) return false;
    for (const std::uint32_t p : reflex_) {
      if (points_[p] == points_[a] || points_[p] == points_[b] || points_[p] == points_[c]) {
        continue;
      }
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::span<const Vec2> points_;
  std::vector<std::uint32_t> next_, previous_, reflex_;
  std::uint32_t left_;
  double sign_ = 1;
};

void add_fan(std::span<const Vec2> polygon, std::vector<Triangle>& triangles) {
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
  }
}

}  // namespace

bool cover_polygon(std::span<const Vec2> polygon, double rounding,
                   std::vector<Triangle>& triangles) {
  if (polygon.size() == 3) {
    add_fan(polygon, triangles);
    return false;
  }
  EarClipper clipper(polygon);
  const bool convex = clipper.convex();
  const bool surely_simple = convex && polygon.size() == 4;
  if (!surely_simple && crosses_itself(polygon, rounding)) {
    add_fan(hull_of(polygon), triangles);
    return true;
  }
  if (convex) {
    add_fan(polygon, triangles);
    return false;
  }
  const std::size_t before = triangles.size();
  if (clipper.clip(triangles)) return false;
  triangles.resize(before);
  cover_by_slabs(polygon, triangles);
  return false;
}

}  // namespace wrapatlas::validate
