// Squares of cells within a piece, large ones first.
#pragma once

#include <cstddef>
#include <vector>

#include "raster/bits.h"

namespace wrapatlas {

/// The cells x ... x + 2^level - 1 by y ... y + 2^level - 1.
struct InnerSquare {
  int level = 0, x = 0, y = 0;
};

/// Up to `count` squares of set cells, with levels from 1 to below `levels`, the largest first. No
/// two have a cell in common.
std::vector<InnerSquare> inner_squares(const BitLanes& cells, int levels, std::size_t count);

}  // namespace wrapatlas
