// The packing so far: a rectangle of cells whose opposite sides may be identified.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/bits.h"
#include "raster/chart_raster.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// Cells seen from both directions: lanes are columns in one view and rows in the other, so that
/// code for one direction serves both. A cell (x, y) is position y of column lane x, and position x
/// of row lane y.
class Board {
 public:
  Board(int width, int height, Wrap wrap);

  [[nodiscard]] int width() const { return columns_.lanes; }
  [[nodiscard]] int height() const { return rows_.lanes; }
  [[nodiscard]] bool wraps_x() const { return wraps_u(wrap_); }
  [[nodiscard]] bool wraps_y() const { return wraps_v(wrap_); }
  [[nodiscard]] const BitLanes& columns() const { return columns_; }
  [[nodiscard]] const BitLanes& rows() const { return rows_; }

  /// Can the chart lie on this board at all: does it fit on the axes that do not wrap, and does it
  /// not cover a cell twice on those that do? Depends on no position.
  [[nodiscard]] bool admits(const ChartRaster& chart) const;

  /// Would the chart with its cell (0,0) at (x, y) leave the board or share a cell with what is
  /// there? Precondition: admits(chart); 0 <= x < width, 0 <= y < height.
  [[nodiscard]] bool collides(const CellViews& chart, int x, int y) const;

  /// Marks the chart's cells. Precondition: !collides(chart, x, y).
  void add(const CellViews& chart, int x, int y);

 private:
  Wrap wrap_;
  BitLanes columns_, rows_;
};

}  // namespace wrapatlas
