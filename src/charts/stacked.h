// Charts that lie on top of each other in the input.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "charts/union_find.h"
#include "wrapatlas/charts.h"

namespace wrapatlas {

/// Two charts are stacked if they share more than this part of the smaller one's area; less is
/// what rounding does to charts that touch.
inline constexpr double kStackedShare = 1e-6;

/// Per chart: is it stacked with any other? After about `most_steps` edges looked at the search
/// ends, and some stacked charts may stay unmarked.
std::vector<bool> mark_stacked(std::span<const Chart> charts, double most_steps);

/// The sets of charts that are stacked with each other, directly or over others.
UnionFind group_stacked(std::span<const Chart> charts);

}  // namespace wrapatlas
