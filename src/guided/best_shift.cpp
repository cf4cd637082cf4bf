#include "guided/best_shift.h"

#include <algorithm>
#include <vector>

#include "guided/costs.h"

namespace wrapatlas {
namespace {

/// What runs cost at the translations from x on; offset(k) is where sum number k of a row is. False
/// as soon as no cost is below the limit: then costs are lower bounds.
template <typename Costs, typename Offset>
[[gnu::always_inline]] inline bool add_runs(Costs& costs, const std::uint16_t* const* rows, int x,
                                            std::span<const PieceRun> runs, std::uint16_t limit,
                                            Offset offset) {
  constexpr std::size_t kChunk = 4;  // runs between two looks at whether it is still worth while
  const PieceRun* run = runs.data();
  const PieceRun* const end = run + runs.size();
  while (run != end) {
    const PieceRun* const stop = std::min(run + kChunk, end);
    for (; run != stop; ++run) {
      const std::uint16_t* row = rows[run->row] + x;
      costs.add(row + offset(run->end), row + offset(run->begin));
    }
    if (!costs.any_below(limit)) return false;
  }
  return true;
}

/// Costs of one tile, or false where none is below the limit.
template <typename Costs>
[[gnu::always_inline]] inline bool tile(const std::uint16_t* const* rows, int x,
                                        std::span<const PieceRun> runs, std::uint16_t limit,
                                        std::uint16_t* result) {
  Costs costs;
  if (!add_runs(costs, rows, x, runs, limit, [](int k) { return k; })) return false;
  costs.store(result);
  return true;
}

/// What the core of a piece costs at the first translations of kTile blocks, from block `x` on, of
/// the rows of blocks that begin at `rows`. Bit k of the answer: block k has to be looked at.
template <typename Costs>
[[gnu::always_inline]] inline std::uint32_t bound(const std::uint16_t* const* rows,
                                                  int phase_stride, int x,
                                                  std::span<const PieceRun> core,
                                                  std::uint16_t limit) {
  Costs costs;
  const auto by_phase = [&](int k) {
    return std::ptrdiff_t{k % kBlock} * phase_stride + k / kBlock;
  };
  return add_runs(costs, rows, x, core, limit, by_phase) ? costs.below(limit) : 0;
}

constexpr int kBlocksPerTile = kTile / kBlock;

template <typename Costs>
[[gnu::always_inline]] inline void search(const Field& field, const Piece& piece,
                                          const ShiftRange& range, Shift& best) {
  alignas(64) std::uint16_t costs[kTile];
  thread_local std::vector<std::uint8_t> open;  // tiles, from the one that x = 0 is in on
  const bool by_blocks = field.phases() != nullptr && !piece.core.empty();
  const int first_tile = range.x_begin / kTile, end_tile = (range.x_end + kTile - 1) / kTile;
  open.assign(static_cast<std::size_t>(end_tile) + kBlock, 1);
  const int count = range.y_end - range.y_begin;
  int y = range.y_start;
  for (int i = 0; i < count;) {
    const int rows_of_block = std::min({kBlock, count - i, range.y_end - y});
    bool any = true;
    if (by_blocks) {
      any = false;
      // A tile of bounds covers as many tiles of translations as a block has columns.
      for (int t = first_tile / kBlock * kBlock; t < end_tile; t += kBlock) {
        const std::uint32_t blocks = bound<Costs>(field.phases() + y, field.phase_stride(),
                                                  t * kBlocksPerTile, piece.core, best.cost);
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
        if (!tile<Costs>(rows, begin, piece.spread, best.cost, costs)) continue;
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
  search<ScalarCosts>(field, piece, range, best);
}

#if defined(__x86_64__)
WRAPATLAS_AVX2 void search_avx2(const Field& field, const Piece& piece, const ShiftRange& range,
                                Shift& best) {
  search<Avx2Costs>(field, piece, range, best);
}
WRAPATLAS_AVX512 void search_avx512(const Field& field, const Piece& piece, const ShiftRange& range,
                                    Shift& best) {
  search<Avx512Costs>(field, piece, range, best);
}
constexpr Versions<BestShiftKernel> kBestShiftVersions{search_scalar, search_avx2, search_avx512};
#else
constexpr Versions<BestShiftKernel> kBestShiftVersions{search_scalar, nullptr, nullptr};
#endif

}  // namespace

std::vector<BestShiftKernel> best_shift_kernels() { return kBestShiftVersions.usable(); }

void best_shift(const Field& field, const Piece& piece, const ShiftRange& range, Shift& best) {
  static const BestShiftKernel widest = best_shift_kernels().front();
  widest(field, piece, range, best);
}

std::uint16_t cost_at(const Field& field, std::span<const PieceRun> runs, int x, int y) {
  unsigned cost = 0;
  for (const PieceRun& run : runs) {
    const std::uint16_t* row = field.rows()[y + run.row] + x;
    cost += static_cast<std::uint16_t>(row[run.end] - row[run.begin]);
    if (cost >= kMostCost) return kMostCost;
  }
  return static_cast<std::uint16_t>(cost);
}

}  // namespace wrapatlas
