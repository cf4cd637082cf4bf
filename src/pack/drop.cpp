#include "pack/drop.h"

#include <algorithm>
#include <limits>

namespace wrapatlas {
namespace {

template <bool kUp>
Drop best_rest(const Channel& channel, const Silhouette& chart, int begin, int end,
               SlideResult& scratch) {
  Drop best;
  if (begin >= end) return best;
  slide(channel, chart, end, scratch);
  best.waste = std::numeric_limits<std::int32_t>::max();
  for (int shift = begin; shift < end; ++shift) {
    const auto i = static_cast<std::size_t>(shift);
    if (scratch.lowest[i] > scratch.highest[i]) continue;
    const int position = kUp ? scratch.highest[i] : scratch.lowest[i];
    const std::int32_t waste = kUp ? gap_above(channel, chart, shift, position)
                                   : gap_below(channel, chart, shift, position);
    if (waste < best.waste) best = {waste, shift, position};
  }
  return best;
}

}  // namespace

Drop drop_down(const Channel& channel, const Silhouette& chart, int begin, int end,
               SlideResult& scratch) {
  return best_rest<false>(channel, chart, begin, end, scratch);
}

Drop drop_up(const Channel& channel, const Silhouette& chart, int begin, int end,
             SlideResult& scratch) {
  return best_rest<true>(channel, chart, begin, end, scratch);
}

Skyline::Skyline(int width, int height, int reach) : width_(width) {
  horizon_.resize(width, reach);
  std::fill(horizon_.high.begin(), horizon_.high.end(), static_cast<std::int16_t>(height));
  horizon_.extend();
}

Drop Skyline::best_drop(const ChartRaster& chart) {
  if (chart.width == 0) return {};
  return drop_down(horizon_, chart.columns, 0, width_ - chart.width + 1, scratch_);
}

void Skyline::add(const ChartRaster& chart, int x, int y) {
  for (int c = 0; c < chart.width; ++c) {
    const auto i = static_cast<std::size_t>(c);
    if (chart.columns.first[i] > chart.columns.last[i]) continue;
    horizon_.low[static_cast<std::size_t>(x + c)] =
        static_cast<std::int16_t>(y + chart.columns.last[i] + 1);
  }
  horizon_.extend();
}

}  // namespace wrapatlas
