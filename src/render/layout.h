// Where the charts of a packing lie in a picture: shared by PNG and SVG.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "render/coverage.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {

/// The atlas tile in pixels; texels are scaled by x_scale and y_scale (equal but for rounding).
struct TileFrame {
  int width = 0, height = 0;
  double x_scale = 0, y_scale = 0;
  int columns = 1, rows = 1;  ///< how often the tile is drawn: 2 on wrapping axes of tile2x2
  int primary_row = 0;        ///< the row, from the top, of the tile that holds [0,1)

  [[nodiscard]] PixelBox box() const { return {0, 0, width, height}; }
};

TileFrame tile_frame(const Packing& packing, const PictureOptions& options);

/// Where the pages of a packing lie in the picture: as in UV space, ten to a row, rows upwards.
struct PageGrid {
  PictureOptions options;  ///< of one page: its size may be less, to keep the picture small
  int page_width = 0, page_height = 0;
  int width = 0, height = 0;  ///< of the picture, pixels
  int gap = 0;                ///< between and around the pages; 0 for a single one
  int rows = 1;

  [[nodiscard]] int left(int page) const {
    return gap + page_tile(page).column * (page_width + gap);
  }
  [[nodiscard]] int top(int page) const {
    return gap + (rows - 1 - page_tile(page).row) * (page_height + gap);
  }
};

PageGrid page_grid(const Packing& packing, const PictureOptions& options);

/// A chart in pixels, y down, shifted so that the smallest corner of its box lies in the tile (on
/// axes that wrap).
struct PlacedChart {
  std::vector<Segment> outline;
  std::vector<std::array<Segment, 3>> against_grain;
  Box2 box;
};

/// Null if there is nothing to draw: no outline, or places that are not usable numbers.
std::optional<PlacedChart> place_chart(const Chart& chart, const Similarity& to_texels,
                                       const Packing& packing, const TileFrame& frame,
                                       bool v_points_down);

/// A shift, in whole tiles, that brings a piece of a chart into the tile. (0, 0) is the first and
/// shows what lies within the border; the others show what crossed it.
struct TileShift {
  int x = 0, y = 0;
  [[nodiscard]] bool crossed() const { return x != 0 || y != 0; }
};
std::vector<TileShift> tile_shifts(const Box2& box, Wrap wrap, const TileFrame& frame);

PlacedChart shifted(const PlacedChart& chart, TileShift shift, const TileFrame& frame);

/// The pixels of the tile that the chart's box touches.
PixelBox visible_window(const PlacedChart& chart, const TileFrame& frame);

/// Covers the chart itself: its outline by winding, and the triangles against the grain.
void cover_chart(const PlacedChart& chart, CoverageMask& mask);

/// Width of the lines around a chart: thin, and thinner for the small.
double outline_width(const PlacedChart& chart, const PictureOptions& options);

/// The middle of the largest disc that the covered pixels hold, near enough.
struct Spot {
  Vec2 centre;
  double radius = 0;
};
Spot widest_spot(const CoverageMask& mask);

/// Height of a number that fits the disc; 0 where it would be too small to read.
double number_height(const Spot& spot, std::size_t digits, const PictureOptions& options);

}  // namespace wrapatlas
