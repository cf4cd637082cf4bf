// The packer of T. Nöll, D. Stricker: "Efficient Packing of Arbitrary Shaped Charts for Automatic
// Texture Atlas Generation", EGSR 2011, section 2.2.
//
// Eight placement strategies, {outer, inner} x {horizontal, vertical} x {normal, mirrored}, for
// each of a chart's rotations; the valid placement of least wasted space is taken.
//
// How this file reads the paper, where it is open:
// - All eight strategies become one: per lane (column or row) of the canvas there is a channel, a
//   free interval, and the chart slides through the channel, against its lower end (normal) or its
//   upper end (mirrored). The outer channel of a lane is the gap that runs through the canvas
//   border, from behind its last occupied cell to h + its first one; the inner channel is the
//   largest other gap, or where there is none the larger gap to the canvas border. The placement
//   rule of section 2.2.2 is then just "the chart's two horizons lie within the channel".
// - A lane with nothing in it is all channel, [0, 2h); that its cells do not meet themselves is
//   known from Board::admits.
// - On an axis without wrap the outer channel falls apart into the gap behind the packing (normal)
//   and the one before it (mirrored).
// - Ties in wasted space go to inner placements, then to the smaller growth of the packing's
//   extent, then to the first rotation, direction, strategy and shift.
// - A chart's own hollow is a lower bound of its wasted space, so orientations are tried by growing
//   hollow, and those whose hollow alone exceeds the best waste are left out. An inner placement
//   without a gap that stretches nothing ends the search: what comes later has as much hollow or
//   more, and loses all ties. Neither changes anything in the result.

#include <algorithm>
#include <array>
#include <limits>

#include "pack/board.h"
#include "pack/placer.h"
#include "pack/slide.h"

namespace wrapatlas {
namespace {

struct LaneGaps {
  int first = 0, last = -1;  ///< occupied cells; last < first: an empty lane
  int inner_low = 0, inner_high = 0;
};

LaneGaps find_gaps(const BitLanes& lanes, int lane) {
  LaneGaps gaps;
  int previous_end = -1;
  for_each_run(lanes.lane(lane), lanes.length, [&](int begin, int end) {
    if (previous_end < 0) {
      gaps.first = begin;
    } else if (begin - previous_end > gaps.inner_high - gaps.inner_low) {
      gaps.inner_low = previous_end;
      gaps.inner_high = begin;
    }
    previous_end = end;
  });
  gaps.last = previous_end - 1;
  return gaps;
}

/// The channels of one direction. Lanes are columns (charts move along y) or rows.
class Direction {
 public:
  Direction(int lanes, int length, bool lanes_wrap, bool length_wraps, int reach)
      : length_(length), lanes_wrap_(lanes_wrap), length_wraps_(length_wraps) {
    outer_.resize(lanes, reach);
    inner_.resize(lanes, reach);
    if (!length_wraps_) before_.resize(lanes, reach);
    extent_begin_ = length;
    for (int lane = 0; lane < lanes; ++lane) set_lane(lane, {});
    extend();
  }

  /// Reads the lanes [begin, begin + count) of the board again.
  void update(const BitLanes& board, int begin, int count) {
    for (int i = 0; i < std::min(count, board.lanes); ++i) {
      const int lane = (begin + i) % board.lanes;
      set_lane(lane, find_gaps(board, lane));
    }
    extend();
  }

  [[nodiscard]] const Channel& outer_normal() const { return outer_; }
  [[nodiscard]] const Channel& outer_mirrored() const { return length_wraps_ ? outer_ : before_; }
  [[nodiscard]] const Channel& inner() const { return inner_; }
  [[nodiscard]] bool shares_outer() const { return length_wraps_; }
  [[nodiscard]] int length() const { return length_; }
  [[nodiscard]] int shifts(const Silhouette& chart) const {
    return lanes_wrap_ ? outer_.lanes : outer_.lanes - chart.lanes + 1;
  }
  /// By how much a chart at [position, position + size) would stretch the occupied extent.
  [[nodiscard]] int growth(int position, int size) const {
    if (extent_end_ <= extent_begin_) return 0;
    return std::max(0, position + size - extent_end_) + std::max(0, extent_begin_ - position);
  }

 private:
  void set_lane(int lane, const LaneGaps& gaps) {
    const auto i = static_cast<std::size_t>(lane);
    const auto put = [i](Channel& channel, int low, int high) {
      channel.low[i] = static_cast<std::int16_t>(low);
      channel.high[i] = static_cast<std::int16_t>(high);
    };
    if (gaps.last < gaps.first) {
      const int end = length_wraps_ ? 2 * length_ : length_;
      put(outer_, 0, end);
      put(inner_, 0, end);
      if (!length_wraps_) put(before_, 0, end);
      return;
    }
    extent_begin_ = std::min(extent_begin_, gaps.first);
    extent_end_ = std::max(extent_end_, gaps.last + 1);
    put(outer_, gaps.last + 1, length_wraps_ ? length_ + gaps.first : length_);
    if (!length_wraps_) put(before_, 0, gaps.first);
    if (gaps.inner_high > gaps.inner_low) {
      put(inner_, gaps.inner_low, gaps.inner_high);
    } else if (gaps.first > length_ - gaps.last - 1) {
      put(inner_, 0, gaps.first);
    } else {
      put(inner_, gaps.last + 1, length_);
    }
  }
  void extend() {
    outer_.extend();
    inner_.extend();
    if (!length_wraps_) before_.extend();
  }

  int length_;
  bool lanes_wrap_, length_wraps_;
  Channel outer_, inner_, before_;
  int extent_begin_ = 0, extent_end_ = 0;
};

struct Candidate {
  double waste = std::numeric_limits<double>::infinity();
  std::int32_t gap = 0;
  bool outer = true;
  int growth = 0;
  std::int32_t rotation = -1;
  int strategy = 0;  ///< 0 to 7, in the order that settles ties
  int shift = 0, position = 0;

  [[nodiscard]] bool better_than(const Candidate& other) const {
    if (waste != other.waste) return waste < other.waste;
    if (outer != other.outer) return !outer;
    if (growth != other.growth) return growth < other.growth;
    if (rotation != other.rotation) return rotation < other.rotation;
    return strategy < other.strategy;
  }
  [[nodiscard]] bool along_y() const { return strategy < 4; }
};

class ModuloPlacer {
 public:
  explicit ModuloPlacer(const PlaceTask& task)
      : task_(task),
        board_(task.width, task.height, task.wrap),
        along_y_(task.width, task.height, wraps_u(task.wrap), wraps_v(task.wrap), task.reach),
        along_x_(task.height, task.width, wraps_v(task.wrap), wraps_u(task.wrap), task.reach) {}

  bool place(std::span<const ChartRaster> rasters, CellPlacement& placement) {
    best_ = {};
    sort_orientations(rasters);
    for (const Orientation& orientation : orientations_) {
      if (orientation.hollow * std::min(1.0, task_.lambda) > best_.waste || unbeatable()) break;
      const ChartRaster& raster = rasters[static_cast<std::size_t>(orientation.rotation)];
      if (!board_.admits(raster)) continue;
      try_direction(orientation, orientation.along_y ? raster.columns : raster.rows);
    }
    if (best_.rotation < 0) return false;
    const ChartRaster& raster = rasters[static_cast<std::size_t>(best_.rotation)];
    placement.rotation = best_.rotation;
    placement.x = best_.along_y() ? best_.shift : best_.position;
    placement.y = best_.along_y() ? best_.position : best_.shift;
    placement.x = (placement.x % task_.width + task_.width) % task_.width;
    placement.y = (placement.y % task_.height + task_.height) % task_.height;
    const CellViews cells = cells_of(raster);
    if (board_.collides(cells, placement.x, placement.y)) return false;
    board_.add(cells, placement.x, placement.y);
    along_y_.update(board_.columns(), placement.x, raster.width);
    along_x_.update(board_.rows(), placement.y, raster.height);
    return true;
  }

 private:
  /// A rotation of the chart moved along one axis.
  struct Orientation {
    std::int32_t hollow;
    std::int32_t rotation;
    bool along_y;
  };

  /// No later orientation or strategy can do better than the best so far.
  [[nodiscard]] bool unbeatable() const {
    return best_.gap == 0 && !best_.outer && best_.growth == 0 && task_.lambda >= 1;
  }

  void sort_orientations(std::span<const ChartRaster> rasters) {
    orientations_.clear();
    for (std::size_t i = 0; i < rasters.size(); ++i) {
      const auto rotation = static_cast<std::int32_t>(i);
      orientations_.push_back({rasters[i].columns.hollow, rotation, true});
      orientations_.push_back({rasters[i].rows.hollow, rotation, false});
    }
    std::stable_sort(
        orientations_.begin(), orientations_.end(),
        [](const Orientation& a, const Orientation& b) { return a.hollow < b.hollow; });
  }

  /// The four strategies of one direction.
  void try_direction(const Orientation& orientation, const Silhouette& chart) {
    const Direction& direction = orientation.along_y ? along_y_ : along_x_;
    const int shifts = direction.shifts(chart);
    if (shifts <= 0) return;
    const auto try_side = [&](const Channel& channel, Side side, bool outer) {
      consider(orientation, chart, best_rest(channel, chart, range_, 0, shifts, side), side, outer);
    };
    if (task_.inner && chart.hollow <= best_.waste) {
      slide(direction.inner(), chart, shifts, range_);
      try_side(direction.inner(), Side::low, false);
      if (unbeatable()) return;
      try_side(direction.inner(), Side::high, false);
      if (unbeatable()) return;
    }
    if (chart.hollow * task_.lambda > best_.waste) return;
    slide(direction.outer_normal(), chart, shifts, range_);
    try_side(direction.outer_normal(), Side::low, true);
    if (!direction.shares_outer()) slide(direction.outer_mirrored(), chart, shifts, range_);
    try_side(direction.outer_mirrored(), Side::high, true);
  }

  /// The best placement of one strategy against the best of those before.
  void consider(const Orientation& orientation, const Silhouette& chart, const Rest& rest,
                Side side, bool outer) {
    if (rest.shift < 0) return;
    const Direction& direction = orientation.along_y ? along_y_ : along_x_;
    Candidate candidate;
    candidate.waste = (rest.gap + chart.hollow) * (outer ? task_.lambda : 1.0);
    candidate.gap = rest.gap;
    candidate.outer = outer;
    candidate.shift = rest.shift;
    candidate.position = rest.position;
    candidate.growth = direction.growth(rest.position, chart.length);
    candidate.rotation = orientation.rotation;
    candidate.strategy =
        (orientation.along_y ? 0 : 4) + (outer ? 2 : 0) + (side == Side::high ? 1 : 0);
    if (candidate.better_than(best_)) best_ = candidate;
  }

  const PlaceTask& task_;
  Board board_;
  Direction along_y_, along_x_;
  SlideResult range_;
  std::vector<Orientation> orientations_;
  Candidate best_;
};

}  // namespace

bool place_modulo(const PlaceTask& task, std::vector<CellPlacement>& placements) {
  placements.assign(task.chart_count, {});
  ModuloPlacer placer(task);
  for (const std::uint32_t chart : task.by_area) {
    if (task.stop()) return false;
    if (!placer.place(task.rasters(chart), placements[chart])) return false;
  }
  return true;
}

}  // namespace wrapatlas
