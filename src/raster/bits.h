// Rows of bits: the material of chart rasters and of the packing board.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace wrapatlas {

inline constexpr int kWordBits = 64;
inline int words_for(int bits) { return (bits + kWordBits - 1) / kWordBits; }

/// `lanes` rows of `length` bits each; bits past `length` in the last word of a lane are zero.
struct BitLanes {
  int lanes = 0;
  int length = 0;
  int words = 0;  ///< per lane
  std::vector<std::uint64_t> bits;

  BitLanes() = default;
  BitLanes(int lane_count, int lane_length)
      : lanes(lane_count),
        length(lane_length),
        words(words_for(lane_length)),
        bits(static_cast<std::size_t>(lane_count) * static_cast<std::size_t>(words)) {}

  std::uint64_t* lane(int i) { return bits.data() + static_cast<std::size_t>(i) * words; }
  [[nodiscard]] const std::uint64_t* lane(int i) const {
    return bits.data() + static_cast<std::size_t>(i) * words;
  }
  [[nodiscard]] bool test(int i, int position) const {
    return ((lane(i)[position / kWordBits] >> (position % kWordBits)) & 1U) != 0;
  }
  void set(int i, int position) {
    lane(i)[position / kWordBits] |= std::uint64_t{1} << (position % kWordBits);
  }
};

/// Sets bits [begin, end) of a lane. Precondition: begin < end, both within the lane.
inline void set_span(std::uint64_t* lane, int begin, int end) {
  const int first = begin / kWordBits, last = (end - 1) / kWordBits;
  const std::uint64_t head = ~std::uint64_t{0} << (begin % kWordBits);
  const std::uint64_t tail =
      ~std::uint64_t{0} >> (kWordBits - 1 - static_cast<unsigned>(end - 1) % kWordBits);
  if (first == last) {
    lane[first] |= head & tail;
    return;
  }
  lane[first] |= head;
  for (int word = first + 1; word < last; ++word) lane[word] = ~std::uint64_t{0};
  lane[last] |= tail;
}

/// Position of the first set bit at or after `from`, or `length` if there is none.
inline int next_set(const std::uint64_t* lane, int length, int from) {
  int word = from / kWordBits;
  const int words = words_for(length);
  if (word >= words) return length;
  std::uint64_t bits = lane[word] & (~std::uint64_t{0} << (from % kWordBits));
  while (bits == 0) {
    if (++word == words) return length;
    bits = lane[word];
  }
  return word * kWordBits + std::countr_zero(bits);
}

/// Position of the first clear bit at or after `from`, or `length` if there is none.
inline int next_clear(const std::uint64_t* lane, int length, int from) {
  int word = from / kWordBits;
  const int words = words_for(length);
  if (word >= words) return length;
  std::uint64_t bits = ~lane[word] & (~std::uint64_t{0} << (from % kWordBits));
  while (bits == 0) {
    if (++word == words) return length;
    bits = ~lane[word];
  }
  const int position = word * kWordBits + std::countr_zero(bits);
  return position < length ? position : length;
}

/// Position of the last set bit, or -1.
inline int last_set(const std::uint64_t* lane, int length) {
  for (int word = words_for(length) - 1; word >= 0; --word) {
    if (lane[word] != 0) return word * kWordBits + kWordBits - 1 - std::countl_zero(lane[word]);
  }
  return -1;
}

/// Calls visit(begin, end) for every maximal run of set bits of a lane, in order.
template <typename Visit>
void for_each_run(const std::uint64_t* lane, int length, Visit visit) {
  for (int begin = next_set(lane, length, 0); begin < length;) {
    const int end = next_clear(lane, length, begin);
    visit(begin, end);
    begin = end < length ? next_set(lane, length, end) : length;
  }
}

/// Lanes become positions and positions lanes. O(bits / 64 * 6).
BitLanes transposed(const BitLanes& source);

/// Covered cells.
std::int64_t count_set(const BitLanes& lanes);

}  // namespace wrapatlas
