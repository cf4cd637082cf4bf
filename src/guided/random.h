// Random numbers that are the same with every compiler and library.
#pragma once

#include <cstdint>

namespace wrapatlas {

/// SplitMix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  /// 0 <= result < count. Precondition: count > 0.
  int below(int count) {
    return static_cast<int>((next() >> 32U) * static_cast<std::uint64_t>(count) >> 32U);
  }
  /// 0 <= result < 1.
  double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

template <typename Range>
void shuffle(Range& range, Random& random) {
  for (int i = static_cast<int>(range.size()) - 1; i > 0; --i) {
    std::swap(range[static_cast<std::size_t>(i)],
              range[static_cast<std::size_t>(random.below(i + 1))]);
  }
}

}  // namespace wrapatlas
