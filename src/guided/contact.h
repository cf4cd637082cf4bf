// How much of a piece's outline would touch what is there.
#pragma once

#include <cstdint>

#include "guided/occupancy.h"
#include "raster/bits.h"

namespace wrapatlas {

/// The cells around a piece that are not its own: a ring one cell wide, diagonals included.
struct Ring {
  BitLanes cells;          ///< a row and a column more than the piece on each side
  std::int64_t count = 0;  ///< of cells
};
Ring ring_of(const BitLanes& rows);

/// Share of the ring that is taken, in [0, 1], with the piece's cell (0,0) at (x, y) of the domain.
/// Beyond a side that does not wrap all is taken.
double contact(const Occupancy& occupancy, const Ring& ring, int x, int y);

}  // namespace wrapatlas
