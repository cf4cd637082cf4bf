// Packs outlines, without a mesh or a file: needs wrapatlas::wrapatlas alone.
#include <cstdio>
#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"

int main() {
  using Loops = std::vector<std::vector<wrapatlas::Vec2>>;
  const Loops square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const Loops frame{{{0, 0}, {2, 0}, {2, 2}, {0, 2}},                   // counter-clockwise
                    {{0.4, 0.4}, {0.4, 1.6}, {1.6, 1.6}, {1.6, 0.4}}};  // its hole, clockwise

  std::vector<wrapatlas::Chart> charts;
  for (const Loops& loops : {square, frame}) {
    auto chart = wrapatlas::chart_from_loops(loops);
    if (!chart) {
      std::fprintf(stderr, "%s\n", chart.error().message().c_str());
      return 1;
    }
    charts.push_back(*chart);
  }

  wrapatlas::PackOptions options;
  options.width = options.height = 256;
  const auto packing = wrapatlas::pack(charts, options);
  if (!packing) {
    std::fprintf(stderr, "%s\n", packing.error().message().c_str());
    return 1;
  }
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const wrapatlas::Vec2 corner = packing->transform(i).apply({0, 0});  // in texels
    std::printf("chart %zu: its point (0, 0) is at texel (%.2f, %.2f)\n", i, corner.x, corner.y);
  }
  std::printf("%.1f %% of the texture is used\n", 100 * packing->efficiency);
  return 0;
}
