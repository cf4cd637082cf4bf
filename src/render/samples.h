// Pictures made of several samples a pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "wrapatlas/geometry.h"
#include "wrapatlas/view.h"

namespace wrapatlas {

inline constexpr int kSamplesAcross = 3;  ///< of a pixel, and down it

/// Visits (x, y, weights of the corners) of each sample, at whole coordinates, that lies within the
/// triangle, in rows [0, height) and columns [0, width), unless they are negative: no bound.
template <typename Visit>
void for_each_sample(const std::array<Vec2, 3>& corner, int width, int height, Visit&& visit) {
  const double area = signed_area2(corner[0], corner[1], corner[2]);
  if (!(std::abs(area) > 0) || !std::isfinite(area)) return;
  Box2 box;
  for (const Vec2 p : corner) box.add(p);
  constexpr double kFar = 1e6;  // samples; a triangle that reaches farther is not drawn
  if (box.min.x < -kFar || box.min.y < -kFar || box.max.x > kFar || box.max.y > kFar) return;
  int left = static_cast<int>(std::ceil(box.min.x)), top = static_cast<int>(std::ceil(box.min.y));
  int right = static_cast<int>(std::floor(box.max.x));
  int bottom = static_cast<int>(std::floor(box.max.y));
  if (width >= 0) {
    left = std::max(left, 0);
    right = std::min(right, width - 1);
    top = std::max(top, 0);
    bottom = std::min(bottom, height - 1);
  }
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Vec2 p{double(x), double(y)};
      const double a = signed_area2(corner[1], corner[2], p) / area;
      const double b = signed_area2(corner[2], corner[0], p) / area;
      const double c = 1 - a - b;
      if (a >= 0 && b >= 0 && c >= 0) visit(x, y, std::array{a, b, c});
    }
  }
}

/// The mean of the samples of each pixel; `samples` has kSamplesAcross times as many columns, and
/// rows, as the image has.
Image image_of_samples(const std::vector<Color>& samples, int width, int height);

}  // namespace wrapatlas
