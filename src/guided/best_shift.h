// Where does a piece cost least? Every translation in a range is looked at, with early ends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "guided/field.h"

namespace wrapatlas {

/// Translations to look at, counted from the field's origin.
struct ShiftRange {
  int x_begin = 0, x_end = 0;
  int y_begin = 0, y_end = 0;
  int y_start = 0;  ///< the row of translations to begin with; the others follow around
};

/// A translation and what a piece costs there: the weights of all cells it covers, at most
/// kMostCost, which stands for any more as well.
struct Shift {
  std::uint16_t cost = 0;
  int x = 0, y = 0;
};
inline constexpr std::uint16_t kMostCost = 0xffff;

/// The first translation in the range that costs least, if that is less than best.cost; else best
/// stays. Where the field's sums are sorted by phase, whole blocks of translations are ruled out by
/// the piece's core. Runs the widest SIMD version the machine has; all give the same answer.
void best_shift(const Field& field, const Piece& piece, const ShiftRange& range, Shift& best);

/// What a piece costs at one place.
std::uint16_t cost_at(const Field& field, std::span<const PieceRun> runs, int x, int y);

using BestShiftKernel = void (*)(const Field& field, const Piece& piece, const ShiftRange& range,
                                 Shift& best);
/// The versions that the machine can run, the widest first, for tests and benchmarks.
std::vector<BestShiftKernel> best_shift_kernels();

}  // namespace wrapatlas
