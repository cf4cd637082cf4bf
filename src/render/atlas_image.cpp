#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/colors.h"
#include "render/digits.h"
#include "render/layout.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {
namespace {

Image blank_image(int width, int height) {
  Image image{width, height, {}};
  image.rgb.resize(std::size_t{3} * width * height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = kGround[i % 3];
  return image;
}

Rgb pixel(const Image& image, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

void set_pixel(Image& image, int x, int y, Rgb color) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * image.width + x);
  std::copy(color.begin(), color.end(), image.rgb.begin() + static_cast<std::ptrdiff_t>(at));
}

/// How much of a pixel lies in the light stripes of the hatching.
double light_stripe(int x, int y, double period) {
  const double phase = (x + y) / period;
  const double from_middle = std::abs(phase - std::floor(phase) - 0.5);
  return std::clamp((0.25 - from_middle) * period / std::sqrt(2.0) + 0.5, 0.0, 1.0);
}

/// Paints charts one after the other; keeps the masks' memory.
class Painter {
 public:
  Painter(Image& image, const TileFrame& frame, const PictureOptions& options)
      : image_(image), frame_(frame), options_(options) {}

  void paint(const PlacedChart& chart, std::size_t number, Wrap wrap) {
    const ChartColors colors = chart_colors(number);
    Spot widest;
    for (const TileShift shift : tile_shifts(chart.box, wrap, frame_)) {
      const PlacedChart part = shift.crossed() ? shifted(chart, shift, frame_) : chart;
      const PixelBox window = visible_window(part, frame_);
      if (window.empty()) continue;
      paint_part(part, window, colors, shift.crossed());
      if (!options_.ids) continue;
      const Spot spot = widest_spot(inside_);
      if (spot.radius > widest.radius) widest = spot;
    }
    if (options_.ids) paint_number(number, widest, colors.text);
  }

 private:
  void paint_part(const PlacedChart& part, const PixelBox& window, const ChartColors& colors,
                  bool crossed) {
    inside_.reset(window);
    cover_chart(part, inside_);
    lines_.reset(window);
    if (options_.outlines) {
      // Twice the width, as the half outside the chart is left out.
      lines_.fill(stroke(part.outline, 2 * outline_width(part, options_), false));
    }
    const double period = std::max(6.0, std::max(frame_.width, frame_.height) / 96.0);
    for (int y = window.top; y < window.bottom; ++y) {
      for (int x = window.left; x < window.right; ++x) {
        const std::uint64_t inside = inside_.bits(x, y);
        if (inside == 0) continue;
        const double share = double{1} * std::popcount(inside) / CoverageMask::kSamples;
        const double line =
            double{1} * std::popcount(inside & lines_.bits(x, y)) / std::popcount(inside);
        const Rgb fill =
            crossed ? mix(colors.hatch_dark, colors.hatch_light, light_stripe(x, y, period))
                    : colors.fill;
        set_pixel(image_, x, y, mix(pixel(image_, x, y), mix(fill, colors.line, line), share));
      }
    }
  }

  void paint_number(std::size_t number, const Spot& spot, Rgb color) {
    const std::string digits = fmt::format("{}", number);
    const double height = number_height(spot, digits.size(), options_);
    if (height == 0) return;
    const int reach = static_cast<int>(std::ceil(height * (1 + number_width(digits.size()))));
    const int x = static_cast<int>(spot.centre.x), y = static_cast<int>(spot.centre.y);
    const PixelBox window{std::max(0, x - reach), std::max(0, y - reach),
                          std::min(frame_.width, x + reach), std::min(frame_.height, y + reach)};
    lines_.reset(window);
    lines_.fill(stroke(number_lines(digits, spot.centre, height), 0.165 * height, true));
    for (int row = window.top; row < window.bottom; ++row) {
      for (int column = window.left; column < window.right; ++column) {
        const int covered = std::popcount(lines_.bits(column, row));
        if (covered == 0) continue;
        const double share = double{1} * covered / CoverageMask::kSamples;
        set_pixel(image_, column, row, mix(pixel(image_, column, row), color, share));
      }
    }
  }

  Image& image_;
  const TileFrame& frame_;
  const PictureOptions& options_;
  CoverageMask inside_, lines_;
};

void copy_tile(const Image& tile, Image& image, int left, int top) {
  const std::size_t row_bytes = std::size_t{3} * tile.width;
  for (int y = 0; y < tile.height; ++y) {
    const auto from = tile.rgb.begin() + static_cast<std::ptrdiff_t>(y * row_bytes);
    const std::size_t to = 3 * (static_cast<std::size_t>(top + y) * image.width + left);
    std::copy_n(from, row_bytes, image.rgb.begin() + static_cast<std::ptrdiff_t>(to));
  }
}

/// A frame of `thickness` pixels inside `box`; the sides that wrap are dashed.
void draw_frame(Image& image, const PixelBox& box, int thickness, Rgb color, bool dashed_sides,
                bool dashed_ends) {
  const int dash = 6 * thickness;
  for (int y = box.top; y < box.bottom; ++y) {
    const bool end = y < box.top + thickness || y >= box.bottom - thickness;
    for (int x = box.left; x < box.right; ++x) {
      const bool side = x < box.left + thickness || x >= box.right - thickness;
      const bool on_side = side && (!dashed_sides || (y - box.top) / dash % 2 == 0);
      const bool on_end = end && (!dashed_ends || (x - box.left) / dash % 2 == 0);
      if (on_side || on_end) set_pixel(image, x, y, color);
    }
  }
}

void draw_frames(Image& image, const TileFrame& frame, Wrap wrap) {
  const int thin = std::max(1, std::max(frame.width, frame.height) / 768);
  const bool repeated = frame.columns * frame.rows > 1;
  const auto tile_box = [&](int column, int row) {
    return PixelBox{column * frame.width, row * frame.height, (column + 1) * frame.width,
                    (row + 1) * frame.height};
  };
  for (int row = 0; row < frame.rows && repeated; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      draw_frame(image, tile_box(column, row), thin, kFaintFrame, wraps_u(wrap), wraps_v(wrap));
    }
  }
  draw_frame(image, tile_box(0, frame.primary_row), repeated ? 3 * thin : thin, kFrame,
             wraps_u(wrap) && !repeated, wraps_v(wrap) && !repeated);
}

Image draw_page(std::span<const Chart> charts, const Packing& packing, int page,
                const PictureOptions& options) {
  const TileFrame frame = tile_frame(packing, options);
  Image tile = blank_image(frame.width, frame.height);
  Painter painter(tile, frame, options);
  for (std::size_t i = 0; i < std::min(charts.size(), packing.placements.size()); ++i) {
    if (packing.placements[i].page != page) continue;
    const auto placed =
        place_chart(charts[i], packing.transform(i), packing, frame, options.v_points_down);
    if (placed) painter.paint(*placed, i, packing.wrap);
  }
  if (frame.columns * frame.rows > 1) {
    Image image = blank_image(frame.columns * frame.width, frame.rows * frame.height);
    for (int row = 0; row < frame.rows; ++row) {
      for (int column = 0; column < frame.columns; ++column) {
        copy_tile(tile, image, column * frame.width, row * frame.height);
      }
    }
    tile = std::move(image);
  }
  draw_frames(tile, frame, packing.wrap);
  return tile;
}

}  // namespace

Image draw_atlas(std::span<const Chart> charts, const Packing& packing,
                 const PictureOptions& options) {
  if (packing.pages <= 1) return draw_page(charts, packing, 0, options);
  const PageGrid grid = page_grid(packing, options);
  Image image = blank_image(grid.width, grid.height);
  for (int page = 0; page < packing.pages; ++page) {
    copy_tile(draw_page(charts, packing, page, grid.options), image, grid.left(page),
              grid.top(page));
  }
  return image;
}

Image side_by_side(std::span<const Image> images, int gap) {
  int width = gap, height = 0;
  for (const Image& image : images) {
    width += image.width + gap;
    height = std::max(height, image.height);
  }
  Image row = blank_image(width, height + 2 * gap);
  int left = gap;
  for (const Image& image : images) {
    copy_tile(image, row, left, gap + (height - image.height) / 2);
    left += image.width + gap;
  }
  return row;
}

}  // namespace wrapatlas
