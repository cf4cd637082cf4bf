// Plots as SVG: lines or points over two axes.
#pragma once

#include <string>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

struct PlotSeries {
  std::string name;
  std::vector<Vec2> points;
};

struct PlotAxis {
  std::string name;
  bool logarithmic = false;
  double low = 0, high = 1;  ///< ends; of a logarithmic axis above 0
};

struct Plot {
  std::string title;
  PlotAxis x, y;
  bool lines = true;  ///< else a dot for each point
  std::vector<PlotSeries> series;
};

/// A document of its own, that can also stand within HTML. Text is escaped.
std::string draw_plot(const Plot& plot);

/// &, <, >, " and ' as HTML and SVG want them.
std::string escaped(const std::string& text);

/// CSS colour of series number `i`: told apart also by those who see few colours.
const char* series_color(std::size_t i);

}  // namespace wrapatlas
