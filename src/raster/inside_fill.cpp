#include "raster/inside_fill.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

/// For shapes that overlap or fold: a running sum of winding numbers per row.
class WindingFill {
 public:
  explicit WindingFill(BitLanes& rows)
      : rows_(rows),
        stride_(static_cast<std::size_t>(rows.length)),
        deltas_(stride_ * static_cast<std::size_t>(rows.lanes)) {}
  void cross(int row, int cell, int winding) {
    deltas_[static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>(cell)] += winding;
  }
  void finish() {
    for (int y = 0; y < rows_.lanes; ++y) {
      const std::int32_t* delta = deltas_.data() + static_cast<std::size_t>(y) * stride_;
      std::int32_t winding = 0;
      for (int x = 0; x < rows_.length; ++x) {
        winding += delta[x];
        if (winding != 0) rows_.set(y, x);
      }
    }
  }

 private:
  BitLanes& rows_;
  std::size_t stride_;
  std::vector<std::int32_t> deltas_;
};

/// For clean shapes, by parity: crossings toggle bits, a prefix-xor spreads them.
class ParityFill {
 public:
  explicit ParityFill(BitLanes& rows) : rows_(rows) {}
  void cross(int row, int cell, int winding) {
    rows_.lane(row)[cell / kWordBits] ^= static_cast<std::uint64_t>(winding & 1)
                                         << (cell % kWordBits);
  }
  void finish() {
    const int spare = rows_.words * kWordBits - rows_.length;
    for (int y = 0; y < rows_.lanes; ++y) {
      std::uint64_t* lane = rows_.lane(y);
      std::uint64_t carry = 0;
      for (int word = 0; word < rows_.words; ++word) {
        std::uint64_t bits = lane[word];
        for (unsigned shift = 1; shift < 64; shift *= 2) bits ^= bits << shift;
        bits ^= carry;
        carry = std::uint64_t{0} - (bits >> 63U);
        lane[word] = bits;
      }
      lane[rows_.words - 1] &= ~std::uint64_t{0} >> spare;
    }
  }

 private:
  BitLanes& rows_;
};

/// Calls cross(row, cell, winding) for each row whose middle an edge crosses, with the first cell
/// of the row whose centre lies right of the crossing; not if there is no such cell.
template <typename Fill>
void scan_edges(const RasterShape& shape, const std::vector<Vec2>& points, const BitLanes& rows,
                Fill& fill) {
  // The first row whose middle is not below a point. An edge crosses the rows between its two.
  thread_local std::vector<int> row_above;
  row_above.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    row_above[i] = std::clamp(static_cast<int>(std::ceil(points[i].y - 0.5)), 0, rows.lanes);
  }
  for (const RasterShape::Edge& edge : shape.edges) {
    if (row_above[edge.from] == row_above[edge.to]) continue;
    const bool rises = row_above[edge.from] < row_above[edge.to];
    const std::uint32_t lower = rises ? edge.from : edge.to, upper = rises ? edge.to : edge.from;
    const Vec2 low = points[lower], high = points[upper];
    const double slope = (high.x - low.x) / (high.y - low.y);
    for (int y = row_above[lower]; y < row_above[upper]; ++y) {
      const double x = low.x + (y + 0.5 - low.y) * slope;
      const int cell = std::max(0, static_cast<int>(std::ceil(x - 0.5)));
      if (cell < rows.length) fill.cross(y, cell, rises ? edge.winding : -edge.winding);
    }
  }
  fill.finish();
}

}  // namespace

void fill_inside(const RasterShape& shape, const std::vector<Vec2>& points, BitLanes& rows) {
  if (shape.simple) {
    ParityFill fill(rows);
    scan_edges(shape, points, rows, fill);
  } else {
    WindingFill fill(rows);
    scan_edges(shape, points, rows, fill);
  }
}

}  // namespace wrapatlas
