// Which cells of a domain are taken, kept so that many cells are looked at in one step.
#pragma once

#include <cstdint>
#include <vector>

#include "guided/piece.h"

namespace wrapatlas {

/// Two families of doubling tables, of which the configuration space is made (free_space.h). Bit x
/// of row y says whether any cell is taken
/// - in a table of stretches: of the 2^level from (x, y) on along the row,
/// - in a table of squares: of the 2^level x 2^level from (x, y) on.
/// Beyond a side that does not wrap all is taken; an axis that wraps goes on from its beginning.
class Occupancy {
 public:
  explicit Occupancy(const Domain& domain);

  [[nodiscard]] const Domain& domain() const { return domain_; }
  /// Levels 0 to below this: no stretch is longer than the domain is wide, or than 64 cells.
  [[nodiscard]] int stretch_levels() const { return stretch_levels_; }
  /// Levels 1 to below this.
  [[nodiscard]] int square_levels() const { return square_levels_; }
  static int stretch_table(int level) { return level; }
  [[nodiscard]] int square_table(int level) const {
    return level == 0 ? 0 : stretch_levels_ + level - 1;
  }

  /// The words of a row of a table, from bit x = 0 on. Bits x from -64 to twice the domain's width
  /// may be read; in table 0 they are right, in others those from 0 on.
  [[nodiscard]] const std::uint64_t* row(int table, int y) const {
    return data() + row_offset(table, y);
  }
  /// The same, counted from data().
  [[nodiscard]] std::ptrdiff_t row_offset(int table, int y) const {
    return (std::ptrdiff_t{table} * domain_.height + y) * stride_ + 1;
  }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }

  /// Which words of a row of a table of squares, from bit 0 on and around, have a square that is
  /// free: a bit each. Bits up to twice the words of the domain may be read, and 64 more.
  [[nodiscard]] const std::uint64_t* open_words(int level, int y) const {
    return open_.data() + (std::ptrdiff_t{level} * domain_.height + y) * open_stride_;
  }
  [[nodiscard]] const std::uint64_t* data() const { return bits_.data(); }

  /// Takes cells [begin, end) of row y, folded onto the domain; within it where it does not wrap.
  /// Call update() before the next look.
  void take(int y, int begin, int end);
  /// Brings the tables up to date. O(rows that changed * width of the change / 64 * tables).
  void update();

 private:
  [[nodiscard]] std::uint64_t* words(int table, int y) {
    return bits_.data() + row_offset(table, y);
  }
  /// Words of a row, within the domain.
  struct Span {
    int from, to;
  };
  [[nodiscard]] Span span_of_change() const;
  [[nodiscard]] bool is_whole(Span span) const;
  void extend(std::uint64_t* row, Span span) const;
  void extend_whole(std::uint64_t* row) const;
  void repeat(std::uint64_t* row, Span span) const;
  void update_stretches(int y, Span span);
  void update_squares(int level, int y, Span span);
  void set_open(int level, int y, Span span);

  Domain domain_;
  int stretch_levels_ = 1, square_levels_ = 1;
  std::ptrdiff_t stride_, open_stride_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint64_t> open_;            ///< open_words(), level by level
  std::vector<int> changed_;                   ///< rows
  int first_changed_ = 0, last_changed_ = -1;  ///< words of all of them
};

/// The 64 bits from bit x of a row on. x >= -64.
inline std::uint64_t bits_at(const std::uint64_t* row, int x) {
  const int word = x >> 6, shift = x & 63;
  const std::uint64_t low = row[word] >> shift;
  return shift == 0 ? low : low | row[word + 1] << (kWordBits - shift);
}

}  // namespace wrapatlas
