#include "guided/free_map.h"

#include <algorithm>
#include <bit>

namespace wrapatlas {
namespace {

/// How many of four bits are set, for 64 of each at a time: entry n has those with n set.
std::array<std::uint64_t, 5> count_of_four(std::uint64_t a, std::uint64_t b, std::uint64_t c,
                                           std::uint64_t d) {
  const std::uint64_t one_ab = a ^ b, both_ab = a & b, one_cd = c ^ d, both_cd = c & d;
  const std::uint64_t odd = one_ab ^ one_cd;
  const std::uint64_t pair = one_ab & one_cd;
  const std::uint64_t four = both_ab & both_cd;
  const std::uint64_t two_or_three = (both_ab ^ both_cd) | pair;
  return {~(odd | two_or_three | four), odd & ~two_or_three, ~odd & two_or_three,
          odd & two_or_three, four};
}

/// Bits of a word that stand for x in [begin, end).
std::uint64_t within(int word, int begin, int end) {
  const int from = std::max(begin - word * kWordBits, 0);
  const int to = std::min(end - word * kWordBits, kWordBits);
  if (from >= to) return 0;
  return (~std::uint64_t{0} << from) & (~std::uint64_t{0} >> (kWordBits - to));
}

}  // namespace

/// Sorts the free translations of a row by their blocked neighbours; those of the rows next to it
/// have to be known, or do not count.
void FreeMap::rank(const Occupancy& occupancy, const FreeRange& range, int index, int rows_known) {
  const Domain& domain = occupancy.domain();
  const std::uint64_t unknown = range.whole ? 0 : ~std::uint64_t{0};  // as if free
  const bool around_x = range.whole && domain.wraps_x;
  const bool around_y =
      range.whole && domain.wraps_y && rows_known == range.y_count && rows_known == domain.height;
  if (row_of_[static_cast<std::size_t>(index)] < 0) return;
  const std::uint64_t* here = row(index);
  const auto row_or_null = [&](int i) -> const std::uint64_t* {
    if (around_y) i = i < 0 ? rows_known - 1 : i < rows_known ? i : 0;
    if (i < 0 || i >= rows_known) return nullptr;
    return row(i);
  };
  const std::uint64_t* above = row_or_null(index - 1);
  const std::uint64_t* below = row_or_null(index + 1);
  int y = range.y_begin + index;
  if (y >= domain.height) y -= domain.height;
  const auto bit_of_row = [&](int x) {
    return (here[x / kWordBits - first_word_] >> (x % kWordBits)) & 1U;
  };
  for (int i = 0; i < words_; ++i) {
    const std::uint64_t free = here[i];
    if (free == 0) continue;
    const int word = first_word_ + i;
    std::uint64_t left = free << 1, right = free >> 1;
    if (i > 0) {
      left |= here[i - 1] >> (kWordBits - 1);
    } else if (around_x) {
      left |= bit_of_row(domain.width - 1);
    }
    if (i + 1 < words_) {
      right |= here[i + 1] << (kWordBits - 1);
    } else if (around_x) {
      const int last = (domain.width - 1) % kWordBits;
      right |= (here[0] & 1U) << last;
    }
    if (!range.whole) {  // beyond the range nothing is known
      left |= range.x_begin > 0 ? within(word, range.x_begin, range.x_begin + 1) : 0;
      right |= range.x_end < domain.width ? within(word, range.x_end - 1, range.x_end) : 0;
    }
    const auto blocked = count_of_four(~left, ~right, ~(above != nullptr ? above[i] : unknown),
                                       ~(below != nullptr ? below[i] : unknown));
    any_ = {word * kWordBits + std::countr_zero(free), y};
    for (std::size_t n = 1; n < blocked.size(); ++n) {
      for (std::uint64_t bits = blocked[n] & free; bits != 0; bits &= bits - 1) {
        by_blocked_[n].push_back({word * kWordBits + std::countr_zero(bits), y});
      }
    }
  }
}

/// The free translations of row y of the domain, within the range. False if there are none; then
/// what is in the row means nothing.
bool FreeMap::fill_row(const Occupancy& occupancy, const Probes& probes, const FreeRange& range,
                       int y, std::uint64_t* to) {
  if (!range.whole) {
    if (!free_row(occupancy, probes.all, y, first_word_, words_, to)) return false;
    bool any = false;
    for (int i = 0; i < words_; ++i) {
      to[i] &= within(first_word_ + i, range.x_begin, range.x_end);
      any = any || to[i] != 0;
    }
    return any;
  }
  if (!open_words(occupancy, probes, y, open_)) return false;
  bool any = false;
  std::fill(to, to + words_, std::uint64_t{0});
  for_each_run(open_.data(), words_, [&](int begin, int end) {
    prefetch_rows(occupancy, probes, y, begin, end - begin);
    any = free_row(occupancy, probes.all, y, begin, end - begin, to + begin) || any;
  });
  return any;
}

/// Where the next row that has a free translation goes.
std::uint64_t* FreeMap::next_row() {
  const std::size_t begin =
      static_cast<std::size_t>(kept_rows_) * static_cast<std::size_t>(stride_);
  const std::size_t end = begin + static_cast<std::size_t>(stride_);
  if (free_.size() < end) free_.resize(2 * end);
  return free_.data() + begin;
}

int FreeMap::scan(const Occupancy& occupancy, const Probes& probes, const FreeRange& range,
                  int enough) {
  const Domain& domain = occupancy.domain();
  first_word_ = range.x_begin / kWordBits;
  words_ = words_for(range.x_end) - first_word_;
  stride_ = words_ + 8;  // free_row() may write that much more
  first_row_ = -1;
  for (auto& shifts : by_blocked_) shifts.clear();
  row_of_.clear();
  kept_rows_ = 0;
  none_.assign(static_cast<std::size_t>(words_), 0);
  open_.resize(static_cast<std::size_t>(words_for(words_)));
  int rows = 0;
  for (; rows < range.y_count; ++rows) {
    int y = range.y_begin + rows;
    if (y >= domain.height) y -= domain.height;
    const bool any = fill_row(occupancy, probes, range, y, next_row());
    row_of_.push_back(any ? kept_rows_++ : -1);
    if (any && first_row_ < 0) first_row_ = rows;
    if (enough > 0 && first_row_ >= 0 && rows > first_row_) {
      rank(occupancy, range, rows - 1, rows + 1);
      const std::size_t tight =
          by_blocked_[2].size() + by_blocked_[3].size() + by_blocked_[4].size();
      if (tight >= static_cast<std::size_t>(enough)) return rows + 1;
    }
  }
  if (first_row_ < 0) return rows;
  // Where all rows are looked at, the last shows what is next to the first.
  for (int i = enough > 0 ? rows - 1 : first_row_; i < rows; ++i) rank(occupancy, range, i, rows);
  return rows;
}

void FreeMap::tightest(std::size_t count, std::vector<CellShift>& shifts) const {
  shifts.clear();
  for (std::size_t n = by_blocked_.size(); n-- > 0 && shifts.size() < count;) {
    const std::vector<CellShift>& equal = by_blocked_[n];
    const std::size_t wanted = count - shifts.size();
    if (equal.size() <= wanted) {
      shifts.insert(shifts.end(), equal.begin(), equal.end());
      continue;
    }
    for (std::size_t i = 0; i < wanted; ++i) shifts.push_back(equal[i * equal.size() / wanted]);
  }
  if (shifts.empty() && first_row_ >= 0) shifts.push_back(any_);
}

}  // namespace wrapatlas
