// PNG by libspng, JPEG by libjpeg-turbo: the places that know them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "wrapatlas/result.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {

/// How pixels lie in memory: rows from the top, 1 to 4 channels, 8 or 16 bits (in the machine's
/// order of bytes).
struct PixelFormat {
  int width = 0, height = 0, channels = 3, bits = 8;
};

/// The bytes of a PNG file. Error: output (no pixels, or not as many as the format says).
Result<std::string> encode_pixels(const PixelFormat& format, std::span<const std::uint8_t> pixels);

/// `name` is for errors: input. Palettes become colours; grey pictures stay grey.
Result<Texture> decode_png(std::string_view bytes, const std::string& name);
Result<Texture> decode_jpeg(std::string_view bytes, const std::string& name);

/// Pictures may have no more than that: 65536 pixels a side and 2^28 in all.
inline constexpr std::uint32_t kMostPixelsAcross = 65536;
inline constexpr std::uint64_t kMostPixels = 1ULL << 28U;

/// Before memory is asked for: may a file of `bytes` hold a picture of this size, which takes
/// `least_bytes` however well it is compressed? Error: input.
Status check_picture_size(const std::string& name, std::uint64_t width, std::uint64_t height,
                          std::uint64_t least_bytes, std::size_t bytes);

}  // namespace wrapatlas
