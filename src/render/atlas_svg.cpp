#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "render/colors.h"
#include "render/layout.h"
#include "render/outline_path.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {
namespace {

using Out = std::back_insert_iterator<std::string>;

struct Label {
  Spot spot;
  double height = 0;
};

/// Where the number of a chart goes: in the widest of its parts.
Label place_label(const PlacedChart& chart, std::size_t digits, Wrap wrap, const TileFrame& frame,
                  const PictureOptions& options, CoverageMask& mask) {
  Label label;
  for (const TileShift shift : tile_shifts(chart.box, wrap, frame)) {
    const PlacedChart part = shift.crossed() ? shifted(chart, shift, frame) : chart;
    const PixelBox window = visible_window(part, frame);
    if (window.empty()) continue;
    mask.reset(window);
    cover_chart(part, mask);
    const Spot spot = widest_spot(mask);
    if (spot.radius > label.spot.radius) label.spot = spot;
  }
  label.height = number_height(label.spot, digits, options);
  return label;
}

/// The chart once, as a definition without colour, and one reference per part that shows.
void write_chart(const PlacedChart& chart, std::size_t number, Wrap wrap, const TileFrame& frame,
                 const PictureOptions& options, const std::string& suffix, Out out) {
  const ChartColors colors = chart_colors(number);
  fmt::format_to(out, "<defs><g id=\"c{}\"><path d=\"{}\"/>", number, outline_path(chart.outline));
  for (const auto& loop : chart.against_grain) {
    fmt::format_to(out, "<path d=\"{}\"/>", outline_path(loop));
  }
  fmt::format_to(out, "</g></defs>\n");
  const std::string line = options.outlines
                               ? fmt::format(" stroke=\"{}\" stroke-width=\"{:.2f}\"",
                                             css(colors.line), outline_width(chart, options))
                               : "";
  for (const TileShift shift : tile_shifts(chart.box, wrap, frame)) {
    std::string place;
    if (shift.x != 0) place += fmt::format(" x=\"{}\"", shift.x * frame.width);
    if (shift.y != 0) place += fmt::format(" y=\"{}\"", shift.y * frame.height);
    fmt::format_to(out, "<use href=\"#c{}\"{} fill=\"{}\"{}/>\n", number, place,
                   css(shift.crossed() ? colors.hatch_dark : colors.fill), line);
    if (shift.crossed()) {
      fmt::format_to(out, "<use href=\"#c{}\"{} fill=\"url(#hatch{})\"/>\n", number, place, suffix);
    }
  }
}

void write_frame(const TileFrame& frame, int column, int row, double width, Rgb color, bool dashed,
                 Out out) {
  fmt::format_to(out,
                 "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"none\" "
                 "stroke=\"{}\" stroke-width=\"{:.2f}\"{}/>\n",
                 column * frame.width + width / 2, row * frame.height + width / 2,
                 frame.width - width, frame.height - width, css(color), width,
                 dashed ? fmt::format(" stroke-dasharray=\"{0:.2f}\"", 6 * width) : "");
}

void write_frames(const TileFrame& frame, Wrap wrap, Out out) {
  const double thin = std::max(1.0, std::max(frame.width, frame.height) / 768.0);
  const bool repeated = frame.columns * frame.rows > 1;
  for (int row = 0; row < frame.rows && repeated; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      write_frame(frame, column, row, thin, kFaintFrame, true, out);
    }
  }
  write_frame(frame, 0, frame.primary_row, repeated ? 3 * thin : thin, kFrame,
              wrap == Wrap::uv && !repeated, out);
}

/// A whole document; `place` are attributes that put it into another one, `suffix` makes its names
/// unique there.
std::string draw_page_svg(std::span<const Chart> charts, const Packing& packing, int page,
                          const PictureOptions& options, const std::string& place,
                          const std::string& suffix) {
  const TileFrame frame = tile_frame(packing, options);
  const int width = frame.columns * frame.width, height = frame.rows * frame.height;
  const double period = std::max(6.0, std::max(frame.width, frame.height) / 96.0) / std::sqrt(2.0);
  std::string svg, numbers;
  const Out out(svg), number_out(numbers);
  fmt::format_to(out,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\"{7} width=\"{0}\" height=\"{1}\" "
                 "viewBox=\"0 0 {0} {1}\">\n<defs><clipPath id=\"tile{8}\"><rect width=\"{2}\" "
                 "height=\"{3}\"/></clipPath><pattern id=\"hatch{8}\" width=\"{4:.2f}\" "
                 "height=\"{4:.2f}\" patternUnits=\"userSpaceOnUse\" "
                 "patternTransform=\"rotate(45)\"><rect width=\"{5:.2f}\" height=\"{4:.2f}\" "
                 "fill=\"#fff\" fill-opacity=\"0.5\"/></pattern></defs>\n"
                 "<rect width=\"100%\" height=\"100%\" fill=\"{6}\"/>\n"
                 "<g id=\"atlas{8}\" clip-path=\"url(#tile{8})\" stroke-linejoin=\"round\">\n",
                 width, height, frame.width, frame.height, period, period / 2, css(kGround), place,
                 suffix);
  CoverageMask mask;
  for (std::size_t i = 0; i < std::min(charts.size(), packing.placements.size()); ++i) {
    if (packing.placements[i].page != page) continue;
    const auto placed =
        place_chart(charts[i], packing.transform(i), packing, frame, options.v_points_down);
    if (!placed) continue;
    write_chart(*placed, i, packing.wrap, frame, options, suffix, out);
    if (!options.ids) continue;
    const std::string digits = fmt::format("{}", i);
    const Label label = place_label(*placed, digits.size(), packing.wrap, frame, options, mask);
    if (label.height == 0) continue;
    // Digits are about 0.72 of the font's size high.
    fmt::format_to(number_out,
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\" fill=\"{}\">{}</text>\n",
                   label.spot.centre.x, label.spot.centre.y + label.height / 2, label.height / 0.72,
                   css(chart_colors(i).text), digits);
  }
  fmt::format_to(out,
                 "<g font-family=\"Helvetica,Arial,sans-serif\" font-weight=\"bold\" "
                 "text-anchor=\"middle\">\n{}</g>\n</g>\n",
                 numbers);
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      if (row == 0 && column == 0) continue;
      fmt::format_to(out, "<use href=\"#atlas{}\" x=\"{}\" y=\"{}\"/>\n", suffix,
                     column * frame.width, row * frame.height);
    }
  }
  write_frames(frame, packing.wrap, out);
  svg += "</svg>\n";
  return svg;
}

}  // namespace

std::string draw_atlas_svg(std::span<const Chart> charts, const Packing& packing,
                           const PictureOptions& options) {
  if (packing.pages <= 1) return draw_page_svg(charts, packing, 0, options, "", "");
  const PageGrid grid = page_grid(packing, options);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\">\n<rect width=\"100%\" height=\"100%\" fill=\"{2}\"/>\n",
      grid.width, grid.height, css(kGround));
  for (int page = 0; page < packing.pages; ++page) {
    const std::string place = fmt::format(" x=\"{}\" y=\"{}\"", grid.left(page), grid.top(page));
    svg += draw_page_svg(charts, packing, page, grid.options, place, fmt::format("-{}", page));
  }
  return svg + "</svg>\n";
}

}  // namespace wrapatlas
