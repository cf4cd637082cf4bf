// What may be baked or resampled into.
#pragma once

#include <fmt/format.h>

#include "bake/texel_samples.h"
#include "mesh/triangulate.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

inline Status check_texture_size(int width, int height) {
  if (width >= 1 && height >= 1 && width <= kMostTexels && height <= kMostTexels) return Done{};
  return Error{ErrorKind::usage, "size", "a side is not from 1 to 65536 texels", "choose another"};
}

/// `where` names the mesh in the error.
inline Status check_samples(const TexelSamples& samples, const Triangulated& triangles,
                            const char* where) {
  if (samples.boundless_triangle() == kNone) return Done{};
  return Error{ErrorKind::input, where,
               fmt::format("the UVs of face {} reach over too many atlases",
                           triangles.face_source[samples.boundless_triangle()]),
               "pack it first"};
}

}  // namespace wrapatlas
