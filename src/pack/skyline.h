// A skyline: the common part of the packers that drop charts onto one horizon.
#pragma once

#include <vector>

#include "pack/slide.h"
#include "raster/chart_raster.h"

namespace wrapatlas {

/// A strip of columns with one horizon that charts are dropped onto (Levy et al. 2002, Sander et
/// al. 2003).
class Skyline {
 public:
  Skyline(int width, int height, int reach);
  [[nodiscard]] Rest best_drop(const ChartRaster& chart);
  void add(const ChartRaster& chart, int x, int y);

 private:
  int width_;
  Channel horizon_;
  SlideResult range_;
};

}  // namespace wrapatlas
