// Free translations of a piece over a part of the domain, and which of them are tight.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "guided/free_space.h"

namespace wrapatlas {

/// Translations to look at. `x_*`: within the domain. Rows go around where the domain wraps.
struct FreeRange {
  int x_begin = 0, x_end = 0;
  int y_begin = 0, y_count = 0;
  /// The range is all there is, so that beyond it nothing is free; otherwise what is there counts
  /// as free, but for what is beyond the first and the last column of the domain.
  bool whole = false;
};

struct CellShift {
  int x = 0, y = 0;
};

/// A translation is tight if few of its four neighbours are free: the piece is held there.
class FreeMap {
 public:
  /// Looks at the rows of the range one after the other, until all were or `enough` translations
  /// with two blocked neighbours or more were met. Returns the rows looked at.
  int scan(const Occupancy& occupancy, const Probes& probes, const FreeRange& range, int enough);
  /// First row of the range, counted from its beginning, with a free translation; -1: none.
  [[nodiscard]] int first_row() const { return first_row_; }
  /// Up to `count` free translations with a blocked neighbour, the tightest first; of equals they
  /// are spread evenly. If no free one has a blocked neighbour, any of them.
  void tightest(std::size_t count, std::vector<CellShift>& shifts) const;

 private:
  /// Of those looked at.
  [[nodiscard]] const std::uint64_t* row(int i) const {
    const std::ptrdiff_t kept = row_of_[static_cast<std::size_t>(i)];
    return kept < 0 ? none_.data() : free_.data() + kept * stride_;
  }
  std::uint64_t* next_row();
  bool fill_row(const Occupancy& occupancy, const Probes& probes, const FreeRange& range, int y,
                std::uint64_t* to);
  void rank(const Occupancy& occupancy, const FreeRange& range, int index, int rows_known);

  int first_word_ = 0, words_ = 0, stride_ = 0;
  int first_row_ = -1;
  std::vector<std::uint64_t> free_;  ///< rows that have free translations; few have
  std::vector<int> row_of_;          ///< of those looked at, which of the rows in free_; -1: none
  int kept_rows_ = 0;
  std::vector<std::uint64_t> none_;  ///< a row without any
  std::vector<std::uint64_t> open_;
  CellShift any_;  ///< a free translation, if first_row_ says that there is one
  std::array<std::vector<CellShift>, 5>
      by_blocked_;  ///< by the number of blocked neighbours; not 0
};

}  // namespace wrapatlas
