// A quarter turn of a raster: (x, y) -> (height - y, x). Rotations come in fours of which only one
// has to be rasterised; the others are lanes in another order.

#include <algorithm>

#include "raster/chart_raster.h"

namespace wrapatlas {
namespace {

std::uint64_t reversed_bits(std::uint64_t bits) {
  bits = ((bits >> 1U) & 0x5555555555555555ULL) | ((bits & 0x5555555555555555ULL) << 1U);
  bits = ((bits >> 2U) & 0x3333333333333333ULL) | ((bits & 0x3333333333333333ULL) << 2U);
  bits = ((bits >> 4U) & 0x0f0f0f0f0f0f0f0fULL) | ((bits & 0x0f0f0f0f0f0f0f0fULL) << 4U);
  return __builtin_bswap64(bits);
}

/// A silhouette of the same size and sums, its lanes yet to be filled.
Silhouette blank_like(const Silhouette& source) {
  Silhouette result;
  result.bits = BitLanes(source.bits.lanes, source.bits.length);
  result.filled_lanes = source.filled_lanes;
  result.sum_first = source.sum_first;
  result.sum_last = source.sum_last;
  result.hollow = source.hollow;
  return result;
}

/// The same lanes, each read from its other end.
Silhouette positions_reversed(const Silhouette& source) {
  Silhouette result = blank_like(source);
  result.filled = source.filled;
  result.first = source.last;
  result.last = source.first;
  const int words = source.bits.words, spare = words * kWordBits - source.bits.length;
  const auto top = static_cast<std::int16_t>(source.bits.length - 1);
  for (int lane = 0; lane < source.bits.lanes; ++lane) {
    const std::uint64_t* from = source.bits.lane(lane);
    std::uint64_t* to = result.bits.lane(lane);
    for (int word = 0; word < words; ++word) {
      to[word] = reversed_bits(from[words - 1 - word]) >> spare;
      if (spare > 0 && word + 1 < words) {
        to[word] |= reversed_bits(from[words - 2 - word]) << (kWordBits - spare);
      }
    }
    const auto i = static_cast<std::size_t>(lane);
    const bool filled = source.first[i] <= source.last[i];
    result.first[i] = static_cast<std::int16_t>(filled ? top - source.last[i] : 1);
    result.last[i] = static_cast<std::int16_t>(filled ? top - source.first[i] : 0);
  }
  result.sum_first = source.filled_lanes * top - source.sum_last;
  result.sum_last = source.filled_lanes * top - source.sum_first;
  return result;
}

/// The same lanes, the last one first.
Silhouette lanes_reversed(const Silhouette& source) {
  Silhouette result = blank_like(source);
  for (int lane = 0; lane < source.bits.lanes; ++lane) {
    const std::uint64_t* from = source.bits.lane(source.bits.lanes - 1 - lane);
    std::copy(from, from + source.bits.words, result.bits.lane(lane));
  }
  result.first.assign(source.first.rbegin(), source.first.rend());
  result.last.assign(source.last.rbegin(), source.last.rend());
  for (auto run = source.filled.rbegin(); run != source.filled.rend(); ++run) {
    result.filled.push_back({source.bits.lanes - run->end, source.bits.lanes - run->begin});
  }
  return result;
}

}  // namespace

ChartRaster quarter_turned(const ChartRaster& raster) {
  ChartRaster turned;
  turned.width = raster.height;
  turned.height = raster.width;
  turned.cells = raster.cells;
  turned.angle = raster.angle;
  turned.offset = {raster.height - raster.offset.y, raster.offset.x};
  if (raster.width == 0) return turned;
  turned.columns = lanes_reversed(raster.rows);
  turned.rows = positions_reversed(raster.columns);
  return turned;
}

}  // namespace wrapatlas
