#include "parameterize/pattern.h"

#include <algorithm>
#include <utility>

#include "parameterize/eigen.h"

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

std::vector<std::uint32_t> elimination_order(const Disc& disc) {
  std::vector<std::uint32_t> order(disc.points.size());
  for (std::uint32_t p = 0; p < order.size(); ++p) order[p] = p;
  Pattern pattern = make_pattern(disc, order, std::vector<bool>(order.size(), true));
  const std::vector<double> ones(pattern.row.size(), 1);
  const Eigen::Map<const Eigen::SparseMatrix<double>> graph(
      pattern.size(), pattern.size(), static_cast<Eigen::Index>(ones.size()), pattern.begin.data(),
      pattern.row.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> found;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), found);
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = static_cast<std::uint32_t>(found.indices()(static_cast<Eigen::Index>(k)));
  }
  return order;
}

}  // namespace wrapatlas
