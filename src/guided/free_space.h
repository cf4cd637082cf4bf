// The configuration space of a piece: all translations at which it covers no cell that is taken, a
// bit each. A run [a, b) of the piece is free at x if two stretches of 2^j cells are, j =
// floor(log2(b - a)): the one that begins at x + a and the one that ends at x + b. So a row of the
// answer is two shifted rows of the occupancy a run, whatever the length of the run. Squares within
// the piece, a shifted row each, come first: on a full board they leave nothing to ask.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "guided/occupancy.h"

namespace wrapatlas {

/// One look into the occupancy, from a translation (0, 0) on.
struct Probe {
  std::int32_t row = 0;     ///< of the domain
  std::int32_t shift = 0;   ///< of the bits of a word
  std::ptrdiff_t word = 0;  ///< from Occupancy::data()
};

/// What has to be free for a piece.
struct Probes {
  std::vector<Probe> all;
  /// Of the squares among them: their level, and row and word from a translation (0, 0) on.
  struct Gate {
    std::int32_t level = 0, row = 0, word = 0;
  };
  std::vector<Gate> gates;
};

/// `cells`: the piece's, a lane a row. Precondition: the domain admits the piece.
Probes probes_of(const Piece& piece, const BitLanes& cells, const Occupancy& occupancy);

/// Which words of translations of row y may have a free one, a bit each: the others need not be
/// looked at. `open`: for all words of the domain. False if there are none.
bool open_words(const Occupancy& occupancy, const Probes& probes, int y,
                std::span<std::uint64_t> open);

/// Clears the bit of every translation (x, y) with x in the given words that is not free, and sets
/// the others: bit x of `free`, from word `first_word` of the domain's row on. False if none is
/// free. Room is needed for 8 words more than asked for. Precondition: y in the domain and, where
/// it does not wrap, the piece does not leave it at y.
bool free_row(const Occupancy& occupancy, std::span<const Probe> probes, int y, int first_word,
              int words, std::uint64_t* free);

/// Asks for the memory that free_row() will look at first for these words two rows further on,
/// which most often are open where these are: the tables of a large domain fit into no cache.
void prefetch_rows(const Occupancy& occupancy, const Probes& probes, int y, int first_word,
                   int words);

using FreeRowKernel = bool (*)(const Occupancy& occupancy, std::span<const Probe> probes, int y,
                               int first_word, int words, std::uint64_t* free);
/// The versions that the machine can run, the widest first, for tests and benchmarks.
std::vector<FreeRowKernel> free_row_kernels();

}  // namespace wrapatlas
