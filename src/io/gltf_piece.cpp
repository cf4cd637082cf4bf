// Triangles of one piece of a cut face.
#include <algorithm>
#include <limits>

#include "io/gltf_layers.h"

namespace wrapatlas {
namespace {

constexpr std::size_t kLargestExact = 40;

/// Of all triangulations of the polygon, the one whose smallest triangle is largest: dynamic
/// programming over its diagonals (Gilbert 1979; Klincsek 1980, for other weights). O(k^3).
class BestTriangulation {
 public:
  BestTriangulation(const std::vector<Vec2>& points, double sign)
      : points_(points),
        sign_(sign),
        count_(points.size()),
        smallest_(count_ * count_, std::numeric_limits<double>::infinity()),
        apex_(count_ * count_) {
    for (std::size_t span = 2; span < count_; ++span) {
      for (std::size_t i = 0; i + span < count_; ++i) choose(i, i + span);
    }
  }

  void collect(std::size_t i, std::size_t j,
               std::vector<std::array<std::uint32_t, 3>>& triangles) const {
    if (j < i + 2) return;
    const std::size_t k = apex_[i * count_ + j];
    collect(i, k, triangles);
    collect(k, j, triangles);
    triangles.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k),
                         static_cast<std::uint32_t>(j)});
  }

 private:
  void choose(std::size_t i, std::size_t j) {
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t k = i + 1; k < j; ++k) {
      const double area = sign_ * signed_area2(points_[i], points_[k], points_[j]);
      const double smallest =
          std::min({area, smallest_[i * count_ + k], smallest_[k * count_ + j]});
      if (smallest <= best) continue;
      best = smallest;
      apex_[i * count_ + j] = k;
    }
    smallest_[i * count_ + j] = best;
    if (apex_[i * count_ + j] == 0) apex_[i * count_ + j] = i + 1;
  }

  const std::vector<Vec2>& points_;
  double sign_;
  std::size_t count_;
  std::vector<double> smallest_;
  std::vector<std::size_t> apex_;
};

}  // namespace

void triangulate_piece(const std::vector<Vec2>& points,
                       std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (points.size() == 3) {
    triangles.push_back({0, 1, 2});
    return;
  }
  if (points.size() > kLargestExact) {
    triangulate_polygon(points, triangles);
    return;
  }
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    area += cross(points[i], points[(i + 1) % points.size()]);
  }
  BestTriangulation(points, area < 0 ? -1 : 1).collect(0, points.size() - 1, triangles);
}

}  // namespace wrapatlas
