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

BitLanes positions_reversed(const BitLanes& source) {
  BitLanes result(source.lanes, source.length);
  const int words = source.words, spare = words * kWordBits - source.length;
  for (int lane = 0; lane < source.lanes; ++lane) {
    const std::uint64_t* from = source.lane(lane);
    std::uint64_t* to = result.lane(lane);
    for (int word = 0; word < words; ++word) {
      to[word] = reversed_bits(from[words - 1 - word]) >> spare;
      if (spare > 0 && word + 1 < words) {
        to[word] |= reversed_bits(from[words - 2 - word]) << (kWordBits - spare);
      }
    }
  }
  return result;
}

BitLanes lanes_reversed(const BitLanes& source) {
  BitLanes result(source.lanes, source.length);
  for (int lane = 0; lane < source.lanes; ++lane) {
    const std::uint64_t* from = source.lane(source.lanes - 1 - lane);
    std::copy(from, from + source.words, result.lane(lane));
  }
  return result;
}

/// The same lanes, each read from its other end.
Silhouette positions_reversed(const Silhouette& source) {
  Silhouette result = source;
  const int top = source.length - 1;
  const std::int16_t* first = source.first();
  const std::int16_t* last = source.last();
  for (int i = 0; i < source.lanes; ++i) {
    const bool filled = first[i] <= last[i];
    result.first()[i] = static_cast<std::int16_t>(filled ? top - last[i] : 1);
    result.last()[i] = static_cast<std::int16_t>(filled ? top - first[i] : 0);
  }
  result.sum_first = source.filled_lanes * top - source.sum_last;
  result.sum_last = source.filled_lanes * top - source.sum_first;
  return result;
}

/// The same lanes, the last one first.
Silhouette lanes_reversed(const Silhouette& source) {
  Silhouette result = source;
  std::reverse(result.first(), result.last());
  std::reverse(result.last(), result.last() + result.lanes);
  const auto reversed = [&](const Silhouette::LaneRun& run) {
    return Silhouette::LaneRun{source.lanes - run.end, source.lanes - run.begin};
  };
  result.run = reversed(source.run);
  std::transform(source.split_runs.rbegin(), source.split_runs.rend(), result.split_runs.begin(),
                 reversed);
  return result;
}

}  // namespace

ChartRaster quarter_turned(const ChartRaster& raster) {
  ChartRaster turned;
  turned.width = raster.height;
  turned.height = raster.width;
  turned.cells = raster.cells;
  turned.angle = raster.angle;
  turned.centre = {raster.height - raster.centre.y, raster.centre.x};
  turned.offset = {raster.height - raster.offset.y, raster.offset.x};
  if (raster.width == 0) return turned;
  turned.columns = lanes_reversed(raster.rows);
  turned.rows = positions_reversed(raster.columns);
  turned.unturned = raster.unturned;
  turned.turns = (raster.turns + 1) % 4;
  return turned;
}

CellViews cells_of(const ChartRaster& raster) {
  CellViews views{transposed(*raster.unturned), *raster.unturned};
  if (raster.turns >= 2) {
    views.columns = lanes_reversed(positions_reversed(views.columns));
    views.rows = lanes_reversed(positions_reversed(views.rows));
  }
  if (raster.turns % 2 == 1) {
    views = {lanes_reversed(views.rows), positions_reversed(views.columns)};
  }
  return views;
}

}  // namespace wrapatlas
