#include <algorithm>
#include <cctype>

#include "io/file.h"
#include "io/image_codecs.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {

Result<std::string> encode_png(const Image& image) {
  return encode_pixels({image.width, image.height, 3, 8}, image.rgb);
}

Status save_png(const std::filesystem::path& path, const Image& image) {
  const auto bytes = encode_png(image);
  if (bytes) return write_file(path, *bytes);
  Error error = bytes.error();
  error.where = path.string();
  return error;
}

namespace {

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

Status check_picture_path(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".svg" || ending == ".png") return Done{};
  return Error{ErrorKind::usage, path.string(), "pictures are PNG or SVG",
               "end the name in .png or .svg"};
}

Status save_atlas_picture(const std::filesystem::path& path, std::span<const Chart> charts,
                          const Packing& packing, const PictureOptions& options) {
  if (Status known = check_picture_path(path); !known) return known;
  if (ending_of(path) == ".svg") return write_file(path, draw_atlas_svg(charts, packing, options));
  return save_png(path, draw_atlas(charts, packing, options));
}

}  // namespace wrapatlas
