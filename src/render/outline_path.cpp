#include "render/outline_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdlib>
#include <iterator>
#include <vector>

namespace wrapatlas {
namespace {

/// A point in hundredths.
struct GridPoint {
  long x = 0, y = 0;
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

struct GridEdge {
  GridPoint from, to;
  bool used = false;
};

GridPoint snapped(Vec2 p) { return {std::lround(100 * p.x), std::lround(100 * p.y)}; }

/// The edges one by one, sorted by start; those that rounding made points are left out, which
/// keeps the loops closed.
std::vector<GridEdge> grid_edges(std::span<const Segment> edges) {
  std::vector<GridEdge> sorted;
  for (const Segment& edge : edges) {
    GridPoint from = snapped(edge.from), to = snapped(edge.to);
    if (from == to) continue;
    if (edge.winding < 0) std::swap(from, to);
    for (int i = 0; i < std::abs(edge.winding); ++i) sorted.push_back({from, to});
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const GridEdge& a, const GridEdge& b) { return a.from < b.from; });
  return sorted;
}

void append_hundredths(long value, bool separate, std::string& path) {
  if (separate && value >= 0) path += ' ';
  if (value < 0) path += '-';
  value = std::labs(value);
  if (value >= 100 || value == 0) path += fmt::format("{}", value / 100);
  if (value % 100 == 0) return;
  path += '.';
  path += static_cast<char>('0' + value / 10 % 10);
  if (value % 10 != 0) path += static_cast<char>('0' + value % 10);
}

void append_point(GridPoint from, GridPoint to, bool separate, std::string& path) {
  append_hundredths(to.x - from.x, separate, path);
  append_hundredths(to.y - from.y, true, path);
}

}  // namespace

std::string outline_path(std::span<const Segment> edges) {
  std::vector<GridEdge> sorted = grid_edges(edges);
  // Per edge that is the first of its start, the next one to leave by.
  std::vector<std::size_t> next(sorted.size());
  for (std::size_t i = 0; i < next.size(); ++i) next[i] = i;
  const auto leave = [&](GridPoint point) -> GridEdge* {
    const auto first =
        std::lower_bound(sorted.begin(), sorted.end(), point,
                         [](const GridEdge& edge, const GridPoint& p) { return edge.from < p; });
    if (first == sorted.end() || first->from != point) return nullptr;
    std::size_t& at = next[static_cast<std::size_t>(first - sorted.begin())];
    while (at < sorted.size() && sorted[at].from == point && sorted[at].used) ++at;
    return at < sorted.size() && sorted[at].from == point ? &sorted[at] : nullptr;
  };
  std::string path;
  for (GridEdge& start : sorted) {
    if (start.used) continue;
    path += 'M';
    append_point({}, start.from, false, path);
    path += 'l';
    bool separate = false;
    for (GridEdge* edge = &start;;) {
      edge->used = true;
      GridEdge* following = edge->to == start.from ? nullptr : leave(edge->to);
      if (edge->to != start.from) append_point(edge->from, edge->to, separate, path);
      separate = true;
      if (following == nullptr) break;
      edge = following;
    }
    path += 'z';
  }
  return path;
}

}  // namespace wrapatlas
