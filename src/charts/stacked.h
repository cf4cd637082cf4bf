// Charts that lie on top of each other in the input.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/union_find.h"
#include "wrapatlas/charts.h"

namespace wrapatlas {

/// Two charts are stacked if they share more than this part of the smaller one's area,
inline constexpr double kStackedShare = 1e-6;
/// and more than a seam of this depth through their boxes' common part, in parts of the largest
/// coordinate there: less is what rounding to 32 bits does to charts that touch.
inline constexpr double kStackedDepth = 1e-6;

struct StackedGroups {
  UnionFind groups;
  bool complete = true;  ///< false: the search ended early, and some stacks may not be found
};

/// The sets of charts that are stacked with each other, directly or over others. After about
/// `most_steps` outline edges looked at the search ends. Sweeps over boxes; pairs within a set that
/// is known already cost nothing.
StackedGroups group_stacked(std::span<const Chart> charts, double most_steps);

}  // namespace wrapatlas
