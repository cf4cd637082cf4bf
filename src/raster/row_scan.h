// Rows of cells that segments, capsules and triangles cover. One closed form per row, no per-cell
// tests. Row y is the band [y, y + 1]; cell x of it is the square [x, x + 1] x [y, y + 1].
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/bits.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// Closed interval of x; empty until something is added.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  [[nodiscard]] bool empty() const { return low > high; }
};

/// x extent of a segment within row y.
inline Interval segment_in_band(Vec2 a, Vec2 b, int y) {
  if (a.y > b.y) std::swap(a, b);
  const double bottom = y, top = y + 1.0;
  if (b.y < bottom || a.y > top) return {};
  double x0 = a.x, x1 = b.x;
  if (a.y < bottom) x0 = a.x + (b.x - a.x) * ((bottom - a.y) / (b.y - a.y));
  if (b.y > top) x1 = a.x + (b.x - a.x) * ((top - a.y) / (b.y - a.y));
  return {std::min(x0, x1), std::max(x0, x1)};
}

/// x extent of a segment on the line at height y.
inline Interval segment_at(Vec2 a, Vec2 b, double y) {
  if (a.y > b.y) std::swap(a, b);
  if (y < a.y || y > b.y) return {};
  if (a.y == b.y) return {std::min(a.x, b.x), std::max(a.x, b.x)};
  const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
  return {x, x};
}

/// Sets the cells of row y that the interval enters.
inline void set_entered(BitLanes& rows, int y, const Interval& x) {
  if (x.empty()) return;
  const int begin = std::max(0, static_cast<int>(std::floor(x.low)));
  const int end = std::min(rows.length, std::max(static_cast<int>(std::ceil(x.high)), begin + 1));
  if (begin < end) set_span(rows.lane(y), begin, end);
}

/// Sets the cells of row y whose centres lie in the interval.
inline void set_centres(BitLanes& rows, int y, const Interval& x) {
  if (x.empty()) return;
  const int begin = std::max(0, static_cast<int>(std::ceil(x.low - 0.5)));
  const int end = std::min(rows.length, static_cast<int>(std::floor(x.high - 0.5)) + 1);
  if (begin < end) set_span(rows.lane(y), begin, end);
}

/// The row a height lies in, clamped to the raster.
inline int row_of(double y, const BitLanes& rows) {
  return std::clamp(static_cast<int>(std::floor(y)), 0, rows.lanes - 1);
}

/// Cells entered by the segment ab grown by a disc.
void cover_capsule(Vec2 a, Vec2 b, double radius, BitLanes& rows);

/// Cells whose centres lie within `radius` of the segment ab.
void cover_capsule_centres(Vec2 a, Vec2 b, double radius, BitLanes& rows);

}  // namespace wrapatlas
