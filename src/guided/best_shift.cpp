#include "guided/best_shift.h"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace wrapatlas {
namespace {

constexpr int kTile = 32;          ///< translations along x worked on together
constexpr std::size_t kChunk = 4;  ///< runs between two looks at whether it is still worth while

/// Costs of one tile, or an early end: with it, costs hold a lower bound none of which is < limit.
using TileKernel = bool (*)(const std::uint16_t* const* rows, int x, const PieceRun* run,
                            const PieceRun* end, std::uint16_t limit, std::uint16_t* costs);

bool tile_scalar(const std::uint16_t* const* rows, int x, const PieceRun* run, const PieceRun* end,
                 std::uint16_t limit, std::uint16_t* costs) {
  std::fill(costs, costs + kTile, std::uint16_t{0});
  while (run != end) {
    const PieceRun* stop = std::min(run + kChunk, end);
    for (; run != stop; ++run) {
      const std::uint16_t* low = rows[run->row] + x + run->begin;
      const std::uint16_t* high = rows[run->row] + x + run->end;
      for (int k = 0; k < kTile; ++k) {
        const unsigned sum = costs[k] + static_cast<std::uint16_t>(high[k] - low[k]);
        costs[k] = static_cast<std::uint16_t>(std::min(sum, 0xffffU));
      }
    }
    if (std::all_of(costs, costs + kTile, [&](std::uint16_t c) { return c >= limit; }))
      return false;
  }
  return true;
}

#if defined(__x86_64__)

__m256i load(const std::uint16_t* from) __attribute__((target("avx2")));
[[gnu::target("avx2")]] inline __m256i load(const std::uint16_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

[[gnu::target("avx2")]] bool tile_avx2(const std::uint16_t* const* rows, int x, const PieceRun* run,
                                       const PieceRun* end, std::uint16_t limit,
                                       std::uint16_t* costs) {
  const __m256i limits = _mm256_set1_epi16(static_cast<short>(limit));
  __m256i a = _mm256_setzero_si256(), b = a;
  while (run != end) {
    const PieceRun* stop = std::min(run + kChunk, end);
    for (; run != stop; ++run) {
      const std::uint16_t* low = rows[run->row] + x + run->begin;
      const std::uint16_t* high = rows[run->row] + x + run->end;
      a = _mm256_adds_epu16(a, _mm256_sub_epi16(load(high), load(low)));
      b = _mm256_adds_epu16(b, _mm256_sub_epi16(load(high + 16), load(low + 16)));
    }
    const __m256i below =
        _mm256_or_si256(_mm256_subs_epu16(limits, a), _mm256_subs_epu16(limits, b));
    if (_mm256_testz_si256(below, below) != 0) return false;
  }
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(costs), a);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(costs + 16), b);
  return true;
}

[[gnu::target("avx512f,avx512bw")]] bool tile_avx512(const std::uint16_t* const* rows, int x,
                                                     const PieceRun* run, const PieceRun* end,
                                                     std::uint16_t limit, std::uint16_t* costs) {
  const __m512i limits = _mm512_set1_epi16(static_cast<short>(limit));
  __m512i a = _mm512_setzero_si512();
  while (run != end) {
    const PieceRun* stop = std::min(run + kChunk, end);
    for (; run != stop; ++run) {
      const std::uint16_t* row = rows[run->row] + x;
      const __m512i low = _mm512_loadu_si512(row + run->begin);
      a = _mm512_adds_epu16(a, _mm512_sub_epi16(_mm512_loadu_si512(row + run->end), low));
    }
    if (_mm512_cmplt_epu16_mask(a, limits) == 0) return false;
  }
  _mm512_storeu_si512(costs, a);
  return true;
}
#endif

[[gnu::always_inline]] inline void search(TileKernel tile, const Field& field,
                                          std::span<const PieceRun> runs, const ShiftRange& range,
                                          Shift& best) {
  alignas(64) std::uint16_t costs[kTile];
  const int count = range.y_end - range.y_begin;
  int y = range.y_start;
  for (int i = 0; i < count; ++i, ++y) {
    if (y >= range.y_end) y -= count;
    const std::uint16_t* const* rows = field.rows() + y;
    for (int x = range.x_begin; x < range.x_end; x += kTile) {
      if (!tile(rows, x, runs.data(), runs.data() + runs.size(), best.cost, costs)) continue;
      const int lanes = std::min(kTile, range.x_end - x);
      const std::uint16_t* least = std::min_element(costs, costs + lanes);
      if (*least >= best.cost) continue;
      best = {*least, x + static_cast<int>(least - costs), y};
      if (best.cost == 0) return;
    }
  }
}

void search_scalar(const Field& field, std::span<const PieceRun> runs, const ShiftRange& range,
                   Shift& best) {
  search(tile_scalar, field, runs, range, best);
}
#if defined(__x86_64__)
void search_avx2(const Field& field, std::span<const PieceRun> runs, const ShiftRange& range,
                 Shift& best) {
  search(tile_avx2, field, runs, range, best);
}
void search_avx512(const Field& field, std::span<const PieceRun> runs, const ShiftRange& range,
                   Shift& best) {
  search(tile_avx512, field, runs, range, best);
}
#endif

}  // namespace

BestShiftKernel best_shift_scalar() { return search_scalar; }

BestShiftKernel best_shift_avx2() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return search_avx2;
#endif
  return nullptr;
}

BestShiftKernel best_shift_avx512() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512bw")) return search_avx512;
#endif
  return nullptr;
}

void best_shift(const Field& field, std::span<const PieceRun> runs, const ShiftRange& range,
                Shift& best) {
  static const BestShiftKernel widest = [] {
    for (const BestShiftKernel kernel : {best_shift_avx512(), best_shift_avx2()}) {
      if (kernel != nullptr) return kernel;
    }
    return best_shift_scalar();
  }();
  widest(field, runs, range, best);
}

std::uint16_t cost_at(const Field& field, std::span<const PieceRun> runs, int x, int y) {
  unsigned cost = 0;
  for (const PieceRun& run : runs) {
    const std::uint16_t* row = field.rows()[y + run.row] + x;
    cost += static_cast<std::uint16_t>(row[run.end] - row[run.begin]);
  }
  return static_cast<std::uint16_t>(std::min(cost, static_cast<unsigned>(kMostCost)));
}

}  // namespace wrapatlas
