// Some consecutive words of bits, worked on together: a struct per instruction set, all with the
// same members. See instruction_sets.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "guided/instruction_sets.h"

namespace wrapatlas {

struct ScalarWords {
  static constexpr int kCount = 1;
  static constexpr std::ptrdiff_t kClears = 1;  ///< worth doing between two calls of any()
  std::uint64_t bits;

  void set() { bits = ~std::uint64_t{0}; }
  void load(const std::uint64_t* from) { bits = *from; }
  void store(std::uint64_t* to) const { *to = bits; }
  [[nodiscard]] bool any() const { return bits != 0; }
  /// Clears the bits that are set in those from bit `shift`, 0 to 63, of *at on. Reads a word more.
  void clear(const std::uint64_t* at, int shift) {
    bits &= ~(at[0] >> shift | at[1] << 1 << (63 - shift));
  }
};

#if defined(__x86_64__)

struct Avx2Words {
  static constexpr int kCount = 4;
  static constexpr std::ptrdiff_t kClears = 4;
  __m256i bits;

  WRAPATLAS_AVX2 void set() { bits = _mm256_set1_epi64x(-1); }
  WRAPATLAS_AVX2 void load(const std::uint64_t* from) { bits = loaded(from); }
  WRAPATLAS_AVX2 void store(std::uint64_t* to) const {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), bits);
  }
  [[nodiscard]] WRAPATLAS_AVX2 bool any() const { return _mm256_testz_si256(bits, bits) == 0; }
  WRAPATLAS_AVX2 void clear(const std::uint64_t* at, int shift) {
    const __m256i low = _mm256_srl_epi64(loaded(at), _mm_cvtsi32_si128(shift));
    const __m256i high = _mm256_sll_epi64(loaded(at + 1), _mm_cvtsi32_si128(64 - shift));
    bits = _mm256_andnot_si256(_mm256_or_si256(low, high), bits);  // shifting by 64 gives 0
  }

 private:
  WRAPATLAS_AVX2 static __m256i loaded(const std::uint64_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
};

struct Avx512Words {
  static constexpr int kCount = 8;
  static constexpr std::ptrdiff_t kClears = 4;
  __m512i bits;

  WRAPATLAS_AVX512 void set() { bits = _mm512_set1_epi64(-1); }
  WRAPATLAS_AVX512 void load(const std::uint64_t* from) { bits = _mm512_loadu_si512(from); }
  WRAPATLAS_AVX512 void store(std::uint64_t* to) const { _mm512_storeu_si512(to, bits); }
  [[nodiscard]] WRAPATLAS_AVX512 bool any() const {
    return _mm512_test_epi64_mask(bits, bits) != 0;
  }
  WRAPATLAS_AVX512 void clear(const std::uint64_t* at, int shift) {
    // The forms with a mask leave nothing undefined, which g++ 12 warns of in the others.
    const __m512i low =
        _mm512_maskz_srl_epi64(0xff, _mm512_loadu_si512(at), _mm_cvtsi32_si128(shift));
    const __m512i high =
        _mm512_maskz_sll_epi64(0xff, _mm512_loadu_si512(at + 1), _mm_cvtsi32_si128(64 - shift));
    constexpr int kFirstAndNeitherOther = 0x10;
    bits = _mm512_ternarylogic_epi64(bits, low, high, kFirstAndNeitherOther);
  }
};

#endif

}  // namespace wrapatlas
