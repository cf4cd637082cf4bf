#include "pack/skyline.h"

#include <algorithm>

namespace wrapatlas {

Skyline::Skyline(int width, int height, int reach) : width_(width) {
  horizon_.resize(width, reach);
  std::fill(horizon_.high.begin(), horizon_.high.end(), static_cast<std::int16_t>(height));
  horizon_.extend();
}

Rest Skyline::best_drop(const ChartRaster& chart) {
  const int shifts = width_ - chart.width + 1;
  if (chart.width == 0 || shifts <= 0) return {};
  slide(horizon_, chart.columns, shifts, range_);
  return best_rest(horizon_, chart.columns, range_, 0, shifts, Side::low);
}

void Skyline::add(const ChartRaster& chart, int x, int y) {
  for (int c = 0; c < chart.width; ++c) {
    if (chart.columns.first()[c] > chart.columns.last()[c]) continue;
    horizon_.low[static_cast<std::size_t>(x + c)] =
        static_cast<std::int16_t>(y + chart.columns.last()[c] + 1);
  }
  horizon_.extend();
}

}  // namespace wrapatlas
