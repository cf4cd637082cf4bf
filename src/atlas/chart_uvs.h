// The UVs of a packed chart's points in the atlas.
#pragma once

#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// u = texel x / width, v = texel y / height of each point of the chart. On axes that wrap they
/// are shifted by whole periods so that the smallest lies in [0,1).
std::vector<Vec2> atlas_uvs(const Chart& chart, const Packing& packing, std::size_t index);

}  // namespace wrapatlas
