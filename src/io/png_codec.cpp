#include <spng.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "io/image_codecs.h"

namespace wrapatlas {
namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

Error encode_error(std::string what) {
  return {ErrorKind::output, "", std::move(what), "draw it at another size"};
}

Error decode_error(const std::string& name, int failure) {
  return {ErrorKind::input, name, std::string("not a whole PNG picture: ") + spng_strerror(failure),
          "export it again"};
}

std::uint8_t color_type_of(int channels) {
  constexpr std::uint8_t kTypes[] = {SPNG_COLOR_TYPE_GRAYSCALE, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA,
                                     SPNG_COLOR_TYPE_TRUECOLOR, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA};
  return kTypes[channels - 1];
}

/// Whether grey pixels have alpha, by a colour that is transparent or a channel.
int channels_of(const spng_ihdr& header, bool has_transparent) {
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE:
      return has_transparent ? 2 : 1;
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return 2;
    case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
      return 4;
    default:
      return has_transparent ? 4 : 3;
  }
}

/// In the file.
std::uint64_t bits_per_pixel(const spng_ihdr& header) {
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return 2U * header.bit_depth;
    case SPNG_COLOR_TYPE_TRUECOLOR:
      return 3U * header.bit_depth;
    case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
      return 4U * header.bit_depth;
    default:
      return header.bit_depth;
  }
}

/// From RGBA of 8 or 16 bits, of which the file may have had fewer channels.
template <typename T>
Texture texture_of(const std::vector<std::uint8_t>& rgba, int width, int height, int channels) {
  Texture texture(width, height, channels);
  const float most = sizeof(T) == 1 ? 255.0F : 65535.0F;
  for (std::size_t i = 0; i < texture.texel_count(); ++i) {
    T pixel[4];
    std::memcpy(pixel, rgba.data() + i * sizeof(pixel), sizeof(pixel));
    float* value = texture.values.data() + i * static_cast<std::size_t>(channels);
    for (int c = 0; c < channels; ++c) {
      const int from = channels == 2 && c == 1 ? 3 : c;
      value[c] = float(pixel[from]) / most;
    }
  }
  return texture;
}

}  // namespace

Result<std::string> encode_pixels(const PixelFormat& format, std::span<const std::uint8_t> pixels) {
  const std::size_t expected = std::size_t{1} * std::max(0, format.width) *
                               std::max(0, format.height) * format.channels * format.bits / 8;
  if (expected == 0 || pixels.size() != expected) {
    return encode_error("the image has no pixels, or not as many as its size says");
  }
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
  if (!context) return encode_error("out of memory");
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(format.width);
  header.height = static_cast<std::uint32_t>(format.height);
  header.color_type = color_type_of(format.channels);
  header.bit_depth = static_cast<std::uint8_t>(format.bits);
  int failure = spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  if (failure == 0) failure = spng_set_ihdr(context.get(), &header);
  if (failure == 0) {
    failure = spng_encode_image(context.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG,
                                SPNG_ENCODE_FINALIZE);
  }
  std::size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(
      failure == 0 ? spng_get_png_buffer(context.get(), &size, &failure) : nullptr, &std::free);
  if (!bytes) return encode_error(std::string("cannot encode PNG: ") + spng_strerror(failure));
  return std::string(static_cast<const char*>(bytes.get()), size);
}

Result<Texture> decode_png(std::string_view bytes, const std::string& name) {
  const Context context(spng_ctx_new(0), &spng_ctx_free);
  if (!context) return Error{ErrorKind::input, name, "out of memory", "use a smaller picture"};
  constexpr std::size_t kMostChunk = std::size_t{1} << 26U;
  spng_set_chunk_limits(context.get(), kMostChunk, kMostChunk);
  int failure = spng_set_png_buffer(context.get(), bytes.data(), bytes.size());
  spng_ihdr header{};
  if (failure == 0) failure = spng_get_ihdr(context.get(), &header);
  if (failure != 0) return decode_error(name, failure);
  // Deflate makes no more than 1032 bytes of one.
  const std::uint64_t raw =
      std::uint64_t{1} * header.width * header.height * bits_per_pixel(header) / 8;
  if (const Status ok =
          check_picture_size(name, header.width, header.height, raw / 1032, bytes.size());
      !ok) {
    return ok.error();
  }
  spng_trns transparent{};
  const bool has_transparent = spng_get_trns(context.get(), &transparent) == 0;
  const bool wide = header.bit_depth == 16;
  const int format = wide ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
  std::size_t size = 0;
  failure = spng_decoded_image_size(context.get(), format, &size);
  if (failure != 0) return decode_error(name, failure);
  std::vector<std::uint8_t> rgba(size);
  failure = spng_decode_image(context.get(), rgba.data(), size, format, SPNG_DECODE_TRNS);
  if (failure != 0) return decode_error(name, failure);
  const int channels = channels_of(header, has_transparent);
  const auto width = static_cast<int>(header.width), height = static_cast<int>(header.height);
  return wide ? texture_of<std::uint16_t>(rgba, width, height, channels)
              : texture_of<std::uint8_t>(rgba, width, height, channels);
}

}  // namespace wrapatlas
