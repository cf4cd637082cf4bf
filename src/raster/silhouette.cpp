#include "raster/silhouette.h"

#include <algorithm>

namespace wrapatlas {
namespace {

/// A view whose lanes are all empty.
Silhouette empty_silhouette(int lanes, int length) {
  Silhouette result;
  result.lanes = lanes;
  result.length = length;
  result.horizons.resize(2 * static_cast<std::size_t>(lanes));  // the last cells: 0
  std::fill_n(result.first(), lanes, std::int16_t{1});
  return result;
}

/// Runs and sums of lanes whose horizons are known.
void sum_up(Silhouette& view, std::int64_t cells) {
  const std::int16_t* first = view.first();
  const std::int16_t* last = view.last();
  std::int32_t lane = 0;
  while (lane < view.lanes) {
    const std::int32_t begin = lane;
    for (; lane < view.lanes; ++lane) {
      if (first[lane] > last[lane]) break;
      view.sum_first += first[lane];
      view.sum_last += last[lane];
    }
    if (lane > begin) {
      if (view.filled_lanes > 0 && view.split_runs.empty()) view.split_runs.push_back(view.run);
      view.run = {begin, lane};
      if (view.filled_lanes > 0) view.split_runs.push_back(view.run);
    }
    view.filled_lanes += lane - begin;
    ++lane;
  }
  view.hollow =
      view.sum_last - view.sum_first + view.filled_lanes - static_cast<std::int32_t>(cells);
}

/// Calls visit(position) for the pending positions that are set in this lane; they are then no
/// longer pending. False if nothing is pending any more.
template <typename Visit>
bool visit_pending(const std::uint64_t* lane, std::vector<std::uint64_t>& pending, Visit visit) {
  std::uint64_t left = 0;
  for (std::size_t word = 0; word < pending.size(); ++word) {
    std::uint64_t met = lane[word] & pending[word];
    pending[word] &= ~met;
    left |= pending[word];
    for (; met != 0; met &= met - 1) {
      visit(word * kWordBits + static_cast<std::size_t>(std::countr_zero(met)));
    }
  }
  return left != 0;
}

void all_pending(const BitLanes& lanes, std::vector<std::uint64_t>& pending) {
  pending.assign(static_cast<std::size_t>(lanes.words), ~std::uint64_t{0});
  pending.back() >>= lanes.words * kWordBits - lanes.length;
}

}  // namespace

Silhouette lane_silhouette(const BitLanes& cells_by_row, std::int64_t cells) {
  Silhouette view = empty_silhouette(cells_by_row.lanes, cells_by_row.length);
  for (int y = 0; y < cells_by_row.lanes; ++y) {
    const int last = last_set(cells_by_row.lane(y), cells_by_row.length);
    if (last < 0) continue;
    view.first()[y] =
        static_cast<std::int16_t>(next_set(cells_by_row.lane(y), cells_by_row.length, 0));
    view.last()[y] = static_cast<std::int16_t>(last);
  }
  sum_up(view, cells);
  return view;
}

Silhouette cross_silhouette(const BitLanes& cells_by_row, std::int64_t cells) {
  Silhouette view = empty_silhouette(cells_by_row.length, cells_by_row.lanes);
  thread_local std::vector<std::uint64_t> pending;
  all_pending(cells_by_row, pending);
  for (int y = 0; y < cells_by_row.lanes; ++y) {
    const bool more = visit_pending(cells_by_row.lane(y), pending, [&](std::size_t x) {
      view.first()[x] = static_cast<std::int16_t>(y);
    });
    if (!more) break;
  }
  all_pending(cells_by_row, pending);
  for (int y = cells_by_row.lanes - 1; y >= 0; --y) {
    const bool more = visit_pending(cells_by_row.lane(y), pending, [&](std::size_t x) {
      view.last()[x] = static_cast<std::int16_t>(y);
    });
    if (!more) break;
  }
  sum_up(view, cells);
  return view;
}

}  // namespace wrapatlas
