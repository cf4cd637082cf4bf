#include "guided/cover.h"

#include <algorithm>
#include <bit>

#include "guided/wrapped.h"

namespace wrapatlas {

void Cover::set(const Domain& domain, const Piece& piece, int x, int y) {
  domain_height_ = domain.height;
  y_ = y;
  rows_ = std::min(piece.height, domain.height);
  words_ = words_for(domain.width);
  const bool around = x + piece.width > domain.width;
  first_word_ = around ? 0 : x / kWordBits;
  end_word_ = around ? words_ : words_for(x + piece.width);
  bits_.assign(static_cast<std::size_t>(words_) * static_cast<std::size_t>(rows_), 0);
  for (const PieceRun& run : piece.runs) {
    std::uint64_t* row =
        bits_.data() + static_cast<std::ptrdiff_t>(modulo(run.row, domain.height)) * words_;
    for_each_part(x + run.begin, x + run.end, domain.width,
                  [&](int from, int to) { set_span(row, from, to); });
  }
}

std::int64_t Cover::shared(const Cover& a, const Cover& b) {
  const int first = std::max(a.first_word_, b.first_word_);
  const int end = std::min(a.end_word_, b.end_word_);
  if (first >= end) return 0;
  std::int64_t count = 0;
  int other = a.y_ - b.y_;
  if (other < 0) other += a.domain_height_;
  for (int row = 0; row < a.rows_; ++row, ++other) {
    if (other == a.domain_height_) other = 0;
    if (other >= b.rows_) continue;
    const std::uint64_t* p = a.bits_.data() + static_cast<std::ptrdiff_t>(row) * a.words_;
    const std::uint64_t* q = b.bits_.data() + static_cast<std::ptrdiff_t>(other) * b.words_;
    for (int word = first; word < end; ++word) count += std::popcount(p[word] & q[word]);
  }
  return count;
}

}  // namespace wrapatlas
