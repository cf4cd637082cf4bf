#include "parameterize/pattern.h"

#include <algorithm>
#include <utility>

namespace wrapatlas {
namespace {

std::pair<std::uint32_t, std::uint32_t> ends_of(const Disc& disc, std::size_t half_edge) {
  const Triangle& triangle = disc.triangles[half_edge / 3];
  return {triangle[half_edge % 3], triangle[next3(half_edge % 3)]};
}

bool first_of_edge(const Disc& disc, std::size_t half_edge) {
  return disc.opposite[half_edge] > half_edge;  // kNone is above all
}

}  // namespace

Pattern make_pattern(const Disc& disc, std::span<const std::uint32_t> order,
                     const std::vector<bool>& unknown) {
  Pattern pattern;
  pattern.column.assign(disc.points.size(), -1);
  int columns = 0;
  for (const std::uint32_t p : order) {
    if (unknown[p]) pattern.column[p] = columns++;
  }
  // Both columns of an edge, the one that holds it first; or none.
  const auto columns_of = [&](std::size_t half_edge) {
    const auto [a, b] = ends_of(disc, half_edge);
    const int i = pattern.column[a], j = pattern.column[b];
    return i < 0 || j < 0 ? std::pair{-1, -1} : std::pair{std::max(i, j), std::min(i, j)};
  };
  std::vector<int> count(static_cast<std::size_t>(columns), 1);
  for (std::size_t h = 0; h < disc.opposite.size(); ++h) {
    const int column = columns_of(h).first;
    if (first_of_edge(disc, h) && column >= 0) ++count[column];
  }
  pattern.begin.assign(1, 0);
  for (const int entries : count) pattern.begin.push_back(pattern.begin.back() + entries);
  pattern.row.resize(static_cast<std::size_t>(pattern.begin.back()));
  for (int j = 0; j < columns; ++j) pattern.row[pattern.begin[j + 1] - 1] = j;

  pattern.edge_entry.assign(disc.opposite.size(), -1);
  std::vector<int> next(pattern.begin.begin(), pattern.begin.end() - 1);
  for (std::size_t h = 0; h < disc.opposite.size(); ++h) {
    const auto [column, row] = columns_of(h);
    if (!first_of_edge(disc, h) || column < 0) continue;
    const int entry = next[column]++;
    pattern.row[entry] = row;
    pattern.edge_entry[h] = entry;
    if (disc.opposite[h] != kNone) pattern.edge_entry[disc.opposite[h]] = entry;
  }
  return pattern;
}

}  // namespace wrapatlas
