// Textures whose first three channels are directions.
#pragma once

#include "wrapatlas/texture.h"

namespace wrapatlas {

/// Makes directions, held as (n + 1) / 2, unit vectors; those that are next to nothing stay.
void make_unit(Texture& texture);

/// Makes vectors n directions held as (n + 1) / 2; what is next to nothing is up, (0, 0, 1).
/// `threads`: 0: as many as there are.
void encode_directions(Texture& texture, int threads);

}  // namespace wrapatlas
