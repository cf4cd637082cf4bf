// Pictures of an atlas, PNG and SVG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

struct PictureOptions {
  int size = 1024;  ///< pixels along the longer side of one atlas tile
  bool ids = true;  ///< chart numbers
  bool outlines = true;
  bool tile2x2 = false;  ///< draw the atlas four times, to show how it wraps
  bool v_points_down = false;
};

/// 8-bit RGB, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Charts filled with distinct colours, parts that crossed the border hatched, on a dark ground.
Image draw_atlas(std::span<const Chart> charts, const Packing& packing,
                 const PictureOptions& options = {});

/// The same as an SVG document.
std::string draw_atlas_svg(std::span<const Chart> charts, const Packing& packing,
                           const PictureOptions& options = {});

/// Draws to a file, PNG or SVG by its ending. Written to a temporary file, then renamed.
Status save_atlas_picture(const std::filesystem::path& path, std::span<const Chart> charts,
                          const Packing& packing, const PictureOptions& options = {});

Status save_png(const std::filesystem::path& path, const Image& image);

}  // namespace wrapatlas
