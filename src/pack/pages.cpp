#include <algorithm>
#include <cmath>

#include "wrapatlas/pack.h"

namespace wrapatlas {

double page_rounding(int pages) {
  const int last_row = page_tile(std::max(pages, 1) - 1).row;
  // The chart that begins on the last tile ends on the next one.
  const int farthest = std::max(last_row, pages > 1 ? kPageColumns - 1 : 0) + 2;
  constexpr int kFloatBits = 24;
  return std::ldexp(1.0, std::ilogb(farthest - 1) + 1 - (kFloatBits + 1));
}

}  // namespace wrapatlas
