#include "guided/best_shift.h"

#include <algorithm>
#include <vector>

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

/// What the core of a piece costs at the first translations of kTile blocks, from block `x` on, of
/// the rows of blocks that begin at `rows`. Bit k of the answer: block k has to be looked at.
using BoundKernel = std::uint32_t (*)(const std::uint16_t* const* rows, int phase_stride, int x,
                                      const PieceRun* run, const PieceRun* end,
                                      std::uint16_t limit);

/// Where sum number `at` of a row is, sorted by phase.
inline std::ptrdiff_t phase_offset(int at, int phase_stride) {
  return std::ptrdiff_t{at % kBlock} * phase_stride + at / kBlock;
}

std::uint32_t bound_scalar(const std::uint16_t* const* rows, int phase_stride, int x,
                           const PieceRun* run, const PieceRun* end, std::uint16_t limit) {
  unsigned costs[kTile] = {};
  for (; run != end; ++run) {
    const std::uint16_t* low = rows[run->row] + x + phase_offset(run->begin, phase_stride);
    const std::uint16_t* high = rows[run->row] + x + phase_offset(run->end, phase_stride);
    for (int k = 0; k < kTile; ++k) costs[k] += static_cast<std::uint16_t>(high[k] - low[k]);
  }
  std::uint32_t open = 0;
  for (int k = 0; k < kTile; ++k) {
    if (costs[k] < limit) open |= std::uint32_t{1} << k;
  }
  return open;
}

#if defined(__x86_64__)

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

[[gnu::target("avx2")]] std::uint32_t bound_avx2(const std::uint16_t* const* rows, int phase_stride,
                                                 int x, const PieceRun* run, const PieceRun* end,
                                                 std::uint16_t limit) {
  const __m256i limits = _mm256_set1_epi16(static_cast<short>(limit));
  __m256i a = _mm256_setzero_si256(), b = a, below_a = a, below_b = a;
  while (run != end) {
    const PieceRun* stop = std::min(run + kChunk, end);
    for (; run != stop; ++run) {
      const std::uint16_t* low = rows[run->row] + x + phase_offset(run->begin, phase_stride);
      const std::uint16_t* high = rows[run->row] + x + phase_offset(run->end, phase_stride);
      a = _mm256_adds_epu16(a, _mm256_sub_epi16(load(high), load(low)));
      b = _mm256_adds_epu16(b, _mm256_sub_epi16(load(high + 16), load(low + 16)));
    }
    below_a = _mm256_subs_epu16(limits, a);
    below_b = _mm256_subs_epu16(limits, b);
    const __m256i below = _mm256_or_si256(below_a, below_b);
    if (_mm256_testz_si256(below, below) != 0) return 0;
  }
  const __m256i zero = _mm256_setzero_si256();
  // Halves of 128 bits are packed side by side, so they are put in order again.
  const __m256i closed = _mm256_permute4x64_epi64(
      _mm256_packs_epi16(_mm256_cmpeq_epi16(below_a, zero), _mm256_cmpeq_epi16(below_b, zero)),
      0xd8);
  return ~static_cast<std::uint32_t>(_mm256_movemask_epi8(closed));
}

[[gnu::target("avx512f,avx512bw")]] std::uint32_t bound_avx512(const std::uint16_t* const* rows,
                                                               int phase_stride, int x,
                                                               const PieceRun* run,
                                                               const PieceRun* end,
                                                               std::uint16_t limit) {
  const __m512i limits = _mm512_set1_epi16(static_cast<short>(limit));
  __m512i a = _mm512_setzero_si512();
  std::uint32_t open = ~std::uint32_t{0};
  while (run != end) {
    const PieceRun* stop = std::min(run + kChunk, end);
    for (; run != stop; ++run) {
      const std::uint16_t* row = rows[run->row] + x;
      const __m512i low = _mm512_loadu_si512(row + phase_offset(run->begin, phase_stride));
      const __m512i high = _mm512_loadu_si512(row + phase_offset(run->end, phase_stride));
      a = _mm512_adds_epu16(a, _mm512_sub_epi16(high, low));
    }
    open = _mm512_cmplt_epu16_mask(a, limits);
    if (open == 0) return 0;
  }
  return open;
}
#endif

constexpr int kBlocksPerTile = kTile / kBlock;

[[gnu::always_inline]] inline void search(TileKernel tile, BoundKernel bound, const Field& field,
                                          const Piece& piece, const ShiftRange& range,
                                          Shift& best) {
  alignas(64) std::uint16_t costs[kTile];
  thread_local std::vector<std::uint8_t> open;  // tiles, from the one that x = 0 is in on
  const bool by_blocks = field.phases() != nullptr && !piece.core.empty();
  const int first_tile = range.x_begin / kTile, end_tile = (range.x_end + kTile - 1) / kTile;
  open.assign(static_cast<std::size_t>(end_tile) + kBlock, 1);
  const PieceRun* const runs = piece.spread.data();
  const PieceRun* const runs_end = runs + piece.spread.size();
  const int count = range.y_end - range.y_begin;
  int y = range.y_start;
  for (int i = 0; i < count;) {
    const int rows_of_block = std::min({kBlock, count - i, range.y_end - y});
    bool any = true;
    if (by_blocks) {
      any = false;
      // A tile of bounds covers as many tiles of translations as a block has columns.
      for (int t = first_tile / kBlock * kBlock; t < end_tile; t += kBlock) {
        const std::uint32_t blocks =
            bound(field.phases() + y, field.phase_stride(), t * kBlocksPerTile, piece.core.data(),
                  piece.core.data() + piece.core.size(), best.cost);
        any = any || blocks != 0;
        for (int k = 0; k < kBlock; ++k) {
          open[static_cast<std::size_t>(t + k)] = (blocks >> (k * kBlocksPerTile)) & 0xffU;
        }
      }
    }
    for (int row = 0; any && row < rows_of_block; ++row) {
      const std::uint16_t* const* rows = field.rows() + y + row;
      for (int t = first_tile; t < end_tile; ++t) {
        if (open[static_cast<std::size_t>(t)] == 0) continue;
        const int begin = std::max(t * kTile, range.x_begin);
        const int lanes = std::min((t + 1) * kTile, range.x_end) - begin;
        if (!tile(rows, begin, runs, runs_end, best.cost, costs)) continue;
        const std::uint16_t* least = std::min_element(costs, costs + lanes);
        if (*least >= best.cost) continue;
        best = {*least, begin + static_cast<int>(least - costs), y + row};
        if (best.cost == 0) return;
      }
    }
    i += rows_of_block;
    y += rows_of_block;
    if (y == range.y_end) y = range.y_begin;
  }
}

void search_scalar(const Field& field, const Piece& piece, const ShiftRange& range, Shift& best) {
  search(tile_scalar, bound_scalar, field, piece, range, best);
}
#if defined(__x86_64__)
void search_avx2(const Field& field, const Piece& piece, const ShiftRange& range, Shift& best) {
  search(tile_avx2, bound_avx2, field, piece, range, best);
}
void search_avx512(const Field& field, const Piece& piece, const ShiftRange& range, Shift& best) {
  search(tile_avx512, bound_avx512, field, piece, range, best);
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

void best_shift(const Field& field, const Piece& piece, const ShiftRange& range, Shift& best) {
  static const BestShiftKernel widest = [] {
    for (const BestShiftKernel kernel : {best_shift_avx512(), best_shift_avx2()}) {
      if (kernel != nullptr) return kernel;
    }
    return best_shift_scalar();
  }();
  widest(field, piece, range, best);
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
