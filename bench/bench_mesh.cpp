// Micro-benchmarks of the mesh stage; items are vertices or corners.
#include <benchmark/benchmark.h>

#include <cmath>

#include "wrapatlas/mesh.h"

namespace wrapatlas {
namespace {

/// Every vertex of a square grid as often as the quads around it name it, as STL files do.
std::vector<Vec3> quad_soup(int quads_per_side) {
  std::vector<Vec3> positions;
  for (int y = 0; y < quads_per_side; ++y) {
    for (int x = 0; x < quads_per_side; ++x) {
      for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        positions.push_back({0.1 * (x + dx), 0.1 * (y + dy), 0.0});
      }
    }
  }
  return positions;
}

void weld(benchmark::State& state) {
  const std::vector<Vec3> positions = quad_soup(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(weld_positions(positions));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(positions.size()));
}
BENCHMARK(weld)->Arg(50)->Arg(500);

void triangulate_star(benchmark::State& state) {
  const auto corners = static_cast<int>(state.range(0));
  std::vector<Vec2> star;
  for (int i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * i / corners, radius = i % 2 == 0 ? 1.0 : 0.5;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (auto _ : state) {
    triangles.clear();
    triangulate_polygon(star, triangles);
    benchmark::DoNotOptimize(triangles.data());
  }
  state.SetItemsProcessed(state.iterations() * corners);
}
BENCHMARK(triangulate_star)->Arg(4)->Arg(64);

}  // namespace
}  // namespace wrapatlas
