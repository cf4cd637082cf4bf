#include "pack/board.h"

#include <algorithm>

namespace wrapatlas {
namespace {

/// Calls visit(word index, bits) for the words of a cyclic lane of `length` bits that the source
/// bits, shifted by `shift` (0 <= shift < length), fall on; stops when visit returns true.
template <typename Visit>
bool visit_shifted(const std::uint64_t* source, int source_length, int shift, int length,
                   Visit visit) {
  for (int word = 0, left = source_length; left > 0; ++word, left -= kWordBits) {
    std::uint64_t bits = source[word];
    int position = (shift + word * kWordBits) % length;
    int count = std::min(left, kWordBits);
    while (bits != 0 && count > 0) {
      const int offset = position % kWordBits;
      const int room = std::min({count, kWordBits - offset, length - position});
      const std::uint64_t mask = ~std::uint64_t{0} >> (kWordBits - room);
      if (visit(position / kWordBits, (bits & mask) << offset)) return true;
      bits = room < kWordBits ? bits >> room : 0;
      count -= room;
      position += room;
      if (position == length) position = 0;
    }
  }
  return false;
}

void add_lanes(BitLanes& board, const BitLanes& chart, int lane, int shift) {
  for (int i = 0; i < chart.lanes; ++i) {
    std::uint64_t* target = board.lane((lane + i) % board.lanes);
    visit_shifted(chart.lane(i), chart.length, shift, board.length,
                  [target](int word, std::uint64_t bits) {
                    target[word] |= bits;
                    return false;
                  });
  }
}

}  // namespace

Board::Board(int width, int height, Wrap wrap)
    : wrap_(wrap), columns_(width, height), rows_(height, width) {}

bool Board::admits(const ChartRaster& chart) const {
  if (chart.width == 0) return false;
  if (!wraps_x() && chart.width > width()) return false;
  if (!wraps_y() && chart.height > height()) return false;
  if (chart.width <= width() && chart.height <= height()) return true;
  if (chart.cells > static_cast<std::int64_t>(width()) * height()) return false;
  // Whether cells meet does not change if chart and board are turned together.
  const BitLanes& cells = *chart.unturned;
  const bool across = chart.turns % 2 == 1;
  BitLanes folded(across ? width() : height(), across ? height() : width());
  for (int y = 0; y < cells.lanes; ++y) {
    std::uint64_t* target = folded.lane(y % folded.lanes);
    const bool twice = visit_shifted(cells.lane(y), cells.length, 0, folded.length,
                                     [target](int word, std::uint64_t bits) {
                                       if ((target[word] & bits) != 0) return true;
                                       target[word] |= bits;
                                       return false;
                                     });
    if (twice) return false;
  }
  return true;
}

bool Board::collides(const CellViews& chart, int x, int y) const {
  if (!wraps_x() && x + chart.rows.length > width()) return true;
  if (!wraps_y() && y + chart.rows.lanes > height()) return true;
  for (int i = 0; i < chart.rows.lanes; ++i) {
    const std::uint64_t* lane = rows_.lane((y + i) % height());
    const bool shared =
        visit_shifted(chart.rows.lane(i), chart.rows.length, x, width(),
                      [lane](int word, std::uint64_t bits) { return (lane[word] & bits) != 0; });
    if (shared) return true;
  }
  return false;
}

void Board::add(const CellViews& chart, int x, int y) {
  add_lanes(rows_, chart.rows, y, x);
  add_lanes(columns_, chart.columns, x, y);
}

}  // namespace wrapatlas
