// The packer of K. Zhou, J. Snyder, B. Guo, H.-Y. Shum: "Iso-charts: Stretch-driven Mesh
// Parameterization using Spectral Analysis", SGP 2004, section 7.
//
// As swg03, but charts come from all four sides: the packing grows around its first chart, and for
// each chart the pair of sides is chosen on which growth brings the packing's extent nearer to the
// shape of the domain; the better side of the pair takes it.
//
// Departures and readings: the domain is fixed, so the extent must stay within w x h. A chart stays
// within the other axis' extent where it can, and covers it where it is longer. A lane that holds
// nothing ends at the far side of the extent. If neither side of the pair takes the chart, the
// other pair is tried. `all_sides` tries all four for every chart and takes the least waste.

#include <algorithm>
#include <limits>

#include "pack/board.h"
#include "pack/placer.h"
#include "pack/slide.h"

namespace wrapatlas {
namespace {

/// One axis of the packing's extent: [begin, end), empty at first.
struct Span {
  int begin = 0, end = 0;
  [[nodiscard]] int size() const { return end - begin; }
};

struct Choice {
  std::int32_t waste = std::numeric_limits<std::int32_t>::max();
  CellPlacement placement;
};

class FourSides {
 public:
  /// The board is twice the domain, so that the packing can grow either way from its middle.
  explicit FourSides(const PlaceTask& task)
      : task_(task), board_(2 * task.width, 2 * task.height, Wrap::none) {
    channel_x_.resize(2 * task.width, task.reach);
    channel_y_.resize(2 * task.height, task.reach);
    extent_x_ = {task.width, task.width};
    extent_y_ = {task.height, task.height};
  }

  bool place(std::span<const ChartRaster> rasters, CellPlacement& placement) {
    const bool grow_y = static_cast<std::int64_t>(extent_y_.size()) * task_.width <=
                        static_cast<std::int64_t>(extent_x_.size()) * task_.height;
    Choice choice;
    try_pair(rasters, grow_y, choice);
    if (choice.placement.rotation < 0 || task_.all_sides) try_pair(rasters, !grow_y, choice);
    if (choice.placement.rotation < 0) return false;
    placement = choice.placement;
    const ChartRaster& raster = rasters[static_cast<std::size_t>(placement.rotation)];
    board_.add(cells_of(raster), placement.x, placement.y);
    stretch(extent_x_, placement.x, raster.width);
    stretch(extent_y_, placement.y, raster.height);
    return true;
  }

  [[nodiscard]] CellPlacement origin() const { return {0, extent_x_.begin, extent_y_.begin}; }

 private:
  void try_pair(std::span<const ChartRaster> rasters, bool along_y, Choice& choice) {
    Channel& channel = along_y ? channel_x_ : channel_y_;
    const BitLanes& lanes = along_y ? board_.columns() : board_.rows();
    const Span along = along_y ? extent_y_ : extent_x_;
    const Span across = along_y ? extent_x_ : extent_y_;
    const int along_limit = along_y ? task_.height : task_.width;
    const int across_limit = along_y ? task_.width : task_.height;
    for (const bool up : {false, true}) {
      fill_channel(channel, lanes, along, along_limit, up);
      for (std::size_t i = 0; i < rasters.size(); ++i) {
        if (rasters[i].width == 0) continue;
        const Silhouette& chart = along_y ? rasters[i].columns : rasters[i].rows;
        const int size = chart.lanes;
        if (size > across_limit || chart.length > along_limit) continue;
        if (chart.hollow >= choice.waste) continue;  // no gap can make up for it
        const int a = across.begin, b = across.end - size;
        const int begin = std::min(a, b), end = std::max(a, b) + 1;
        slide(channel, chart, end, range_);
        const Rest drop =
            best_rest(channel, chart, range_, begin, end, up ? Side::high : Side::low);
        if (drop.shift < 0 || drop.gap + chart.hollow >= choice.waste) continue;
        choice.waste = drop.gap + chart.hollow;
        choice.placement = {static_cast<std::int32_t>(i), along_y ? drop.shift : drop.position,
                            along_y ? drop.position : drop.shift};
      }
    }
  }

  /// Free room of each lane on the side that charts come from, out to where the extent may reach.
  static void fill_channel(Channel& channel, const BitLanes& lanes, Span along, int limit,
                           bool up) {
    for (int lane = 0; lane < lanes.lanes; ++lane) {
      const int last = last_set(lanes.lane(lane), lanes.length);
      int low = along.end - limit, high = along.begin + limit;
      if (up) {
        high = last < 0 ? along.end : next_set(lanes.lane(lane), lanes.length, 0);
        if (along.size() == 0) high = along.begin + limit;
      } else {
        low = last < 0 ? along.begin : last + 1;
      }
      channel.low[static_cast<std::size_t>(lane)] = static_cast<std::int16_t>(low);
      channel.high[static_cast<std::size_t>(lane)] = static_cast<std::int16_t>(high);
    }
    channel.extend();
  }

  static void stretch(Span& span, int begin, int size) {
    if (span.size() == 0) {
      span = {begin, begin + size};
    } else {
      span = {std::min(span.begin, begin), std::max(span.end, begin + size)};
    }
  }

  const PlaceTask& task_;
  Board board_;
  Channel channel_x_, channel_y_;
  Span extent_x_, extent_y_;
  SlideResult range_;
};

}  // namespace

bool place_zsgs04(const PlaceTask& task, std::vector<CellPlacement>& placements) {
  placements.assign(task.chart_count, {});
  FourSides packing(task);
  for (const std::uint32_t chart : task.by_area) {
    if (task.stop()) return false;
    if (!packing.place(task.rasters(chart), placements[chart])) return false;
  }
  for (CellPlacement& placement : placements) {
    placement.x -= packing.origin().x;
    placement.y -= packing.origin().y;
  }
  return true;
}

}  // namespace wrapatlas
