#include <spng.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <memory>

#include "io/file.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {
namespace {

Error png_error(std::string what) {
  return {ErrorKind::output, "", std::move(what), "draw it at another size"};
}

}  // namespace

Result<std::string> encode_png(const Image& image) {
  const std::size_t expected =
      std::size_t{3} * std::max(0, image.width) * std::max(0, image.height);
  if (expected == 0 || image.rgb.size() != expected) {
    return png_error("the image has no pixels, or not as many as its size says");
  }
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(SPNG_CTX_ENCODER),
                                                                    &spng_ctx_free);
  if (!context) return png_error("out of memory");
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(image.width);
  header.height = static_cast<std::uint32_t>(image.height);
  header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
  header.bit_depth = 8;
  int failure = spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  if (failure == 0) failure = spng_set_ihdr(context.get(), &header);
  if (failure == 0) {
    failure = spng_encode_image(context.get(), image.rgb.data(), image.rgb.size(), SPNG_FMT_PNG,
                                SPNG_ENCODE_FINALIZE);
  }
  std::size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(
      failure == 0 ? spng_get_png_buffer(context.get(), &size, &failure) : nullptr, &std::free);
  if (!bytes) return png_error(std::string("cannot encode PNG: ") + spng_strerror(failure));
  return std::string(static_cast<const char*>(bytes.get()), size);
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
