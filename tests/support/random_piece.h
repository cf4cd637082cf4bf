// Pieces of the guided packer with random runs.
#pragma once

#include <algorithm>

#include "guided/piece.h"
#include "guided/random.h"

namespace wrapatlas::test {

inline BitLanes cells_of(const Piece& piece) {
  BitLanes cells(piece.height, piece.width);
  for (const PieceRun& run : piece.runs) set_span(cells.lane(run.row), run.begin, run.end);
  return cells;
}

/// With holes every few cells, unless `longest` says that runs may be longer.
inline Piece random_piece(Random& random, int width, int height, int longest = 6) {
  Piece piece;
  piece.width = width;
  piece.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = random.below(3); x < width;) {
      const int end = std::min(width, x + 1 + random.below(longest));
      piece.runs.push_back({y, x, end});
      piece.cells += end - x;
      x = end + 1 + random.below(4);
    }
  }
  piece.spread = piece.runs;
  piece.core = core_of(cells_of(piece));
  return piece;
}

}  // namespace wrapatlas::test
