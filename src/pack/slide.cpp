#include "pack/slide.h"

#include <algorithm>
#include <limits>

namespace wrapatlas {
namespace {

constexpr int kTile = 64;  ///< shifts worked on together; their results stay in registers

/// One tile of consecutive shifts. The inner loops have a fixed count and no aliasing, so each
/// compiler turns them into the vectors of the function they are inlined in.
[[gnu::always_inline]] inline void slide_tile(const std::int16_t* low, const std::int16_t* high,
                                              const Silhouette& chart, std::int16_t* lowest,
                                              std::int16_t* highest) {
  alignas(64) std::int16_t most[kTile], least[kTile];
  for (int s = 0; s < kTile; ++s) {
    most[s] = std::numeric_limits<std::int16_t>::min();
    least[s] = std::numeric_limits<std::int16_t>::max();
  }
  const int lanes = chart.lanes;
  const std::int16_t* firsts = chart.first();
  const std::int16_t* lasts = chart.last();
  for (int c = 0; c < lanes; ++c) {
    const std::int16_t first = firsts[c], last = lasts[c];
    if (first > last) continue;
    const auto end = static_cast<std::int16_t>(last + 1);
    const std::int16_t* lane_low = low + c;
    const std::int16_t* lane_high = high + c;
    for (int s = 0; s < kTile; ++s) {
      const auto value = static_cast<std::int16_t>(lane_low[s] - first);
      most[s] = most[s] < value ? value : most[s];
    }
    for (int s = 0; s < kTile; ++s) {
      const auto value = static_cast<std::int16_t>(lane_high[s] - end);
      least[s] = value < least[s] ? value : least[s];
    }
  }
  std::copy(most, most + kTile, lowest);
  std::copy(least, least + kTile, highest);
}

[[gnu::always_inline]] inline void slide_tiles(const std::int16_t* low, const std::int16_t* high,
                                               const Silhouette& chart, int shifts,
                                               std::int16_t* lowest, std::int16_t* highest) {
  for (int s = 0; s < shifts; s += kTile) {
    slide_tile(low + s, high + s, chart, lowest + s, highest + s);
  }
}

/// gap(s) = sign * (base + lanes * position[s] - sum over filled lanes of the channel), for shifts
/// that fit; the least and its first shift.
template <int kSign>
[[gnu::always_inline]] inline void least_gap(const SlideResult& range,
                                             const std::vector<std::int32_t>& sums,
                                             const Silhouette& chart, std::int32_t base, int begin,
                                             int end, Rest& rest) {
  constexpr std::int32_t kNever = std::numeric_limits<std::int32_t>::max();
  const std::int16_t* lowest = range.lowest.data();
  const std::int16_t* highest = range.highest.data();
  const std::int16_t* position = kSign > 0 ? lowest : highest;
  alignas(64) std::int32_t gap[kTile];
  for (int tile = begin / kTile * kTile; tile < end; tile += kTile) {
    for (int k = 0; k < kTile; ++k) gap[k] = base + chart.filled_lanes * position[tile + k];
    for (const Silhouette::LaneRun run : chart.filled()) {
      const std::int32_t* from = sums.data() + tile + run.begin;
      const std::int32_t* to = sums.data() + tile + run.end;
      for (int k = 0; k < kTile; ++k) gap[k] -= to[k] - from[k];
    }
    // Arithmetic instead of a choice, which g++ 12 would not vectorise: all ones where nothing
    // fits.
    for (int k = 0; k < kTile; ++k) {
      const std::int32_t blocked = (highest[tile + k] - lowest[tile + k]) >> 31;
      gap[k] = ((kSign * gap[k]) & ~blocked) | (kNever & blocked);
    }
    const int first = std::max(begin - tile, 0), last = std::min(end - tile, kTile);
    std::fill(gap, gap + first, kNever);
    std::fill(gap + last, gap + kTile, kNever);
    std::int32_t least = kNever;
    for (int k = 0; k < kTile; ++k) least = std::min(least, gap[k]);
    if (least >= rest.gap) continue;
    rest.gap = least;
    rest.shift = tile + static_cast<int>(std::find(gap, gap + kTile, least) - gap);
    rest.position = position[rest.shift];
    if (least == 0) break;  // no gap is smaller
  }
}

[[gnu::always_inline]] inline void least_gap_to(Side side, const Channel& channel,
                                                const Silhouette& chart, const SlideResult& range,
                                                int begin, int end, Rest& rest) {
  if (side == Side::low) {
    least_gap<1>(range, channel.low_sum, chart, chart.sum_first, begin, end, rest);
  } else {
    const std::int32_t base = chart.filled_lanes + chart.sum_last;
    least_gap<-1>(range, channel.high_sum, chart, base, begin, end, rest);
  }
}

// One version of each loop per instruction set: the same source, vectorised for each.

void slide_tiles_scalar(const std::int16_t* low, const std::int16_t* high, const Silhouette& chart,
                        int shifts, std::int16_t* lowest, std::int16_t* highest) {
  slide_tiles(low, high, chart, shifts, lowest, highest);
}
Rest best_rest_with_scalar(const Channel& channel, const Silhouette& chart,
                           const SlideResult& range, int begin, int end, Side side) {
  Rest rest;
  least_gap_to(side, channel, chart, range, begin, end, rest);
  return rest;
}

#if defined(__x86_64__)
#define WRAPATLAS_AVX2 [[gnu::target("avx2")]]
#define WRAPATLAS_AVX512 [[gnu::target("avx512f,avx512bw,avx512vl")]]

WRAPATLAS_AVX2 void slide_tiles_avx2(const std::int16_t* low, const std::int16_t* high,
                                     const Silhouette& chart, int shifts, std::int16_t* lowest,
                                     std::int16_t* highest) {
  slide_tiles(low, high, chart, shifts, lowest, highest);
}
WRAPATLAS_AVX2 Rest best_rest_with_avx2(const Channel& channel, const Silhouette& chart,
                                        const SlideResult& range, int begin, int end, Side side) {
  Rest rest;
  least_gap_to(side, channel, chart, range, begin, end, rest);
  return rest;
}

WRAPATLAS_AVX512 void slide_tiles_avx512(const std::int16_t* low, const std::int16_t* high,
                                         const Silhouette& chart, int shifts, std::int16_t* lowest,
                                         std::int16_t* highest) {
  slide_tiles(low, high, chart, shifts, lowest, highest);
}
WRAPATLAS_AVX512 Rest best_rest_with_avx512(const Channel& channel, const Silhouette& chart,
                                            const SlideResult& range, int begin, int end,
                                            Side side) {
  Rest rest;
  least_gap_to(side, channel, chart, range, begin, end, rest);
  return rest;
}
#endif

int padded(int shifts) { return (shifts + kTile - 1) / kTile * kTile; }

}  // namespace

void Channel::resize(int lane_count, int reach) {
  lanes = lane_count;
  const auto size = static_cast<std::size_t>(padded(lane_count) + reach + kTile);
  low.assign(size, 0);
  high.assign(size, 0);
  low_sum.assign(size + 1, 0);
  high_sum.assign(size + 1, 0);
}

void Channel::extend() {
  const auto count = static_cast<std::size_t>(lanes);
  for (std::size_t i = count; i < low.size(); ++i) {
    low[i] = low[i - count];
    high[i] = high[i - count];
  }
  for (std::size_t i = 0; i < low.size(); ++i) {
    low_sum[i + 1] = low_sum[i] + low[i];
    high_sum[i + 1] = high_sum[i] + high[i];
  }
}

SlideKernels scalar_kernels() { return {slide_tiles_scalar, best_rest_with_scalar}; }

SlideKernels avx2_kernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return {slide_tiles_avx2, best_rest_with_avx2};
#endif
  return {};
}

SlideKernels avx512_kernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
    return {slide_tiles_avx512, best_rest_with_avx512};
  }
#endif
  return {};
}

namespace {

const SlideKernels& widest_kernels() {
  static const SlideKernels kernels = [] {
    for (const SlideKernels& candidate : {avx512_kernels(), avx2_kernels()}) {
      if (candidate.slide != nullptr) return candidate;
    }
    return scalar_kernels();
  }();
  return kernels;
}

}  // namespace

void slide(const Channel& channel, const Silhouette& chart, int shifts, SlideResult& result) {
  const auto size = static_cast<std::size_t>(padded(shifts));
  if (result.lowest.size() < size) {
    result.lowest.resize(size);
    result.highest.resize(size);
  }
  widest_kernels().slide(channel.low.data(), channel.high.data(), chart, shifts,
                         result.lowest.data(), result.highest.data());
}

Rest best_rest(const Channel& channel, const Silhouette& chart, const SlideResult& range, int begin,
               int end, Side side) {
  return widest_kernels().best_rest(channel, chart, range, begin, end, side);
}

}  // namespace wrapatlas
