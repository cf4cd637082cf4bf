// Textures whose first three channels are directions, as (n + 1) / 2.
#pragma once

#include "wrapatlas/texture.h"

namespace wrapatlas {

/// Makes them unit vectors; those that are next to nothing stay. `threads` as for dilate.
void make_unit(Texture& texture, int threads = 1);

}  // namespace wrapatlas
