// What every packing method is: a way to place all charts of one scale on one grid.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "raster/chart_raster.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// Where one chart went: the cell (0,0) of one of its rasters.
struct CellPlacement {
  std::int32_t rotation = -1;  ///< index among the chart's rasters
  std::int32_t x = 0, y = 0;   ///< cells; within the grid on axes that wrap
};

/// One attempt at one scale.
struct PlaceTask {
  int width = 0, height = 0;  ///< cells of the grid
  Wrap wrap = Wrap::none;
  std::size_t chart_count = 0;
  /// The rasters of a chart, one per angle; stays valid during the attempt.
  std::function<std::span<const ChartRaster>(std::size_t chart)> rasters;
  /// Charts by decreasing area, ties by number.
  std::span<const std::uint32_t> by_area;
  int reach = 0;  ///< no raster is wider or higher
  double lambda = 1.1;
  bool inner = true;
  bool all_sides = false;
  /// Asked once per chart; true abandons the attempt.
  std::function<bool()> stop;
};

/// Places every chart, or returns false with `placements` in an unspecified state. Deterministic.
using PlaceFunction = bool (*)(const PlaceTask& task, std::vector<CellPlacement>& placements);

bool place_modulo(const PlaceTask& task, std::vector<CellPlacement>& placements);
bool place_lprm02(const PlaceTask& task, std::vector<CellPlacement>& placements);
bool place_swg03(const PlaceTask& task, std::vector<CellPlacement>& placements);
bool place_zsgs04(const PlaceTask& task, std::vector<CellPlacement>& placements);

}  // namespace wrapatlas
