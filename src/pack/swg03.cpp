// The packer of P. Sander, Z. Wood, S. Gortler, J. Snyder, H. Hoppe: "Multi-Chart Geometry Images",
// SGP 2003, section 4.
//
// Charts by decreasing area; each is dropped onto the horizon at every rotation and column, and
// rests where the wasted space is least: the gap between horizon and chart, plus the hollow within
// the chart's own silhouette (Fig. 4 of Noell & Stricker, green and yellow).
//
// Departures: the domain is fixed and a chart must stay within it; 16 rotations by default, as in
// Noell & Stricker's comparison. Of equal places the first rotation and column is taken.

#include <limits>

#include "pack/placer.h"
#include "pack/skyline.h"

namespace wrapatlas {

bool place_swg03(const PlaceTask& task, std::vector<CellPlacement>& placements) {
  placements.assign(task.chart_count, {});
  Skyline skyline(task.width, task.height, task.reach);
  for (const std::uint32_t chart : task.by_area) {
    if (task.stop()) return false;
    const std::span<const ChartRaster> rasters = task.rasters(chart);
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    CellPlacement& best = placements[chart];
    for (std::size_t i = 0; i < rasters.size(); ++i) {
      if (rasters[i].columns.hollow >= least) continue;  // no gap can make up for it
      const Rest drop = skyline.best_drop(rasters[i]);
      if (drop.shift < 0 || drop.gap + rasters[i].columns.hollow >= least) continue;
      least = drop.gap + rasters[i].columns.hollow;
      best = {static_cast<std::int32_t>(i), drop.shift, drop.position};
    }
    if (best.rotation < 0) return false;
    skyline.add(rasters[static_cast<std::size_t>(best.rotation)], best.x, best.y);
  }
  return true;
}

}  // namespace wrapatlas
