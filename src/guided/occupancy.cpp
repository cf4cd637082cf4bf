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
    : domain_(domain),
      stride_(words_for(2 * domain.width) + kSpareWords),
      open_stride_(2 * words_for(words_for(domain.width)) + 2) {
  while (stretch_levels_ <= kLongestStretch && (1 << stretch_levels_) <= domain.width) {
    ++stretch_levels_;
  }
  while (square_levels_ <= kLargestSquare && square_levels_ < stretch_levels_ &&
         (1 << square_levels_) <= domain.height) {
    ++square_levels_;
  }
  const int tables = stretch_levels_ + square_levels_ - 1;
  bits_.resize(static_cast<std::size_t>(std::ptrdiff_t{tables} * domain.height * stride_));
  open_.resize(
      static_cast<std::size_t>(std::ptrdiff_t{square_levels_} * domain.height * open_stride_),
      ~std::uint64_t{0});
  if (domain_.wraps_x && domain_.wraps_y) return;
  for (int y = 0; y < domain_.height; ++y) changed_.push_back(y);
  first_changed_ = 0;
  last_changed_ = words_for(domain_.width) - 1;
  update();
}

void Occupancy::take(int y, int begin, int end) {
  if (begin >= end) return;
  y %= domain_.height;
  std::uint64_t* row = words(0, y);
  for_each_part(begin, end, domain_.width, [&](int from, int to) {
    set_span(row, from, to);
    const int first = from / kWordBits, last = (to - 1) / kWordBits;
    first_changed_ = last_changed_ < 0 ? first : std::min(first_changed_, first);
    last_changed_ = std::max(last_changed_, last);
  });
  if (changed_.empty() || changed_.back() != y) changed_.push_back(y);
}

/// The words of any table that a change of table 0 can reach: a bit stands for at most 64, from its
/// own on. All, where those beyond a side are not just the same words again.
Occupancy::Span Occupancy::span_of_change() const {
  const int count = words_for(domain_.width);
  const bool same_again = domain_.width % kWordBits == 0 && first_changed_ > 0;
  if (domain_.wraps_x && !same_again) return {0, count};
  return {std::max(first_changed_ - 1, 0), last_changed_ + 1};
}

bool Occupancy::is_whole(Span span) const {
  return span.to - span.from == words_for(domain_.width);
}

/// Fills in what lies outside of the domain, where these words have changed.
void Occupancy::extend(std::uint64_t* row, Span span) const {
  if (is_whole(span)) {
    extend_whole(row);
  } else if (domain_.wraps_x) {
    repeat(row, span);
  }
}

void Occupancy::extend_whole(std::uint64_t* row) const {
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
  if (last == 0) {
    repeat(row, {0, width / kWordBits});
    return;
  }
  int word = width / kWordBits;
  row[word] &= ~std::uint64_t{0} >> (kWordBits - last);
  if (width >= kWordBits) {
    row[word++] |= row[0] << last;
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

/// Of a domain of whole words: these words again and again.
void Occupancy::repeat(std::uint64_t* row, Span span) const {
  const int count = domain_.width / kWordBits;
  const int end_word = static_cast<int>(stride_) - 1;
  for (int around = count; around + span.from < end_word; around += count) {
    std::copy(row + span.from, row + std::min(span.to, end_word - around),
              row + around + span.from);
  }
  row[-1] = row[count - 1];
}

void Occupancy::update_stretches(int y, Span span) {
  extend(words(0, y), span);
  for (int level = 1; level < stretch_levels_; ++level) {
    const std::uint64_t* from = row(stretch_table(level - 1), y);
    std::uint64_t* to = words(stretch_table(level), y);
    const int step = 1 << (level - 1);
    for (int word = span.from; word < span.to; ++word) {
      to[word] = from[word] | bits_at(from, word * kWordBits + step);
    }
    extend(to, span);
  }
}

/// A square is four of the level below.
void Occupancy::update_squares(int level, int y, Span span) {
  const int step = 1 << (level - 1);
  std::uint64_t* to = words(square_table(level), y);
  if (!domain_.wraps_y && y + 2 * step > domain_.height) {
    std::fill(to - 1, to - 1 + stride_, ~std::uint64_t{0});
    set_open(level, y, {0, words_for(domain_.width)});
    return;
  }
  const int below = y + step < domain_.height ? y + step : y + step - domain_.height;
  const std::uint64_t* near = row(square_table(level - 1), y);
  const std::uint64_t* far = row(square_table(level - 1), below);
  for (int word = span.from; word < span.to; ++word) {
    const int x = word * kWordBits + step;
    to[word] = near[word] | far[word] | bits_at(near, x) | bits_at(far, x);
  }
  extend(to, span);
  set_open(level, y, span);
}

/// For these words and their repetitions; all, if they are the whole domain's.
void Occupancy::set_open(int level, int y, Span span) {
  const std::uint64_t* row = this->row(square_table(level), y);
  std::uint64_t* open = open_.data() + (std::ptrdiff_t{level} * domain_.height + y) * open_stride_;
  const int count = words_for(domain_.width);
  const auto end_word = static_cast<int>(std::min(stride_ - 1, open_stride_ * kWordBits));
  const int end = is_whole(span) ? end_word : span.to;
  for (int around = 0; around + span.from < end_word; around += count) {
    for (int word = around + span.from; word < std::min(around + end, end_word); ++word) {
      const std::uint64_t bit = std::uint64_t{1} << (word % kWordBits);
      std::uint64_t& bits = open[word / kWordBits];
      bits = row[word] != ~std::uint64_t{0} ? bits | bit : bits & ~bit;
    }
    if (is_whole(span)) return;
  }
}

void Occupancy::update() {
  if (changed_.empty()) return;
  const Span span = span_of_change();
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  for (const int y : changed_) update_stretches(y, span);
  for (int level = 1; level < square_levels_; ++level) {
    // The rows whose squares reach into one that changed; those below 0 are at the other end.
    int next = domain_.wraps_y ? 1 - domain_.height : 0;
    for (const int y : changed_) {
      for (int row = std::max(next, y - (1 << level) + 1); row <= y; ++row) {
        update_squares(level, row < 0 ? row + domain_.height : row, span);
      }
      next = y + 1;
    }
  }
  changed_.clear();
  last_changed_ = -1;
}

}  // namespace wrapatlas
