// Where a material reads its texture.
#pragma once

#include <cmath>

#include "wrapatlas/transfer.h"

namespace wrapatlas {

/// A place as a texture that repeats by itself, or a clamped one, finds it.
inline double folded(double place, Repeat repeat) {
  if (repeat != Repeat::mirror) return place;
  const double within = place - 2 * std::floor(place / 2);
  return within > 1 ? 2 - within : within;
}

/// `uv`: v down from the top.
inline Vec2 place_of(const TransferSource& source, Vec2 uv) {
  const auto& m = source.matrix;
  return {folded(m[0] * uv.x + m[1] * uv.y + m[2], source.across),
          folded(m[3] * uv.x + m[4] * uv.y + m[5], source.down)};
}

inline Wrap wrap_of(const TransferSource& source) {
  return wrap_on(source.across == Repeat::repeat, source.down == Repeat::repeat);
}

/// Texture space per unit of UV space.
inline double area_scale(const TransferSource& source) {
  const auto& m = source.matrix;
  return std::abs(m[0] * m[4] - m[1] * m[3]);
}

/// A sample of a texture of so many channels, as red, green, blue and alpha.
inline TextureValue as_color(const TextureValue& value, int channels) {
  if (channels < 3) return {value[0], value[0], value[0], channels == 2 ? value[1] : 1.0F};
  return {value[0], value[1], value[2], channels == 4 ? value[3] : 1.0F};
}

}  // namespace wrapatlas
