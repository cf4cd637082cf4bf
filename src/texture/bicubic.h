// A sharper filter than the one that graphics cards have, for resampling.
#pragma once

#include "wrapatlas/texture.h"

namespace wrapatlas {

/// The interpolating cubic of Catmull & Rom (1974), cut to the range of the 4 x 4 texels around, so
/// that nothing rings. Else as sample_bilinear.
TextureValue sample_bicubic(const Texture& texture, Vec2 uv, Wrap wrap);

}  // namespace wrapatlas
