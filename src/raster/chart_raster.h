// A chart at an angle and a scale, as cells of the search grid.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "raster/bits.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// The part of a chart that rasterisation reads: border edges, and the few triangles whose winding
/// differs. Built once per chart; cheap to walk for every scale and angle.
struct RasterShape {
  struct Edge {
    std::uint32_t from, to;
    std::int32_t winding;
  };
  std::vector<Vec2> points;  ///< relative to `centre`, input units
  std::vector<Edge> edges;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< covered whatever the winding
  Vec2 centre;         ///< of the chart's box: keeps rotated coordinates small
  bool simple = true;  ///< winding numbers are only 0 and ±1, so that parity decides the inside
};

RasterShape make_raster_shape(const Chart& chart);

/// How grid cells relate to a chart's units.
struct RasterScale {
  Vec2 cells_per_unit;  ///< per axis (they differ by a hair where the grid does not divide evenly)
  double growth = 0;    ///< cells by which the chart is grown on all sides
  Coverage coverage = Coverage::conservative;
};

/// One direction's view of a raster: its columns, or its rows.
struct Silhouette {
  int lanes = 0;   ///< columns (rows)
  int length = 0;  ///< cells of a lane
  /// Horizons: the first covered cell of each lane, then the last one of each; first > last if a
  /// lane is empty. One array, as there are very many silhouettes.
  std::vector<std::int16_t> horizons;
  struct LaneRun {
    std::int32_t begin, end;
  };
  LaneRun run{0, 0};                ///< the lanes with a covered cell, if they are one run
  std::vector<LaneRun> split_runs;  ///< their maximal runs, if they are several
  std::int32_t filled_lanes = 0;    ///< lanes with a covered cell
  std::int32_t sum_first = 0;       ///< over filled lanes
  std::int32_t sum_last = 0;
  std::int32_t hollow = 0;  ///< uncovered cells between the two horizons (Fig. 4, yellow)

  std::int16_t* first() { return horizons.data(); }
  std::int16_t* last() { return horizons.data() + lanes; }
  [[nodiscard]] const std::int16_t* first() const { return horizons.data(); }
  [[nodiscard]] const std::int16_t* last() const { return horizons.data() + lanes; }
  /// Maximal runs of lanes with a covered cell.
  [[nodiscard]] std::span<const LaneRun> filled() const {
    return split_runs.empty() ? std::span(&run, 1) : std::span(split_runs);
  }
};

/// Horizons are 16-bit numbers, and sums of two of them must fit as well.
inline constexpr int kMaxRasterSide = 8192;

struct ChartRaster {
  int width = 0, height = 0;  ///< cells, tight
  std::int64_t cells = 0;     ///< covered
  double angle = 0;           ///< radians
  Vec2 centre;                ///< where RasterShape::centre lies, in cells from cell (0,0)
  Vec2 offset;               ///< cell-space position of chart point p: M p + offset, for cell (0,0)
  Silhouette columns, rows;  ///< the same cells seen along y and along x
  /// The cells, a lane per row, before `turns` quarter turns: many rotations of a chart are looked
  /// at by their silhouettes alone, so cells_of() turns them when they are needed.
  std::shared_ptr<const BitLanes> unturned;
  int turns = 0;
};

/// The cells of a raster from both directions.
struct CellViews {
  BitLanes columns, rows;  ///< a lane per column, a lane per row
};

/// Rasterises a shape. `conservative`: every cell that the shape, grown by a disc of `growth`
/// cells, enters. `center`: every cell whose centre lies in it. A chart that would cover no cell
/// gets the one its box centre lies in. Source: the border is scanned row by row, the inside is
/// filled by winding number at cell centres. A raster longer than `max_side` cells is not made:
/// its width is 0. O(edges * rows they span + cells / 64).
ChartRaster rasterize(const RasterShape& shape, const RasterScale& scale, double angle,
                      int max_side = kMaxRasterSide);

/// The same with `columns` and `rows` left empty, for packers that look at cells alone.
ChartRaster rasterize_cells(const RasterShape& shape, const RasterScale& scale, double angle,
                            int max_side = kMaxRasterSide);

/// The raster of the same chart turned by +90 degrees, for grids of square cells. `angle` is left
/// to the caller. O(width + height).
ChartRaster quarter_turned(const ChartRaster& raster);

/// The cells of a raster that was made (its width is not 0). O(cells / 64).
CellViews cells_of(const ChartRaster& raster);

}  // namespace wrapatlas
