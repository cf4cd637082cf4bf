#include "parameterize/untangle.h"

#include <algorithm>
#include <limits>

namespace wrapatlas {
namespace {

constexpr int kRounds = 40;

class Untangler {
 public:
  Untangler(std::span<Vec2> uv, std::span<const std::array<std::uint32_t, 3>> triangles)
      : uv_(uv), triangles_(triangles) {}

  std::uint32_t run() {
    std::vector<std::uint32_t> flipped = all_flipped();
    if (flipped.empty()) return 0;
    list_triangles_of_points();
    for (int round = 0; round < kRounds && !flipped.empty(); ++round) {
      std::vector<std::uint32_t> points;
      for (const std::uint32_t t : flipped) {
        points.insert(points.end(), triangles_[t].begin(), triangles_[t].end());
      }
      sort_out(points);
      if (round > 3) {
        widen(points);
        sort_out(points);
      }
      bool moved = false;
      for (const std::uint32_t p : points) moved = move(p) || moved;
      if (!moved && round > 3) break;
      flipped = flipped_around(points);
    }
    return static_cast<std::uint32_t>(flipped.size());
  }

 private:
  [[nodiscard]] double area(std::uint32_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return signed_area2(uv_[a], uv_[b], uv_[c]);
  }

  [[nodiscard]] std::vector<std::uint32_t> all_flipped() const {
    std::vector<std::uint32_t> flipped;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (area(t) <= 0) flipped.push_back(t);
    }
    return flipped;
  }

  void list_triangles_of_points() {
    begin_.assign(uv_.size() + 1, 0);
    for (const auto& triangle : triangles_) {
      for (const std::uint32_t p : triangle) ++begin_[p + 1];
    }
    for (std::size_t p = 0; p < uv_.size(); ++p) begin_[p + 1] += begin_[p];
    of_point_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t p : triangles_[t]) of_point_[next[p]++] = t;
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> around(std::uint32_t p) const {
    return {of_point_.data() + begin_[p], of_point_.data() + begin_[p + 1]};
  }

  static void sort_out(std::vector<std::uint32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  void widen(std::vector<std::uint32_t>& points) const {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::uint32_t t : around(points[i])) {
        points.insert(points.end(), triangles_[t].begin(), triangles_[t].end());
      }
    }
  }

  [[nodiscard]] double least_area(std::uint32_t p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : around(p)) least = std::min(least, area(t));
    return least;
  }

  bool move(std::uint32_t p) {
    Vec2 sum;
    double count = 0;
    for (const std::uint32_t t : around(p)) {
      for (const std::uint32_t q : triangles_[t]) {
        if (q == p) continue;
        sum = sum + uv_[q];
        ++count;
      }
    }
    const Vec2 from = uv_[p], to = (1 / count) * sum;
    double best = least_area(p);
    Vec2 best_place = from;
    for (const double share : {1.0, 0.5, 0.25, 0.1}) {
      uv_[p] = (1 - share) * from + share * to;
      const double least = least_area(p);
      if (least <= best) continue;
      best = least;
      best_place = uv_[p];
    }
    uv_[p] = best_place;
    return best_place != from;
  }

  [[nodiscard]] std::vector<std::uint32_t> flipped_around(
      std::span<const std::uint32_t> points) const {
    std::vector<std::uint32_t> flipped;
    for (const std::uint32_t p : points) {
      for (const std::uint32_t t : around(p)) {
        if (area(t) <= 0) flipped.push_back(t);
      }
    }
    sort_out(flipped);
    return flipped;
  }

  std::span<Vec2> uv_;
  std::span<const std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> begin_, of_point_;
};

}  // namespace

std::uint32_t untangle(std::span<Vec2> uv,
                       std::span<const std::array<std::uint32_t, 3>> triangles) {
  return Untangler(uv, triangles).run();
}

}  // namespace wrapatlas
