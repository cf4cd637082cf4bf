#include "guided/contact.h"

#include <bit>

#include "guided/wrapped.h"

namespace wrapatlas {
namespace {

/// Bits `word` * 64 ... + 63 of a lane moved up by `shift` bits, 0 to 2.
std::uint64_t moved(const BitLanes& rows, int lane, int word, int shift) {
  if (lane < 0 || lane >= rows.lanes) return 0;
  const std::uint64_t* bits = rows.lane(lane);
  const std::uint64_t here = word < rows.words ? bits[word] << shift : 0;
  if (shift == 0 || word == 0) return here;
  return here | bits[word - 1] >> (kWordBits - shift);
}

}  // namespace

Ring ring_of(const BitLanes& rows) {
  Ring ring;
  ring.cells = BitLanes(rows.lanes + 2, rows.length + 2);
  for (int y = 0; y < ring.cells.lanes; ++y) {
    for (int word = 0; word < ring.cells.words; ++word) {
      std::uint64_t near = 0;
      for (int dy = 0; dy <= 2; ++dy) {
        for (int dx = 0; dx <= 2; ++dx) near |= moved(rows, y - dy, word, dx);
      }
      const std::uint64_t bits = near & ~moved(rows, y - 1, word, 1);
      ring.cells.lane(y)[word] = bits;
      ring.count += std::popcount(bits);
    }
  }
  return ring;
}

double contact(const Occupancy& occupancy, const Ring& ring, int x, int y) {
  const Domain& domain = occupancy.domain();
  const int first = domain.wraps_x ? modulo(x - 1, domain.width) : x - 1;
  std::int64_t touching = 0;
  for (int i = 0; i < ring.cells.lanes; ++i) {
    const std::uint64_t* cells = ring.cells.lane(i);
    int row = y - 1 + i;
    if (domain.wraps_y) {
      row = modulo(row, domain.height);
    } else if (row < 0 || row >= domain.height) {
      for (int word = 0; word < ring.cells.words; ++word) touching += std::popcount(cells[word]);
      continue;
    }
    const std::uint64_t* taken = occupancy.row(0, row);
    for (int word = 0, at = first; word < ring.cells.words; ++word, at += kWordBits) {
      if (domain.wraps_x && at >= domain.width) at %= domain.width;
      touching += std::popcount(cells[word] & bits_at(taken, at));
    }
  }
  return static_cast<double>(touching) / static_cast<double>(ring.count);
}

}  // namespace wrapatlas
