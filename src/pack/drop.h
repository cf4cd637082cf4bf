// Dropping charts onto one horizon: the common part of the packers before the paper's.
#pragma once

#include <vector>

#include "pack/slide.h"
#include "raster/chart_raster.h"

namespace wrapatlas {

/// Where a chart comes to rest, and what space that wastes.
struct Drop {
  std::int32_t waste = 0;  ///< cells between chart and horizon; the chart's hollow not included
  int shift = -1;          ///< first lane; -1: it fits nowhere
  int position = 0;
};

/// Drops a chart from the high end of the lanes onto channel.low at each shift in [begin, end) and
/// returns the first of least waste. It must stay within channel.high.
Drop drop_down(const Channel& channel, const Silhouette& chart, int begin, int end,
               SlideResult& scratch);

/// The mirror image: from the low end against channel.high.
Drop drop_up(const Channel& channel, const Silhouette& chart, int begin, int end,
             SlideResult& scratch);

/// A strip of columns with one horizon that charts are dropped onto (Levy et al. 2002, Sander et
/// al. 2003).
class Skyline {
 public:
  Skyline(int width, int height, int reach);
  [[nodiscard]] Drop best_drop(const ChartRaster& chart);
  void add(const ChartRaster& chart, int x, int y);

 private:
  int width_;
  Channel horizon_;
  SlideResult scratch_;
};

}  // namespace wrapatlas
