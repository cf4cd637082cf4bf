// The inside of an outline, by winding number at cell centres.
#pragma once

#include <vector>

#include "raster/chart_raster.h"

namespace wrapatlas {

/// Sets the cells whose centres the shape's edges wind around. `points` are those of the shape, in
/// cells, within the rows. Precondition: no cell is set yet.
void fill_inside(const RasterShape& shape, const std::vector<Vec2>& points, BitLanes& rows);

}  // namespace wrapatlas
