// Between the heights of two corners that follow each other, sides do not end: there they lie side
// by side, and the winding number is known from left to right. A trapezoid goes on through as many
// slabs as its two sides stay neighbours.
#include "validate/slabs.h"

#include <algorithm>

namespace wrapatlas::validate {
namespace {

constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

struct Side {
  Vec2 low, high;
  int winding = 0;

  [[nodiscard]] Vec2 at(double y) const {
    const double t = (y - low.y) / (high.y - low.y);
    return {low.x + t * (high.x - low.x), y};
  }
};

class Slabs {
 public:
  Slabs(std::span<const Vec2> polygon, std::vector<Triangle>& triangles) : triangles_(triangles) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i], b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      heights_.push_back(a.y);
      if (a.y < b.y) sides_.push_back({a, b, 1});
      if (b.y < a.y) sides_.push_back({b, a, -1});
    }
    std::sort(heights_.begin(), heights_.end());
    heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
    std::sort(sides_.begin(), sides_.end(),
              [](const Side& a, const Side& b) { return a.low.y < b.low.y; });
    open_.resize(sides_.size());
  }

  void cover() {
    for (std::size_t slab = 0; slab + 1 < heights_.size(); ++slab) {
      meet_sides(heights_[slab], heights_[slab + 1]);
      match_neighbours(heights_[slab], slab);
    }
    for (std::size_t left = 0; left < sides_.size(); ++left) close(left, heights_.back());
  }

 private:
  struct Open {
    std::size_t right = kNobody, slab = 0;
    double from = 0;
  };

  /// The sides of the slab from left to right.
  void meet_sides(double low, double high) {
    std::erase_if(active_, [&](std::size_t i) { return sides_[i].high.y <= low; });
    for (; next_ < sides_.size() && sides_[next_].low.y <= low; ++next_) active_.push_back(next_);
    const double middle = low + 0.5 * (high - low);
    std::stable_sort(active_.begin(), active_.end(), [&](std::size_t i, std::size_t j) {
      return sides_[i].at(middle).x < sides_[j].at(middle).x;
    });
  }

  void match_neighbours(double low, std::size_t slab) {
    int winding = 0;
    for (std::size_t i = 0; i + 1 < active_.size(); ++i) {
      winding += sides_[active_[i]].winding;
      Open& open = open_[active_[i]];
      const std::size_t right = winding != 0 ? active_[i + 1] : kNobody;
      if (open.right != right) {
        close(active_[i], low);
        open = {right, slab, low};
      }
      open.slab = slab;
    }
    std::swap(before_, now_);
    now_.assign(active_.begin(), active_.end());
    for (const std::size_t left : before_) {
      if (open_[left].slab != slab) close(left, low);
    }
  }

  void close(std::size_t left, double high) {
    Open& open = open_[left];
    if (open.right == kNobody) return;
    const Side &l = sides_[left], &r = sides_[open.right];
    triangles_.push_back({l.at(open.from), r.at(open.from), r.at(high)});
    triangles_.push_back({l.at(open.from), r.at(high), l.at(high)});
    open.right = kNobody;
  }

  std::vector<Triangle>& triangles_;
  std::vector<double> heights_;
  std::vector<Side> sides_;
  std::vector<std::size_t> active_, before_, now_;
  std::vector<Open> open_;  ///< per side: the trapezoid to its right
  std::size_t next_ = 0;
};

}  // namespace

void cover_by_slabs(std::span<const Vec2> polygon, std::vector<Triangle>& triangles) {
  Slabs(polygon, triangles).cover();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    triangles.push_back({a, b, b});
  }
}

}  // namespace wrapatlas::validate
