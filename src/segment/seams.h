// Seams within a chart: cuts from its border to where it would shrink, as an artist cuts along a
// limb.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/cut_chart.h"

namespace wrapatlas {

/// Of a sphere: a cut between two points that lie far apart. Corners of the surface, both of each
/// edge, ascending.
std::vector<std::uint32_t> cut_open(const Surface& surface, const Region& region,
                                    const CutChart& disc);

/// Of a disc that was flattened to `uv` (area as in space): cuts from its border to the middles of
/// those parts whose area is below `low` times what it should be. Empty if there is none away from
/// the border. Corners as above. O(n log n) for each cut.
std::vector<std::uint32_t> seams_to_shrunk(const Surface& surface, const Region& region,
                                           const CutChart& disc, std::span<const Vec2> uv,
                                           double low);

}  // namespace wrapatlas
