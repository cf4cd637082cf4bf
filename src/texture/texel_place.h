// From a place on a texture to its texels.
#pragma once

#include <algorithm>
#include <cmath>

namespace wrapatlas {

/// Along one axis, in texels counted from the centre of the first one: from 0 to `count` where the
/// axis wraps, else from -1 to `count`. Places that are no number, or so far away that no texel of
/// theirs can be told, are 0.
inline double texel_place(double place, int count, bool wraps) {
  if (!(std::abs(place) < 1e15)) return 0;
  double texel = place * count - 0.5;
  if (wraps) texel -= std::floor(texel / count) * count;
  return std::clamp(texel, wraps ? 0.0 : -1.0, double(count));
}

}  // namespace wrapatlas
