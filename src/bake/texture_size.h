// What sides a texture may have that is baked or resampled into.
#pragma once

#include "wrapatlas/result.h"

namespace wrapatlas {

inline Status check_texture_size(int width, int height) {
  constexpr int kMostSide = 65536;
  if (width >= 1 && height >= 1 && width <= kMostSide && height <= kMostSide) return Done{};
  return Error{ErrorKind::usage, "size", "a side is not from 1 to 65536 texels", "choose another"};
}

}  // namespace wrapatlas
