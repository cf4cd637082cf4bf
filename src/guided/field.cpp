#include "guided/field.h"

#include <algorithm>

namespace wrapatlas {
namespace {
constexpr int kReadAhead = 64;  ///< cells a vector may read past the last place asked for
}

void Field::reset(const Domain& domain, Stretch x, Stretch y, int reach) {
  domain_ = domain;
  x_ = x;
  y_ = y;
  width_ = x.count + (x.cyclic ? reach : 0) + 1;
  stride_ = width_ + kReadAhead;
  sums_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(y.count), 0);
  rows_.resize(static_cast<std::size_t>(y.count + (y.cyclic ? reach : 0)));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i] =
        sums_.data() + i % static_cast<std::size_t>(y.count) * static_cast<std::size_t>(stride_);
  }
}

// A run adds its weight after its first cell and takes it off after its last; sum() makes weights
// and prefix sums of it.
void Field::add_run(std::uint16_t* row, int begin, int end, int weight) const {
  const auto change = static_cast<std::uint16_t>(weight);
  const auto clip = [&](int from, int to) {
    from = std::max(from, 0);
    to = std::min(to, x_.count);
    if (from >= to) return;
    row[from] = static_cast<std::uint16_t>(row[from] + change);
    row[to] = static_cast<std::uint16_t>(row[to] - change);
  };
  if (!domain_.wraps_x) {
    clip(begin - x_.origin, end - x_.origin);
    return;
  }
  const int w = domain_.width;
  int from = (begin - x_.origin) % w;
  if (from < 0) from += w;
  for (int left = end - begin; left > 0;) {
    const int part = std::min(left, w - from);
    clip(from, from + part);
    left -= part;
    from = 0;
  }
}

void Field::add(const Piece& piece, int x, int y, int weight) {
  const int h = domain_.height;
  for (const PieceRun& run : piece.runs) {
    int row = y + run.row - y_.origin;
    if (domain_.wraps_y) {
      row %= h;
      if (row < 0) row += h;
    }
    if (row < 0 || row >= y_.count) continue;
    add_run(sums_.data() + static_cast<std::ptrdiff_t>(row) * stride_, x + run.begin, x + run.end,
            weight);
  }
}

namespace {

/// From changes to weights to prefix sums, several rows at once: within a row each cell waits for
/// the one before it.
template <int kRows>
void sum_rows(std::uint16_t* first, int stride, int count) {
  std::uint16_t weight[kRows] = {}, sum[kRows] = {};
  for (int x = 0; x <= count; ++x) {
    for (int k = 0; k < kRows; ++k) {
      std::uint16_t& cell = first[static_cast<std::ptrdiff_t>(k) * stride + x];
      weight[k] = static_cast<std::uint16_t>(weight[k] + cell);
      cell = sum[k];
      sum[k] = static_cast<std::uint16_t>(sum[k] + weight[k]);
    }
  }
}

}  // namespace

void Field::sum() {
  constexpr int kTogether = 8;
  std::uint16_t* const first = sums_.data();
  int y = 0;
  for (; y + kTogether <= y_.count; y += kTogether) {
    sum_rows<kTogether>(first + static_cast<std::ptrdiff_t>(y) * stride_, stride_, x_.count);
  }
  for (; y < y_.count; ++y) {
    sum_rows<1>(first + static_cast<std::ptrdiff_t>(y) * stride_, stride_, x_.count);
  }
  for (y = 0; y < y_.count; ++y) {
    std::uint16_t* row = first + static_cast<std::ptrdiff_t>(y) * stride_;
    const std::uint16_t whole = row[x_.count];
    if (!x_.cyclic) {
      std::fill(row + x_.count + 1, row + stride_, whole);
      continue;
    }
    for (int x = x_.count + 1; x < stride_; ++x) {
      row[x] = static_cast<std::uint16_t>(row[x - x_.count] + whole);
    }
  }
}

}  // namespace wrapatlas
