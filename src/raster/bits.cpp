#include "raster/bits.h"

#include <algorithm>
#include <array>

namespace wrapatlas {
namespace {

/// Transposes a 64 x 64 bit block in place by swapping ever smaller off-diagonal squares.
void transpose_block(std::array<std::uint64_t, 64>& block) {
  std::uint64_t mask = 0x00000000ffffffffULL;
  for (unsigned size = 32; size != 0; size >>= 1U, mask ^= mask << size) {
    for (unsigned row = 0; row < 64; row = ((row | size) + 1) & ~size) {
      const std::uint64_t swap = ((block[row] >> size) ^ block[row | size]) & mask;
      block[row] ^= swap << size;
      block[row | size] ^= swap;
    }
  }
}

}  // namespace

BitLanes transposed(const BitLanes& source) {
  BitLanes result(source.length, source.lanes);
  std::array<std::uint64_t, 64> block;
  for (int lane_block = 0; lane_block < source.lanes; lane_block += kWordBits) {
    const int lane_count = std::min(kWordBits, source.lanes - lane_block);
    for (int word = 0; word < source.words; ++word) {
      block.fill(0);
      for (int i = 0; i < lane_count; ++i) {
        block[static_cast<std::size_t>(i)] = source.lane(lane_block + i)[word];
      }
      transpose_block(block);
      const int position_count = std::min(kWordBits, source.length - word * kWordBits);
      for (int i = 0; i < position_count; ++i) {
        result.lane(word * kWordBits + i)[lane_block / kWordBits] =
            block[static_cast<std::size_t>(i)];
      }
    }
  }
  return result;
}

std::int64_t count_set(const BitLanes& lanes) {
  std::int64_t count = 0;
  for (const std::uint64_t word : lanes.bits) count += std::popcount(word);
  return count;
}

}  // namespace wrapatlas
