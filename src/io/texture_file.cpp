// Textures in files: PNG in and out, JPEG in.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/file.h"
#include "io/image_codecs.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {

Status check_picture_size(const std::string& name, std::uint64_t width, std::uint64_t height,
                          std::uint64_t least_bytes, std::size_t bytes) {
  const std::string size = fmt::format("{} x {} pixels", width, height);
  if (width > kMostPixelsAcross || height > kMostPixelsAcross || width * height > kMostPixels) {
    return Error{ErrorKind::input, name, size + " are too many",
                 "use a picture of at most 65536 a side and 2^28 in all"};
  }
  if (least_bytes > bytes) {
    return Error{ErrorKind::input, name,
                 fmt::format("cut off: {} do not fit into {} bytes", size, bytes),
                 "export it again"};
  }
  return Done{};
}

Result<Texture> decode_texture(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kPng("\x89PNG\r\n\x1a\n", 8), kJpeg("\xff\xd8\xff", 3);
  if (bytes.starts_with(kPng)) return decode_png(bytes, name);
  if (bytes.starts_with(kJpeg)) return decode_jpeg(bytes, name);
  return Error{ErrorKind::input, name, "neither a PNG nor a JPEG picture",
               "convert it to one of them"};
}

Result<Texture> load_texture(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return decode_texture(*bytes, path.string());
}

Result<std::string> encode_texture(const Texture& texture, int bits) {
  if (bits != 8 && bits != 16) {
    return Error{ErrorKind::usage, "bits", "neither 8 nor 16", "choose one of them"};
  }
  const double most = bits == 8 ? 255 : 65535;
  std::vector<std::uint8_t> pixels(texture.values.size() * static_cast<std::size_t>(bits) / 8);
  for (std::size_t i = 0; i < texture.values.size(); ++i) {
    const auto value = double(texture.values[i]);
    const double within = value > 0 ? std::min(value, 1.0) : 0;  // what is no number is 0
    const auto whole = static_cast<std::uint16_t>(std::lround(most * within));
    if (bits == 8) {
      pixels[i] = static_cast<std::uint8_t>(whole);
    } else {
      std::memcpy(pixels.data() + 2 * i, &whole, 2);
    }
  }
  return encode_pixels({texture.width, texture.height, texture.channels, bits}, pixels);
}

Status save_texture(const std::filesystem::path& path, const Texture& texture, int bits) {
  if (path.extension() != ".png") {
    return Error{ErrorKind::usage, path.string(), "textures are written as PNG",
                 "end the name in .png"};
  }
  const auto bytes = encode_texture(texture, bits);
  if (bytes) return write_file(path, *bytes);
  Error error = bytes.error();
  error.where = path.string();
  return error;
}

}  // namespace wrapatlas
