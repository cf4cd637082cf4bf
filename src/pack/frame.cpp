#include "pack/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

struct AxisGrid {
  int cells = 0;
  double cell = 0, origin = 0;
};

int cell_count(double cells) {
  return static_cast<int>(std::clamp(cells, 0.0, kMaxGridSide + 1.0));
}

/// Blocks are cells of a whole number of blocks each, so that no two charts share a block.
AxisGrid block_axis(int length, bool wrap, double inset, int block, int blocks_per_cell) {
  AxisGrid axis;
  axis.cell = double(block) * blocks_per_cell;
  if (wrap) {
    axis.cells = length / (block * blocks_per_cell);
    return axis;
  }
  axis.origin = std::ceil(std::max(inset, 0.0) / block) * block;
  axis.cells =
      static_cast<int>(std::floor((length - axis.origin - std::max(inset, 0.0)) / axis.cell));
  return axis;
}

AxisGrid free_axis(int length, bool wrap, double inset, double cell) {
  AxisGrid axis;
  if (wrap) {
    axis.cells = std::max(1, cell_count(std::round(length / cell)));
    axis.cell = double(length) / axis.cells;
    return axis;
  }
  axis.cell = cell;
  axis.origin = inset;
  axis.cells = cell_count(std::floor((length - 2 * inset) / cell + 1e-9));
  return axis;
}

/// As padding_slack(), where UVs are larger numbers: two charts may each be moved to the beginning
/// of their tile (atlas/chart_uvs.cpp), then be rounded to floats, and those to text.
double pages_slack(int width, int height, int pages) {
  if (pages == 1) return 0;
  constexpr double kPair = 2, kMoved = 2, kRounded = 2;
  return kPair * (kMoved + kRounded) * page_rounding(pages > 0 ? pages : kMostPages) *
         std::hypot(width, height);
}

/// The largest number of blocks to a cell, up to the wish, that divides both wrapping lengths.
int blocks_to_a_cell(int width, int height, double wish, const PackOptions& options) {
  const auto divides = [&](int blocks) {
    const int cell = blocks * options.block;
    return (!wraps_u(options.wrap) || width % cell == 0) &&
           (!wraps_v(options.wrap) || height % cell == 0);
  };
  int blocks = std::max(1, static_cast<int>(std::lround(wish / options.block)));
  while (blocks > 1 && !divides(blocks)) --blocks;
  return blocks;
}

}  // namespace

double padding_slack(int texture_width, int texture_height) {
  constexpr double kLeast = 1.0 / 128, kLargestUv = 4, kFloatHalfUnit = 1.0 / (1 << 24);
  return std::max(kLeast,
                  2 * kFloatHalfUnit * kLargestUv * std::hypot(texture_width, texture_height));
}

Result<Frame> make_frame(int texture_width, int texture_height, double cell,
                         const PackOptions& options) {
  const double margin = options.margin < 0 ? options.padding / 2 : options.margin;
  const double inset = margin - options.padding / 2;
  Frame frame;
  frame.texture_width = texture_width;
  frame.texture_height = texture_height;
  AxisGrid x, y;
  if (options.block > 1) {
    if (texture_width % options.block != 0 || texture_height % options.block != 0) {
      return Error{ErrorKind::usage, fmt::format("{} x {} texels", texture_width, texture_height),
                   fmt::format("not a multiple of the block size {}", options.block),
                   "choose another --resolution or --block"};
    }
    const int blocks = blocks_to_a_cell(texture_width, texture_height, cell, options);
    x = block_axis(texture_width, wraps_u(options.wrap), inset, options.block, blocks);
    y = block_axis(texture_height, wraps_v(options.wrap), inset, options.block, blocks);
  } else {
    x = free_axis(texture_width, wraps_u(options.wrap), inset, cell);
    y = free_axis(texture_height, wraps_v(options.wrap), inset, cell);
  }
  if (std::max(x.cells, y.cells) > kMaxGridSide) {
    return Error{
        ErrorKind::usage, fmt::format("{} x {} texels", texture_width, texture_height),
        "the search grid would be too fine",
        fmt::format("lower --grid or --padding: {} cells a side are the limit", kMaxGridSide)};
  }
  if (x.cells < 1 || y.cells < 1) {
    return Error{ErrorKind::usage, fmt::format("{} x {} texels", texture_width, texture_height),
                 fmt::format("a margin of {} texels leaves no room", margin),
                 "choose a smaller --margin or a larger --resolution"};
  }
  frame.width = x.cells;
  frame.height = y.cells;
  frame.cell = {x.cell, y.cell};
  frame.origin = {x.origin, y.origin};
  if (options.coverage == Coverage::conservative || options.padding > 0) {
    const double slack = options.coverage == Coverage::conservative
                             ? padding_slack(texture_width, texture_height) +
                                   pages_slack(texture_width, texture_height, options.pages)
                             : 0;
    frame.growth = (options.padding + slack) / 2 / std::min(x.cell, y.cell);
  }
  return frame;
}

RasterScale raster_scale_on(const Frame& frame, double scale, Coverage coverage) {
  return {{scale / frame.cell.x, scale / frame.cell.y}, frame.growth, coverage};
}

Placement place_on(const Frame& frame, double angle, Vec2 offset, int x, int y) {
  return {angle,
          {(offset.x + x) * frame.cell.x + frame.origin.x,
           (offset.y + y) * frame.cell.y + frame.origin.y}};
}

Packing make_packing(const Frame& frame, Wrap wrap, double scale, double area,
                     std::vector<Placement> placements, std::int64_t covered, int pages) {
  Packing packing;
  packing.width = frame.texture_width;
  packing.height = frame.texture_height;
  packing.wrap = wrap;
  packing.scale = scale;
  packing.placements = std::move(placements);
  packing.pages = pages;
  packing.efficiency = scale * scale * area / (pages * frame.texels());
  packing.grid_width = frame.width;
  packing.grid_height = frame.height;
  packing.raster_efficiency =
      static_cast<double>(covered) / (pages * double(frame.width) * frame.height);
  return packing;
}

}  // namespace wrapatlas
