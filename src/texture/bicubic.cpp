#include "texture/bicubic.h"

#include <algorithm>
#include <cmath>

#include "texture/texel_place.h"

namespace wrapatlas {
namespace {

/// Four texels along one axis and their weights.
struct Quad {
  std::array<int, 4> texels{};
  std::array<float, 4> weights{};
};

Quad quad_at(double place, int count, bool wraps) {
  const double texel = texel_place(place, count, wraps);
  const int first = static_cast<int>(std::floor(texel));
  const double t = texel - first;
  Quad quad;
  const std::array<double, 4> weights{((-0.5 * t + 1) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1,
                                      ((-1.5 * t + 2) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
  for (int i = 0; i < 4; ++i) {
    const int at = first - 1 + i;
    const auto k = static_cast<std::size_t>(i);
    quad.texels[k] = wraps ? ((at % count) + count) % count : std::clamp(at, 0, count - 1);
    quad.weights[k] = static_cast<float>(weights[k]);
  }
  return quad;
}

}  // namespace

TextureValue sample_bicubic(const Texture& texture, Vec2 uv, Wrap wrap) {
  const Quad x = quad_at(uv.x, texture.width, wraps_u(wrap));
  const Quad y = quad_at(uv.y, texture.height, wraps_v(wrap));
  TextureValue value{};
  for (int c = 0; c < texture.channels; ++c) {
    float sum = 0, low = 1e30F, high = -1e30F;
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const float one = texture.at(x.texels[i], y.texels[j])[c];
        sum += x.weights[i] * y.weights[j] * one;
        low = std::min(low, one);
        high = std::max(high, one);
      }
    }
    value[static_cast<std::size_t>(c)] = std::clamp(sum, low, high);
  }
  return value;
}

}  // namespace wrapatlas
