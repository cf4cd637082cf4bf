// Sliding a chart's two horizons through a channel: for every shift across the lanes at once, how
// low and how high the chart may lie.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "raster/chart_raster.h"

namespace wrapatlas {

/// Per lane the free interval [low, high) that a chart may use, in unwrapped positions.
/// `low` and `high` are extended cyclically so that shift + lane never needs a modulo.
struct Channel {
  int lanes = 0;
  std::vector<std::int16_t> low, high;
  std::vector<std::int32_t> low_sum, high_sum;  ///< prefix sums of the extended arrays

  /// Makes room for `lane_count` lanes and charts of up to `reach` lanes.
  void resize(int lane_count, int reach);
  /// Fills the cyclic extension and the prefix sums from the first `lanes` entries.
  void extend();
};

/// The outcome of sliding one chart orientation through one channel, per shift.
struct SlideResult {
  std::vector<std::int16_t> lowest, highest;  ///< position range; lowest > highest: does not fit
};

/// For shift s = 0 .. shifts-1:
///   lowest[s]  = max over filled lanes c of low[s + c] - first[c]
///   highest[s] = min over filled lanes c of high[s + c] - 1 - last[c]
/// Runs the widest SIMD version the machine has; all give the same numbers.
void slide(const Channel& channel, const Silhouette& chart, int shifts, SlideResult& result);

/// The side of a channel that a chart rests against.
enum class Side { low, high };

/// Where a chart comes to rest.
struct Rest {
  std::int32_t gap =
      std::numeric_limits<std::int32_t>::max();  ///< free cells between, Fig. 4 green
  int shift = -1;                                ///< -1: it fits nowhere
  int position = 0;
};

/// The first shift in [begin, end) of least gap between the chart and that side of the channel:
///   low:  sum over filled lanes c of lowest[s] + first[c] - low[s + c]
///   high: sum over filled lanes c of high[s + c] - 1 - last[c] - highest[s]
Rest best_rest(const Channel& channel, const Silhouette& chart, const SlideResult& range, int begin,
               int end, Side side);

/// The versions of both loops for one instruction set, for tests and benchmarks; null where the
/// machine lacks it.
struct SlideKernels {
  void (*slide)(const std::int16_t* low, const std::int16_t* high, const Silhouette& chart,
                int shifts, std::int16_t* lowest, std::int16_t* highest) = nullptr;
  Rest (*best_rest)(const Channel& channel, const Silhouette& chart, const SlideResult& range,
                    int begin, int end, Side side) = nullptr;
};
SlideKernels scalar_kernels();
SlideKernels avx2_kernels();
SlideKernels avx512_kernels();

}  // namespace wrapatlas
