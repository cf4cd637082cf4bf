// Pictures made of several samples a pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "render/coverage.h"
#include "wrapatlas/geometry.h"
#include "wrapatlas/view.h"

namespace wrapatlas {

inline constexpr int kSamplesAcross = 3;         ///< of a pixel, and down it
inline constexpr double kFarthestSample = 1e6;   ///< beyond any picture
inline constexpr double kFarthestCorner = 1e12;  ///< where edges are known to a thousandth still

/// Visits (y, begin, end) for each row of samples within `bounds` that a triangle has any of: those
/// at whole x in [begin, end). A sample on an edge belongs to one side of it alone, so triangles
/// that share an edge leave no gap and nothing is visited twice. Triangles of no area, or with a
/// corner beyond kFarthestCorner, have no samples. O(rows), however long and thin the triangle
/// lies.
template <typename Visit>
void for_each_span(const std::array<Vec2, 3>& corner, const PixelBox& bounds, Visit&& visit) {
  if (signed_area2(corner[0], corner[1], corner[2]) == 0) return;
  Box2 box;
  for (const Vec2 p : corner) {
    const bool usable = std::abs(p.x) <= kFarthestCorner && std::abs(p.y) <= kFarthestCorner;
    if (!usable) return;  // NaN as well
    box.add(p);
  }
  const auto first = [](double position) {
    return static_cast<int>(std::ceil(std::clamp(position, -kFarthestSample, kFarthestSample)));
  };
  const int bottom = std::min(bounds.bottom, first(box.max.y));
  for (int y = std::max(bounds.top, first(box.min.y)); y < bottom; ++y) {
    double left = box.max.x, right = box.min.x;
    for (std::size_t i = 0; i < 3; ++i) {
      // From above, whichever way the edge runs: both its triangles then round alike.
      Vec2 from = corner[i], to = corner[(i + 1) % 3];
      if (from.y > to.y) std::swap(from, to);
      if (y < from.y || y >= to.y) continue;
      const double x = from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const int begin = std::max(bounds.left, first(left));
    const int end = std::min(bounds.right, first(right));
    if (begin < end) visit(y, begin, end);
  }
}

/// The mean of the samples of each pixel; `samples` has kSamplesAcross times as many columns, and
/// rows, as the image has.
Image image_of_samples(const std::vector<Color>& samples, int width, int height);

}  // namespace wrapatlas
