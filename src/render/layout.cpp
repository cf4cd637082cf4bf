#include "render/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/digits.h"

namespace wrapatlas {
namespace {

constexpr int kMinSize = 16, kMaxSize = 8192;
constexpr double kFarthest = 1e6;  // pixels; beyond it a place is no place
constexpr int kMaxTiles = 16;      // along an axis, for a chart that winds around

int drawn_size(const PictureOptions& options) {
  return std::clamp(options.size, kMinSize, kMaxSize);
}

/// How many whole tiles to go back so that `low` lies in the first; rounding errors do not count.
double tiles_before(double low, double tile) { return std::floor(low / tile + 1e-9); }

void tile_range(double low, double high, int tile, bool wraps, int& first, int& last) {
  first = last = 0;
  if (!wraps) return;
  first = std::max(-kMaxTiles, static_cast<int>(tiles_before(low, tile)));
  last = std::min(kMaxTiles, static_cast<int>(std::ceil(high / tile - 1e-9)) - 1);
}

}  // namespace

TileFrame tile_frame(const Packing& packing, const PictureOptions& options) {
  TileFrame frame;
  if (packing.width <= 0 || packing.height <= 0) return frame;
  const double scale = double{1} * drawn_size(options) / std::max(packing.width, packing.height);
  frame.width = std::max(1, static_cast<int>(std::lround(packing.width * scale)));
  frame.height = std::max(1, static_cast<int>(std::lround(packing.height * scale)));
  frame.x_scale = double{1} * frame.width / packing.width;
  frame.y_scale = double{1} * frame.height / packing.height;
  if (options.tile2x2 && wraps_u(packing.wrap)) frame.columns = 2;
  if (options.tile2x2 && wraps_v(packing.wrap)) frame.rows = 2;
  frame.primary_row = options.v_points_down ? 0 : frame.rows - 1;
  return frame;
}

PageGrid page_grid(const Packing& packing, const PictureOptions& options) {
  constexpr int kLongest = 16384, kSmallestGap = 4, kPageInGaps = 64;
  PageGrid grid;
  grid.options = options;
  grid.options.size = drawn_size(options);
  const int columns = std::min(packing.pages, kPageColumns);
  grid.rows = page_tile(std::max(packing.pages, 1) - 1).row + 1;
  const auto lay_out = [&] {
    const TileFrame frame = tile_frame(packing, grid.options);
    grid.page_width = frame.columns * frame.width;
    grid.page_height = frame.rows * frame.height;
    grid.gap = packing.pages > 1 ? std::max(kSmallestGap, grid.options.size / kPageInGaps) : 0;
    grid.width = columns * (grid.page_width + grid.gap) + grid.gap;
    grid.height = grid.rows * (grid.page_height + grid.gap) + grid.gap;
  };
  lay_out();
  while (packing.pages > 1 && std::max(grid.width, grid.height) > kLongest &&
         grid.options.size > kMinSize) {
    const double shrink = double{1} * kLongest / std::max(grid.width, grid.height);
    grid.options.size = std::max(kMinSize, static_cast<int>(grid.options.size * shrink) - 1);
    lay_out();
  }
  return grid;
}

std::optional<PlacedChart> place_chart(const Chart& chart, const Similarity& to_texels,
                                       const Packing& packing, const TileFrame& frame,
                                       bool v_points_down) {
  Box2 texels;
  for (const OutlineEdge& edge : chart.outline) {
    texels.add(to_texels.apply(chart.points[edge.from]));
    texels.add(to_texels.apply(chart.points[edge.to]));
  }
  if (texels.empty()) return std::nullopt;
  Vec2 origin;
  if (wraps_u(packing.wrap)) {
    origin.x = packing.width * tiles_before(texels.min.x, packing.width);
  }
  if (wraps_v(packing.wrap)) {
    origin.y = packing.height * tiles_before(texels.min.y, packing.height);
  }
  const auto to_pixels = [&](std::uint32_t point) {
    const Vec2 texel = to_texels.apply(chart.points[point]) - origin;
    const double y = v_points_down ? texel.y : packing.height - texel.y;
    return Vec2{frame.x_scale * texel.x, frame.y_scale * y};
  };
  PlacedChart placed;
  placed.outline.reserve(chart.outline.size());
  bool usable = true;
  for (const OutlineEdge& edge : chart.outline) {
    placed.outline.push_back({to_pixels(edge.from), to_pixels(edge.to), edge.winding});
    for (const Vec2 p : {placed.outline.back().from, placed.outline.back().to}) {
      usable = usable && std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest;
      placed.box.add(p);
    }
  }
  if (!usable) return std::nullopt;
  for (const std::uint32_t index : chart.against_grain) {
    std::array<Segment, 3> loop;
    for (std::size_t i = 0; i < 3; ++i) {
      loop[i] = {to_pixels(chart.triangles[index][i]),
                 to_pixels(chart.triangles[index][(i + 1) % 3]), 1};
      placed.box.add(loop[i].from);
    }
    placed.against_grain.push_back(loop);
  }
  return placed;
}

std::vector<TileShift> tile_shifts(const Box2& box, Wrap wrap, const TileFrame& frame) {
  int left = 0, right = 0, top = 0, bottom = 0;
  tile_range(box.min.x, box.max.x, frame.width, wraps_u(wrap), left, right);
  tile_range(box.min.y, box.max.y, frame.height, wraps_v(wrap), top, bottom);
  std::vector<TileShift> shifts{{0, 0}};
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      if (x != 0 || y != 0) shifts.push_back({-x, -y});
    }
  }
  return shifts;
}

PlacedChart shifted(const PlacedChart& chart, TileShift shift, const TileFrame& frame) {
  PlacedChart moved = chart;
  const Vec2 by{double{1} * shift.x * frame.width, double{1} * shift.y * frame.height};
  const auto move = [&](Segment& segment) {
    segment.from = segment.from + by;
    segment.to = segment.to + by;
  };
  for (Segment& segment : moved.outline) move(segment);
  for (auto& loop : moved.against_grain) std::for_each(loop.begin(), loop.end(), move);
  moved.box = {chart.box.min + by, chart.box.max + by};
  return moved;
}

PixelBox visible_window(const PlacedChart& chart, const TileFrame& frame) {
  const auto pixel = [](double position, int end) {
    return static_cast<int>(std::clamp(position, 0.0, static_cast<double>(end)));
  };
  return {pixel(std::floor(chart.box.min.x), frame.width),
          pixel(std::floor(chart.box.min.y), frame.height),
          pixel(std::ceil(chart.box.max.x), frame.width),
          pixel(std::ceil(chart.box.max.y), frame.height)};
}

void cover_chart(const PlacedChart& chart, CoverageMask& mask) {
  mask.fill(chart.outline);
  for (const auto& loop : chart.against_grain) mask.fill(loop);
}

double outline_width(const PlacedChart& chart, const PictureOptions& options) {
  double area = 0, perimeter = 0;
  for (const Segment& edge : chart.outline) {
    area += edge.winding * cross(edge.from, edge.to) / 2;
    perimeter += length(edge.to - edge.from);
  }
  if (perimeter == 0) return 0.25;
  const double thickness = 2 * std::abs(area) / perimeter;  // a strip's, for a strip
  return std::clamp(0.13 * thickness, 0.25, std::max(1.0, drawn_size(options) / 700.0));
}

Spot widest_spot(const CoverageMask& mask) {
  const PixelBox& window = mask.window();
  // Chamfer distance with weights 3 and 4 (Borgefors 1986) on a frame one pixel wider all around.
  const int width = window.width() + 2, height = window.height() + 2;
  std::vector<int> distance(static_cast<std::size_t>(width) * height, 0);
  Vec2 sum;
  double count = 0;
  const auto at = [&](int x, int y) -> int& {
    return distance[static_cast<std::size_t>(y) * width + x];
  };
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      if (mask.bits(window.left + x - 1, window.top + y - 1) != ~std::uint64_t{0}) continue;
      at(x, y) = std::min(
          {at(x - 1, y) + 3, at(x, y - 1) + 3, at(x - 1, y - 1) + 4, at(x + 1, y - 1) + 4});
      sum = sum + Vec2{double{1} * x, double{1} * y};
      ++count;
    }
  }
  int widest = 0;
  for (int y = height - 2; y > 0; --y) {
    for (int x = width - 2; x > 0; --x) {
      at(x, y) = std::min({at(x, y), at(x + 1, y) + 3, at(x, y + 1) + 3, at(x + 1, y + 1) + 4,
                           at(x - 1, y + 1) + 4});
      widest = std::max(widest, at(x, y));
    }
  }
  Spot spot;
  if (widest == 0) return spot;
  // A strip is equally wide all along: take the place nearest to the middle of the whole.
  const Vec2 middle = (1 / count) * sum;
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      if (at(x, y) + 3 < widest) continue;
      const Vec2 here{double{1} * x, double{1} * y};
      const double away = length(here - middle);
      if (away >= nearest) continue;
      nearest = away;
      spot = {here + Vec2{window.left - 0.5, window.top - 0.5}, at(x, y) / 3.0};
    }
  }
  return spot;
}

double number_height(const Spot& spot, std::size_t digits, const PictureOptions& options) {
  constexpr double kSmallestReadable = 7;
  const double diagonal = std::hypot(1.0, number_width(digits));
  const double height = std::min(1.5 * spot.radius / diagonal, drawn_size(options) / 36.0);
  return height < kSmallestReadable ? 0 : height;
}

}  // namespace wrapatlas
