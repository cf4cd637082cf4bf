// The weight of every cell of the domain, or of a part of it, summed along rows: what a piece
// costs at any place is then two look-ups per run.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "guided/piece.h"

namespace wrapatlas {

/// A stretch of cells along one axis, seen from `origin`. It goes around if it is the whole of an
/// axis that wraps.
struct Stretch {
  int origin = 0;  ///< cell of the domain
  int count = 0;   ///< cells; at most the domain's
  bool cyclic = false;
};

/// Rows of prefix sums modulo 2^16: the weight of cells [a, b) of row y is
/// uint16(rows()[y][b] - rows()[y][a]), exact while it is below 2^16, which kLargestWeight sees to.
class Field {
 public:
  /// Empties the field and lays it over a part of the domain. Cyclic axes are followed around for
  /// `reach` more cells, so that pieces up to that long can be asked for anywhere.
  void reset(const Domain& domain, Stretch x, Stretch y, int reach);
  /// Adds `weight` to the cells of a piece whose cell (0,0) lies at (x, y) of the domain.
  void add(const Piece& piece, int x, int y, int weight);
  /// Sums up what was added. After this rows() may be used.
  void sum();
  /// Makes every kBlock-th sum of each row stand together, for best_shift() to rule out blocks.
  /// Until the next reset().
  void sort_by_phase();

  /// Row pointers, for rows counted from the stretch's origin, around where cyclic.
  [[nodiscard]] const std::uint16_t* const* rows() const { return rows_.data(); }
  /// Rows of sums by phase: rows()[y][kBlock * i + p] is phases()[y][p * phase_stride() + i]. Null
  /// if they were not asked for.
  [[nodiscard]] const std::uint16_t* const* phases() const {
    return phase_rows_.empty() ? nullptr : phase_rows_.data();
  }
  [[nodiscard]] int phase_stride() const { return phase_stride_; }

 private:
  void add_run(std::uint16_t* row, int begin, int end, int weight) const;

  Domain domain_;
  Stretch x_, y_;
  int stride_ = 0;  ///< of a row
  int width_ = 0;   ///< sums per row that may be read
  std::vector<std::uint16_t> sums_;
  std::vector<const std::uint16_t*> rows_;
  int phase_stride_ = 0;
  std::vector<std::uint16_t> phase_sums_;
  std::vector<const std::uint16_t*> phase_rows_;
};

/// Cells that several pieces share have the sum of their weights, but no more than this, so that
/// kLongestRun of them stay below 2^16. What is added to one cell has to stay below 2^15.
inline constexpr int kLargestWeight = 511;

}  // namespace wrapatlas
