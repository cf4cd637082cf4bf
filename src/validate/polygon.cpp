#include "validate/polygon.h"

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

  [[nodiscard]] bool convex() const { return reflex_.empty(); }

  void clip(std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::uint32_t at = 0, failures = 0;
    while (left_ > 3 && failures < left_) {
      if (!is_ear(at)) {
        at = next_[at];
        ++failures;
        continue;
      }
      triangles.push_back({previous_[at], at, next_[at]});
      next_[previous_[at]] = next_[at];
      previous_[next_[at]] = previous_[at];
      --left_;
      failures = 0;
      at = next_[at];
      std::erase_if(reflex_, [&](std::uint32_t i) { return turn(previous_[i], i, next_[i]) >= 0; });
    }
    for (std::uint32_t i = next_[at]; next_[i] != at; i = next_[i]) {
      triangles.push_back({at, i, next_[i]});
    }
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

void add_fan(std::uint32_t size, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  for (std::uint32_t i = 1; i + 1 < size; ++i) triangles.push_back({0, i, i + 1});
}

}  // namespace

void cut_into_triangles(std::span<const Vec2> polygon,
                        std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto size = static_cast<std::uint32_t>(polygon.size());
  if (size == 3) {
    add_fan(size, triangles);
    return;
  }
  EarClipper clipper(polygon);
  if (clipper.convex()) {
    add_fan(size, triangles);
  } else {
    clipper.clip(triangles);
  }
}

}  // namespace wrapatlas::validate
