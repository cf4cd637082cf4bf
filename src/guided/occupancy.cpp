#include "guided/occupancy.h"

#include <algorithm>

#include "guided/wrapped.h"

namespace wrapatlas {
namespace {

/// A row has a word before its first bit, and vectors of eight words may begin at any of its bits.
constexpr int kSpareWords = 1 + 9;
/// Level of the longest stretches: longer runs are several of them. Most charts are 16 to 32 cells
/// long on the board they are sought on.
constexpr int kLongestStretch = 6;
/// Level of the largest squares: beyond, few charts on a board hold one.
constexpr int kLargestSquare = 4;

}  // namespace

Occupancy::Occupancy(const Domain& domain)
    : domain_(domain), stride_(words_for(2 * domain.width) + kSpareWords) {
  while (stretch_levels_ <= kLongestStretch && (1 << stretch_levels_) <= domain.width) {
    ++stretch_levels_;
  }
  while (square_levels_ <= kLargestSquare && square_levels_ < stretch_levels_ &&
         (1 << square_levels_) <= domain.height) {
    ++square_levels_;
  }
  const int tables = stretch_levels_ + square_levels_ - 1;
  bits_.resize(static_cast<std::size_t>(std::ptrdiff_t{tables} * domain.height * stride_));
  open_.resize(static_cast<std::size_t>(square_levels_) * static_cast<std::size_t>(domain.height),
               ~std::uint64_t{0});
  if (domain_.wraps_x && domain_.wraps_y) return;
  for (int y = 0; y < domain_.height; ++y) changed_.push_back(y);
  update();
}

void Occupancy::take(int y, int begin, int end) {
  y %= domain_.height;
  std::uint64_t* row = words(0, y);
  for_each_part(begin, end, domain_.width, [&](int from, int to) { set_span(row, from, to); });
  if (changed_.empty() || changed_.back() != y) changed_.push_back(y);
}

/// Fills in what lies outside of the domain.
void Occupancy::extend(std::uint64_t* row) const {
  const int width = domain_.width;
  const int last = width % kWordBits;
  const int end_word = static_cast<int>(stride_) - 1;
  if (!domain_.wraps_x) {
    row[-1] = ~std::uint64_t{0};
    int word = width / kWordBits;
    if (last != 0) row[word++] |= ~std::uint64_t{0} << last;
    std::fill(row + word, row + end_word, ~std::uint64_t{0});
    return;
  }
  int word = width / kWordBits;
  if (last != 0) row[word] &= ~std::uint64_t{0} >> (kWordBits - last);
  if (width >= kWordBits) {
    if (last != 0) row[word++] |= row[0] << last;
    for (; word < end_word; ++word) row[word] = bits_at(row, word * kWordBits - width);
    row[-1] = bits_at(row, width - kWordBits);
    return;
  }
  for (int x = width; x < end_word * kWordBits; ++x) {
    const std::uint64_t bit = (row[(x - width) / kWordBits] >> ((x - width) % kWordBits)) & 1U;
    if (x % kWordBits == 0) row[x / kWordBits] = 0;
    row[x / kWordBits] |= bit << (x % kWordBits);
  }
  row[-1] = bits_at(row, (kWordBits + width - 1) / width * width - kWordBits);
}

void Occupancy::update_stretches(int y) {
  extend(words(0, y));
  for (int level = 1; level < stretch_levels_; ++level) {
    const std::uint64_t* from = row(stretch_table(level - 1), y);
    std::uint64_t* to = words(stretch_table(level), y);
    const int step = 1 << (level - 1);
    for (int word = 0; word < words_for(domain_.width); ++word) {
      to[word] = from[word] | bits_at(from, word * kWordBits + step);
    }
    extend(to);
  }
}

/// A square is four of the level below.
void Occupancy::update_squares(int level, int y) {
  std::uint64_t& open = open_[static_cast<std::size_t>(level * domain_.height + y)];
  open = 0;
  const int step = 1 << (level - 1);
  std::uint64_t* to = words(square_table(level), y);
  if (!domain_.wraps_y && y + 2 * step > domain_.height) {
    std::fill(to - 1, to - 1 + stride_, ~std::uint64_t{0});
    return;
  }
  const int below = y + step < domain_.height ? y + step : y + step - domain_.height;
  const std::uint64_t* near = row(square_table(level - 1), y);
  const std::uint64_t* far = row(square_table(level - 1), below);
  for (int word = 0; word < words_for(domain_.width); ++word) {
    const int x = word * kWordBits + step;
    to[word] = near[word] | far[word] | bits_at(near, x) | bits_at(far, x);
  }
  extend(to);
  const std::ptrdiff_t words = stride_ - 1;
  for (std::ptrdiff_t word = 0, block = 0; word < words; word += kBlockWords, ++block) {
    std::uint64_t taken = ~std::uint64_t{0};
    for (std::ptrdiff_t i = word; i < std::min(word + kBlockWords, words); ++i) taken &= to[i];
    if (taken != ~std::uint64_t{0}) open |= std::uint64_t{1} << std::min<std::ptrdiff_t>(block, 63);
  }
}

void Occupancy::update() {
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  for (const int y : changed_) update_stretches(y);
  for (int level = 1; level < square_levels_; ++level) {
    // The rows whose squares reach into one that changed; those below 0 are at the other end.
    int next = domain_.wraps_y ? 1 - domain_.height : 0;
    for (const int y : changed_) {
      for (int row = std::max(next, y - (1 << level) + 1); row <= y; ++row) {
        update_squares(level, row < 0 ? row + domain_.height : row);
      }
      next = y + 1;
    }
  }
  changed_.clear();
}

}  // namespace wrapatlas
