// The UVs of a packed chart's points in the atlas.
#pragma once

#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// A packing may reach over a side that does not wrap by this much of it, by rounding.
inline constexpr double kOutside = 1e-9;

/// u = texel x / width, v = texel y / height of each point of the chart. On axes that wrap they
/// are shifted by whole periods so that the smallest lies in [0,1); of several pages so that it
/// still does once it was moved to its tile and rounded to float. With `v_points_down` and several
/// pages that holds for 1 - v.
std::vector<Vec2> atlas_uvs(const Chart& chart, const Packing& packing, std::size_t index,
                            bool v_points_down);

/// What has to be added to UVs for them to lie on the tile of the chart's page.
Vec2 tile_offset(const Packing& packing, std::size_t index, bool v_points_down);

}  // namespace wrapatlas
