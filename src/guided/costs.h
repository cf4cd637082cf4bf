// The costs of consecutive translations, added up together: a struct per instruction set, all with
// the same members. Costs that reach 2^16 - 1 stay there. See instruction_sets.h.
#pragma once

#include <algorithm>
#include <cstdint>

#include "guided/instruction_sets.h"

namespace wrapatlas {

inline constexpr int kTile = 32;  ///< translations along x worked on together

struct ScalarCosts {
  std::uint16_t costs[kTile] = {};

  /// What one run costs: the sums at its end less those at its beginning.
  void add(const std::uint16_t* end, const std::uint16_t* begin) {
    for (int k = 0; k < kTile; ++k) {
      const unsigned sum = costs[k] + static_cast<std::uint16_t>(end[k] - begin[k]);
      costs[k] = static_cast<std::uint16_t>(std::min(sum, 0xffffU));
    }
  }
  void store(std::uint16_t* to) const { std::copy(costs, costs + kTile, to); }
  [[nodiscard]] bool any_below(std::uint16_t limit) const {
    return std::any_of(costs, costs + kTile, [&](std::uint16_t cost) { return cost < limit; });
  }
  /// A bit each.
  [[nodiscard]] std::uint32_t below(std::uint16_t limit) const {
    std::uint32_t bits = 0;
    for (int k = 0; k < kTile; ++k) bits |= std::uint32_t{costs[k] < limit} << k;
    return bits;
  }
};

#if defined(__x86_64__)

struct Avx2Costs {
  __m256i low, high;

  WRAPATLAS_AVX2 Avx2Costs() : low(_mm256_setzero_si256()), high(_mm256_setzero_si256()) {}
  WRAPATLAS_AVX2 void add(const std::uint16_t* end, const std::uint16_t* begin) {
    low = _mm256_adds_epu16(low, _mm256_sub_epi16(loaded(end), loaded(begin)));
    high = _mm256_adds_epu16(high, _mm256_sub_epi16(loaded(end + 16), loaded(begin + 16)));
  }
  WRAPATLAS_AVX2 void store(std::uint16_t* to) const {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), low);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 16), high);
  }
  [[nodiscard]] WRAPATLAS_AVX2 bool any_below(std::uint16_t limit) const {
    const __m256i limits = _mm256_set1_epi16(static_cast<short>(limit));
    const __m256i room =
        _mm256_or_si256(_mm256_subs_epu16(limits, low), _mm256_subs_epu16(limits, high));
    return _mm256_testz_si256(room, room) == 0;
  }
  [[nodiscard]] WRAPATLAS_AVX2 std::uint32_t below(std::uint16_t limit) const {
    const __m256i limits = _mm256_set1_epi16(static_cast<short>(limit));
    const __m256i zero = _mm256_setzero_si256();
    // Halves of 128 bits are packed side by side, so they are put in order again.
    const __m256i none = _mm256_permute4x64_epi64(
        _mm256_packs_epi16(_mm256_cmpeq_epi16(_mm256_subs_epu16(limits, low), zero),
                           _mm256_cmpeq_epi16(_mm256_subs_epu16(limits, high), zero)),
        0xd8);
    return ~static_cast<std::uint32_t>(_mm256_movemask_epi8(none));
  }

 private:
  WRAPATLAS_AVX2 static __m256i loaded(const std::uint16_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
};

struct Avx512Costs {
  __m512i costs;

  WRAPATLAS_AVX512 Avx512Costs() : costs(_mm512_setzero_si512()) {}
  WRAPATLAS_AVX512 void add(const std::uint16_t* end, const std::uint16_t* begin) {
    const __m512i run = _mm512_sub_epi16(_mm512_loadu_si512(end), _mm512_loadu_si512(begin));
    costs = _mm512_adds_epu16(costs, run);
  }
  WRAPATLAS_AVX512 void store(std::uint16_t* to) const { _mm512_storeu_si512(to, costs); }
  [[nodiscard]] WRAPATLAS_AVX512 bool any_below(std::uint16_t limit) const {
    return below(limit) != 0;
  }
  [[nodiscard]] WRAPATLAS_AVX512 std::uint32_t below(std::uint16_t limit) const {
    return _mm512_cmplt_epu16_mask(costs, _mm512_set1_epi16(static_cast<short>(limit)));
  }
};

#endif

}  // namespace wrapatlas
