// Where the entries of a chart's symmetric matrices are: one for each point, one for each edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "parameterize/disc.h"

namespace wrapatlas {

/// Upper triangle by columns, for the points that are unknowns. In each column the diagonal is
/// last.
struct Pattern {
  std::vector<int> column;      ///< per point, or -1
  std::vector<int> begin;       ///< per column its first entry; one more at the end
  std::vector<int> row;         ///< per entry
  std::vector<int> edge_entry;  ///< per half-edge, the same for both of an edge, or -1

  [[nodiscard]] int diagonal(int of_column) const { return begin[of_column + 1] - 1; }
  [[nodiscard]] int size() const { return static_cast<int>(begin.size()) - 1; }
};

/// `unknown` says which points are. O(n).
Pattern make_pattern(const Disc& disc, std::span<const std::uint32_t> order,
                     const std::vector<bool>& unknown);

/// Points in an order of elimination that keeps factors sparse: approximate minimum degree
/// (Amestoy, Davis & Duff 1996), by Eigen. About O(n log n).
std::vector<std::uint32_t> elimination_order(const Disc& disc);

}  // namespace wrapatlas
