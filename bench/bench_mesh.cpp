// The mesh stage beside what it cannot do without.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "commands.h"
#include "report.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas::bench {
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

void sort_positions(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = positions[a], &q = positions[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  keep(order.data());
}

std::vector<Vec2> star(int corners) {
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = i % 2 == 0 ? 1.0 : 0.5;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return points;
}

}  // namespace

int bench_mesh() {
  fmt::print("options: mesh, median of 5 runs\n");
  Table table({"what", "items", "ns per item", "known / time", "known"});
  const auto add = [&](const char* what, std::size_t items, double seconds, double known,
                       const char* known_what) {
    table.add({what, std::to_string(items),
               fmt::format("{:.1f}", 1e9 * seconds / static_cast<double>(items)),
               fmt::format("{:.2f} x", known / seconds), known_what});
  };
  for (const int side : {50, 500}) {
    const std::vector<Vec3> positions = quad_soup(side);
    const double weld = median_seconds(5, [&] { keep(weld_positions(positions)); });
    const double sort = median_seconds(5, [&] { sort_positions(positions); });
    add("weld_positions", positions.size(), weld, sort, "sorting the positions");
  }
  for (const int corners : {4, 64}) {
    const std::vector<Vec2> points = star(corners);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const int repeats = 200000 / (corners * corners);
    const auto cut = [&](std::span<const Vec2> polygon) {
      return median_seconds(5, [&] {
        for (int i = 0; i < repeats; ++i) {
          triangles.clear();
          triangulate_polygon(polygon, triangles);
          keep(triangles.data());
        }
      });
    };
    std::vector<Vec2> round = points;
    for (Vec2& p : round) p = (1 / length(p)) * p;
    add("triangulate_polygon, star", static_cast<std::size_t>(corners) * repeats, cut(points),
        cut(round), "the same on a convex polygon");
  }
  table.print();
  return 0;
}

}  // namespace wrapatlas::bench
