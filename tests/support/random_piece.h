// Pieces of the guided packer with random runs.
#pragma once

#include <algorithm>

#include "guided/piece.h"
#include "guided/random.h"

namespace wrapatlas::test {

inline Piece random_piece(Random& random, int width, int height) {
  Piece piece;
  piece.width = width;
  piece.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = random.below(3); x < width;) {
      const int end = std::min(width, x + 1 + random.below(6));
      piece.runs.push_back({y, x, end});
      piece.cells += end - x;
      x = end + 1 + random.below(4);
    }
  }
  piece.spread = piece.runs;
  return piece;
}

}  // namespace wrapatlas::test
