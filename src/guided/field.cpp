#include "guided/field.h"

#include <algorithm>

#include "guided/wrapped.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

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
  phase_rows_.clear();
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
  for_each_part(begin - x_.origin, end - x_.origin, domain_.width, clip);
}

void Field::add(const Piece& piece, int x, int y, int weight) {
  for (const PieceRun& run : piece.runs) {
    int row = y + run.row - y_.origin;
    if (domain_.wraps_y) row = modulo(row, domain_.height);
    if (row < 0 || row >= y_.count) continue;
    add_run(sums_.data() + static_cast<std::ptrdiff_t>(row) * stride_, x + run.begin, x + run.end,
            weight);
  }
}

namespace {

/// From changes to weights to the sums of the weights before each cell, in place; the sum of all.
std::uint16_t sum_row_from(std::uint16_t* row, int x, int count, std::uint16_t weight,
                           std::uint16_t sum) {
  for (; x < count; ++x) {
    weight = static_cast<std::uint16_t>(weight + row[x]);
    row[x] = sum;
    sum = static_cast<std::uint16_t>(sum + std::min<int>(weight, kLargestWeight));
  }
  return sum;
}

#if defined(__SSE2__)

/// Each of eight numbers becomes the sum of it and all before it.
__m128i running_sums(__m128i numbers) {
  numbers = _mm_add_epi16(numbers, _mm_slli_si128(numbers, 2));
  numbers = _mm_add_epi16(numbers, _mm_slli_si128(numbers, 4));
  return _mm_add_epi16(numbers, _mm_slli_si128(numbers, 8));
}

/// The last of eight numbers, eight times.
__m128i last_of(__m128i numbers) {
  return _mm_shuffle_epi32(_mm_shufflehi_epi16(numbers, 0xff), 0xff);
}

std::uint16_t sum_row(std::uint16_t* row, int count) {
  const __m128i largest = _mm_set1_epi16(kLargestWeight);
  const __m128i lanes = _mm_set_epi16(7, 6, 5, 4, 3, 2, 1, 0);
  const __m128i zero = _mm_setzero_si128();
  __m128i weight_before = zero, sum_before = zero;
  int x = 0;
  for (; x + 8 <= count; x += 8) {
    auto* cells = reinterpret_cast<__m128i*>(row + x);
    const __m128i changes = _mm_loadu_si128(cells);
    if (_mm_movemask_epi8(_mm_cmpeq_epi16(changes, zero)) ==
        0xffff) {  // most often: the weight stays
      const __m128i bounded = _mm_min_epi16(weight_before, largest);
      _mm_storeu_si128(cells, _mm_add_epi16(sum_before, _mm_mullo_epi16(bounded, lanes)));
      sum_before = _mm_add_epi16(sum_before, _mm_slli_epi16(bounded, 3));
      continue;
    }
    const __m128i weights = _mm_add_epi16(running_sums(changes), weight_before);
    const __m128i bounded = _mm_min_epi16(weights, largest);
    const __m128i sums = _mm_add_epi16(running_sums(bounded), sum_before);
    _mm_storeu_si128(cells, _mm_sub_epi16(sums, bounded));
    weight_before = last_of(weights);
    sum_before = last_of(sums);
  }
  return sum_row_from(row, x, count,
                      static_cast<std::uint16_t>(_mm_extract_epi16(weight_before, 0)),
                      static_cast<std::uint16_t>(_mm_extract_epi16(sum_before, 0)));
}

#else

std::uint16_t sum_row(std::uint16_t* row, int count) { return sum_row_from(row, 0, count, 0, 0); }

#endif

}  // namespace

void Field::sum() {
  for (int y = 0; y < y_.count; ++y) {
    std::uint16_t* row = sums_.data() + static_cast<std::ptrdiff_t>(y) * stride_;
    const std::uint16_t whole = sum_row(row, x_.count);
    if (!x_.cyclic) {
      std::fill(row + x_.count, row + stride_, whole);
      continue;
    }
    row[x_.count] = whole;
    for (int x = x_.count + 1; x < stride_; ++x) {
      row[x] = static_cast<std::uint16_t>(row[x - x_.count] + whole);
    }
  }
}

void Field::sort_by_phase() {
  phase_stride_ = stride_ / kBlock + kReadAhead;
  const auto row_size = static_cast<std::size_t>(phase_stride_) * kBlock;
  const auto rows = static_cast<std::size_t>(y_.count);
  phase_sums_.resize(row_size * rows);
  for (std::size_t y = 0; y < rows; ++y) {
    const std::uint16_t* from = rows_[y];
    std::uint16_t* to = phase_sums_.data() + row_size * y;
    for (int i = 0; i < stride_ / kBlock; ++i) {
      for (int phase = 0; phase < kBlock; ++phase) {
        to[phase * phase_stride_ + i] = from[i * kBlock + phase];
      }
    }
  }
  phase_rows_.resize(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    phase_rows_[i] = phase_sums_.data() + i % rows * row_size;
  }
}

}  // namespace wrapatlas
