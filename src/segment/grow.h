// Charts grown from seed faces, and seeds moved to the middle of their charts.
//
// Sander, Wood, Gortler, Snyder & Hoppe, Multi-chart geometry images (SGP 2003), section 3.1.
// What differs: a chart is not kept a disc while it grows. Where its fronts meet, they stay parted
// afterwards, if joining them would make a ring (segment/cut_chart.h); so a chart may lie around a
// limb.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/region.h"

namespace wrapatlas {

struct Growth {
  std::vector<std::uint32_t> seed_of;  ///< per face of the region: the number of its seed
};

/// All charts at once, cheapest step first. A step to a face costs the distance of the centroids
/// times (1.01 - N N'), N the mean normal of the chart so far. The region must be connected, and
/// the seeds be different faces of it. O(n log n).
Growth grow(const Region& region, const FaceShapes& shapes, std::span<const std::uint32_t> seeds);

/// The face of each seed's chart that lies farthest from other charts and from borders.
/// A chart that has neither keeps its seed.
std::vector<std::uint32_t> middles(const Surface& surface, const Region& region,
                                   const FaceShapes& shapes, const Growth& growth,
                                   std::span<const std::uint32_t> seeds);

/// `count` seeds, each new one as far as possible from those before it; fewer if the region is
/// smaller. A face goes over to a new seed only if that is nearer, so later seeds look at ever
/// fewer faces: O(n (log n + count)) but for many steps of no length.
std::vector<std::uint32_t> far_seeds(const Region& region, const FaceShapes& shapes,
                                     std::uint32_t count);

/// Faces that stick out into another chart go over to it, if that makes the border between them
/// shorter, until none does. No chart is parted or lost by it.
void smooth_borders(const Surface& surface, const Region& region, Growth& growth);

/// Grows from `count` seeds that are far apart, then moves seeds to the middles of their charts and
/// grows again, until the seeds repeat or `rounds` are over. Borders are smoothed.
Growth grow_charts(const Surface& surface, const Region& region, const FaceShapes& shapes,
                   std::uint32_t count, int rounds);

}  // namespace wrapatlas
