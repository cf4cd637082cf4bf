// Textures: values on a grid of texels that repeats, sampled as graphics cards do it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

inline constexpr int kMostChannels = 4;

/// Rows from the top, as image files have them; the centre of texel (x, y) is at u = (x + 0.5) /
/// width, v = (y + 0.5) / height *down* from the top. In meshes whose v points up that is 1 - v.
struct Texture {
  int width = 0, height = 0, channels = 3;
  std::vector<float> values;  ///< width * height * channels; what files hold as integers: 0 to 1

  Texture() = default;
  /// All values 0. Preconditions: sides from 1 to 65536, channels from 1 to kMostChannels.
  Texture(int w, int h, int c)
      : width(w), height(h), channels(c), values(std::size_t{1} * w * h * c, 0.0F) {}

  [[nodiscard]] std::size_t texel_count() const { return std::size_t{1} * width * height; }
  [[nodiscard]] float* at(int x, int y) {
    return values.data() + (std::size_t{1} * y * width + x) * channels;
  }
  [[nodiscard]] const float* at(int x, int y) const {
    return values.data() + (std::size_t{1} * y * width + x) * channels;
  }
};

/// The value at a place; channels that the texture does not have are 0.
using TextureValue = std::array<float, kMostChannels>;

/// Which texels a map means something on: one entry per texel, rows from the top.
using TexelMask = std::vector<std::uint8_t>;

/// Bilinear, between the centres of four texels. Axes of `wrap` repeat (REPEAT), the others end
/// (CLAMP_TO_EDGE). `uv`: v down from the top; any finite value. Thread safe. O(1).
TextureValue sample_bilinear(const Texture& texture, Vec2 uv, Wrap wrap);

enum class MipFilter {
  mean,     ///< of values as they are: data, and colours in linear light
  normals,  ///< of directions 2c - 1, made unit again
};

/// A texture and its halves, down to one texel: level k + 1 has half the columns and rows of level
/// k, rounded down, but at least 1. A texel is the mean of those it covers, by area.
struct MipMaps {
  std::vector<Texture> levels;  ///< level 0 is the texture
};
MipMaps make_mip_maps(Texture texture, MipFilter filter);

/// Trilinear: between the two levels next to `level` (0: the texture itself), bilinear in each.
TextureValue sample_trilinear(const MipMaps& maps, Vec2 uv, double level, Wrap wrap);

/// Gives every texel outside the mask the value of the one inside that is nearest (Euclidean, from
/// centre to centre; over the border on axes that wrap; which of equals is not said, but always the
/// same). With none inside all stays as it is. `threads` here and below: 0: as many as there are;
/// the result does not depend on it. O(texels).
void dilate(Texture& texture, const TexelMask& inside, Wrap wrap, int threads = 0);

/// sRGB and linear light, both in [0, 1] (IEC 61966-2-1); outside it they go on alike.
float srgb_to_linear(float value);
float linear_to_srgb(float value);

/// The first three channels; a fourth is alpha, which is linear always.
void srgb_to_linear(Texture& texture, int threads = 0);
void linear_to_srgb(Texture& texture, int threads = 0);

/// A PNG or JPEG file's pixels; grey ones have one channel, or two with alpha. 16-bit values keep
/// their precision. No colour profile is applied. What the file's name ends in does not matter.
/// Error: input (not such a file, cut off, more than 65536 pixels a side or 2^28 in all).
Result<Texture> load_texture(const std::filesystem::path& path);
/// The same of a file's bytes; `name` is for errors.
Result<Texture> decode_texture(std::string_view bytes, const std::string& name);

/// Values are cut to [0, 1] and rounded; what is no number is 0. `bits`: 8 or 16. Errors: usage
/// (bits, or an ending other than .png), output.
Status save_texture(const std::filesystem::path& path, const Texture& texture, int bits = 8);
/// The bytes of the PNG file.
Result<std::string> encode_texture(const Texture& texture, int bits = 8);

/// How alike two pictures of the same size are.
struct Likeness {
  double psnr = 0;  ///< decibels, of values in [0, 1] over the pixels looked at; infinite: equal
  double ssim = 0;  ///< Wang et al. 2004: 11 x 11 Gaussian window of sigma 1.5, on luma; 1: equal
  std::size_t pixels = 0;  ///< looked at
};
/// Over the pixels of the mask (all, if it is empty). Preconditions: equal sizes and channels, at
/// least one pixel. O(pixels).
Likeness compare(const Texture& a, const Texture& b, std::span<const std::uint8_t> mask = {},
                 int threads = 0);

}  // namespace wrapatlas
