// Pictures of an atlas, PNG and SVG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

struct PictureOptions {
  int size = 1024;  ///< pixels along the longer side of one atlas tile; 16 to 8192; less where
                    ///< pages would make the picture longer than 16384
  bool ids = true;  ///< chart numbers
  bool outlines = true;
  bool tile2x2 = false;  ///< draw the atlas twice along each axis that wraps
  bool v_points_down = false;
};

/// 8-bit RGB, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Charts filled with distinct colours, parts that crossed the border hatched, on a dark ground.
/// The image is exactly the tile (or tiles); several pages lie in it as in UV space, ten to a row,
/// the first at the lower left. Sides that wrap are framed by a dashed line, others by
/// a whole one. Precondition: one placement per chart. O(pixels + outline edges * their height).
Image draw_atlas(std::span<const Chart> charts, const Packing& packing,
                 const PictureOptions& options = {});

/// The same as an SVG document, one unit a pixel of draw_atlas.
std::string draw_atlas_svg(std::span<const Chart> charts, const Packing& packing,
                           const PictureOptions& options = {});

/// Is the ending one of a picture? Error: usage.
Status check_picture_path(const std::filesystem::path& path);

/// Draws to a file, PNG or SVG by its ending. Written to a temporary file, then renamed.
/// Errors: usage (another ending), output.
Status save_atlas_picture(const std::filesystem::path& path, std::span<const Chart> charts,
                          const Packing& packing, const PictureOptions& options = {});

/// Images in a row, their middles on one line, `gap` pixels of ground between and around them.
Image side_by_side(std::span<const Image> images, int gap);

/// The bytes of a PNG file. Error: output (an image without pixels).
Result<std::string> encode_png(const Image& image);

/// Errors: output (an image without pixels, or a file that cannot be written).
Status save_png(const std::filesystem::path& path, const Image& image);

}  // namespace wrapatlas
