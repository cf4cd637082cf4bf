#include "guided/inner_squares.h"

#include <algorithm>

namespace wrapatlas {
namespace {

/// The 64 bits from `shift` on after the beginning of a word; beyond the lane there is nothing.
std::uint64_t shifted_word(const BitLanes& lanes, int lane, int word, int shift) {
  const int at = word + shift / kWordBits, rest = shift % kWordBits;
  const std::uint64_t* bits = lanes.lane(lane);
  const std::uint64_t low = at < lanes.words ? bits[at] >> rest : 0;
  if (rest == 0 || at + 1 >= lanes.words) return low;
  return low | bits[at + 1] << (kWordBits - rest);
}

/// Where squares of twice the side begin.
BitLanes doubled(const BitLanes& squares, int side) {
  BitLanes larger(squares.lanes, squares.length);
  for (int y = 0; y + side < squares.lanes; ++y) {
    for (int word = 0; word < squares.words; ++word) {
      larger.lane(y)[word] = squares.lane(y)[word] & squares.lane(y + side)[word] &
                             shifted_word(squares, y, word, side) &
                             shifted_word(squares, y + side, word, side);
    }
  }
  return larger;
}

bool meet(const InnerSquare& a, const InnerSquare& b) {
  const int a_side = 1 << a.level, b_side = 1 << b.level;
  return a.x < b.x + b_side && b.x < a.x + a_side && a.y < b.y + b_side && b.y < a.y + a_side;
}

}  // namespace

std::vector<InnerSquare> inner_squares(const BitLanes& cells, int levels, std::size_t count) {
  std::vector<BitLanes> starts{cells};
  while (static_cast<int>(starts.size()) < levels) {
    BitLanes larger = doubled(starts.back(), 1 << (starts.size() - 1));
    if (std::all_of(larger.bits.begin(), larger.bits.end(), [](auto word) { return word == 0; })) {
      break;
    }
    starts.push_back(std::move(larger));
  }
  std::vector<InnerSquare> squares;
  for (int level = static_cast<int>(starts.size()) - 1; level > 0; --level) {
    const BitLanes& here = starts[static_cast<std::size_t>(level)];
    for (int y = 0; y < here.lanes; ++y) {
      for (int x = next_set(here.lane(y), here.length, 0); x < here.length;) {
        if (squares.size() == count) return squares;
        const InnerSquare square{level, x, y};
        const auto meets = [&](const InnerSquare& other) { return meet(square, other); };
        if (std::none_of(squares.begin(), squares.end(), meets)) squares.push_back(square);
        const int next = x + (1 << level);
        x = next < here.length ? next_set(here.lane(y), here.length, next) : here.length;
      }
    }
  }
  return squares;
}

}  // namespace wrapatlas
