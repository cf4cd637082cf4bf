// Numbers and runs of cells on an axis that goes around.
#pragma once

#include <algorithm>

namespace wrapatlas {

/// `value` folded onto [0, size).
inline int modulo(int value, int size) {
  // A division takes longer than all the rest of what is done for a run of cells.
  if (value >= 0 && value < size) return value;
  if (value >= size && value - size < size) return value - size;
  if (value < 0 && value + size >= 0) return value + size;
  const int rest = value % size;
  return rest < 0 ? rest + size : rest;
}

/// Cells [begin, end), of any length, folded onto [0, size): calls part(from, to) for each stretch
/// between two passes of the end, in order.
template <typename Part>
void for_each_part(int begin, int end, int size, Part&& part) {
  int from = modulo(begin, size);
  for (int left = end - begin; left > 0; from = 0) {
    const int length = std::min(left, size - from);
    part(from, from + length);
    left -= length;
  }
}

}  // namespace wrapatlas
