// The packer of B. Levy, S. Petitjean, N. Ray, J. Maillot: "Least Squares Conformal Maps for
// Automatic Texture Atlas Generation", SIGGRAPH 2002, section 4.
//
// One orientation per chart, its longest diameter upright; charts by decreasing height; each is
// dropped onto the horizon where the area lost between the two is least.
//
// Departures: the publication fills a strip of open height at a given scale; here the domain is
// fixed, as for all methods of this program, a chart must stay within it, and the scale is searched
// from outside. Of equal places the first is taken.

#include <algorithm>
#include <numeric>

#include "pack/placer.h"
#include "pack/skyline.h"

namespace wrapatlas {

bool place_lprm02(const PlaceTask& task, std::vector<CellPlacement>& placements) {
  placements.assign(task.chart_count, {});
  std::vector<std::uint32_t> by_height(task.by_area.begin(), task.by_area.end());
  std::stable_sort(by_height.begin(), by_height.end(), [&](std::uint32_t a, std::uint32_t b) {
    return task.rasters(a)[0].height > task.rasters(b)[0].height;
  });
  Skyline skyline(task.width, task.height, task.reach);
  for (const std::uint32_t chart : by_height) {
    if (task.stop()) return false;
    const ChartRaster& raster = task.rasters(chart)[0];
    const Rest drop = skyline.best_drop(raster);
    if (drop.shift < 0) return false;
    placements[chart] = {0, drop.shift, drop.position};
    skyline.add(raster, drop.shift, drop.position);
  }
  return true;
}

}  // namespace wrapatlas
