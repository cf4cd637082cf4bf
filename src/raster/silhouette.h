// Horizons of cells, from both directions.
#pragma once

#include "raster/chart_raster.h"

namespace wrapatlas {

/// What the cells look like from the ends of their lanes. `cells`: how many are set.
Silhouette lane_silhouette(const BitLanes& cells_by_row, std::int64_t cells);

/// The same across the lanes: what lane_silhouette would say of the transposed cells, without
/// transposing them. O(cells / 64 + lanes + length).
Silhouette cross_silhouette(const BitLanes& cells_by_row, std::int64_t cells);

}  // namespace wrapatlas
