#include <algorithm>
#include <cmath>

#include "texture/texel_place.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

/// The two texels next to a place along one axis, and how much the second counts.
struct Pair {
  int first, second;
  float share;
};

Pair texels_at(double place, int count, bool wraps) {
  const double texel = texel_place(place, count, wraps);
  const int first = static_cast<int>(std::floor(texel));
  const auto share = static_cast<float>(texel - first);
  if (wraps) return {first % count, (first + 1) % count, share};
  return {std::clamp(first, 0, count - 1), std::clamp(first + 1, 0, count - 1), share};
}

}  // namespace

TextureValue sample_bilinear(const Texture& texture, Vec2 uv, Wrap wrap) {
  const Pair x = texels_at(uv.x, texture.width, wraps_u(wrap));
  const Pair y = texels_at(uv.y, texture.height, wraps_v(wrap));
  const float* a = texture.at(x.first, y.first);
  const float* b = texture.at(x.second, y.first);
  const float* c = texture.at(x.first, y.second);
  const float* d = texture.at(x.second, y.second);
  TextureValue value{};
  for (int i = 0; i < texture.channels; ++i) {
    const float upper = a[i] + x.share * (b[i] - a[i]);
    const float lower = c[i] + x.share * (d[i] - c[i]);
    value[static_cast<std::size_t>(i)] = upper + y.share * (lower - upper);
  }
  return value;
}

TextureValue sample_trilinear(const MipMaps& maps, Vec2 uv, double level, Wrap wrap) {
  const auto last = static_cast<double>(maps.levels.size() - 1);
  const double at = level > 0 ? std::min(level, last) : 0;  // 0 too if it is no number
  const auto first = static_cast<std::size_t>(at);
  const auto share = static_cast<float>(at - static_cast<double>(first));
  TextureValue value = sample_bilinear(maps.levels[first], uv, wrap);
  if (share == 0) return value;
  const TextureValue other = sample_bilinear(maps.levels[first + 1], uv, wrap);
  for (std::size_t i = 0; i < value.size(); ++i) value[i] += share * (other[i] - value[i]);
  return value;
}

}  // namespace wrapatlas
