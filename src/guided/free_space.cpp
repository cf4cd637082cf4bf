#include "guided/free_space.h"

#include <algorithm>
#include <bit>

#include "guided/inner_squares.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace wrapatlas {
namespace {

constexpr std::size_t kSquares = 4;  ///< squares within a piece that are asked for first
constexpr std::size_t kChunk = 4;    ///< probes between two looks at whether anything is still free

/// Bits of the word that lie in the domain.
std::uint64_t in_domain(int width, int word) {
  const int left = width - word * kWordBits;
  if (left >= kWordBits) return ~std::uint64_t{0};
  return left <= 0 ? 0 : ~std::uint64_t{0} >> (kWordBits - left);
}

/// Where a probe looks, for translations from bit 0 of a word on. `line`: of row y, and that word.
inline const std::uint64_t* look(const Occupancy& occupancy, const Probe& probe, int y,
                                 std::ptrdiff_t line, std::ptrdiff_t around) {
  const std::uint64_t* at = occupancy.data() + probe.word + line;
  return y + probe.row < occupancy.domain().height ? at : at - around;
}

bool scan_scalar(const Occupancy& occupancy, std::span<const Probe> probes, int y, int first_word,
                 int words, std::uint64_t* free) {
  const std::ptrdiff_t line = y * occupancy.stride();
  const std::ptrdiff_t around = occupancy.domain().height * occupancy.stride();
  std::uint64_t any = 0;
  for (int i = 0; i < words; ++i) {
    const int word = first_word + i;
    std::uint64_t left = in_domain(occupancy.domain().width, word);
    for (const Probe& probe : probes) {
      if (left == 0) break;
      const std::uint64_t* at = look(occupancy, probe, y, line + word, around);
      const int shift = probe.shift;
      left &= ~(shift == 0 ? *at : at[0] >> shift | at[1] << (kWordBits - shift));
    }
    free[i] = left;
    any |= left;
  }
  return any != 0;
}

#if defined(__x86_64__)

[[gnu::target("avx2")]] inline __m256i load(const std::uint64_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

[[gnu::target("avx2")]] bool scan_avx2(const Occupancy& occupancy, std::span<const Probe> probes,
                                       int y, int first_word, int words, std::uint64_t* free) {
  const int width = occupancy.domain().width;
  const std::ptrdiff_t line = y * occupancy.stride() + first_word;
  const std::ptrdiff_t around = occupancy.domain().height * occupancy.stride();
  __m256i any = _mm256_setzero_si256();
  for (int i = 0; i < words; i += 4) {
    alignas(32) std::uint64_t valid[4];
    for (int k = 0; k < 4; ++k) valid[k] = i + k < words ? in_domain(width, first_word + i + k) : 0;
    __m256i left = load(valid);
    const Probe* probe = probes.data();
    const Probe* const end = probe + probes.size();
    while (probe != end) {
      const Probe* const stop = probe + std::min<std::ptrdiff_t>(kChunk, end - probe);
      for (; probe != stop; ++probe) {
        const std::uint64_t* at = look(occupancy, *probe, y, line + i, around);
        const int shift = probe->shift;  // shifting by 64 gives 0
        const __m256i low = _mm256_srl_epi64(load(at), _mm_cvtsi32_si128(shift));
        const __m256i high = _mm256_sll_epi64(load(at + 1), _mm_cvtsi32_si128(kWordBits - shift));
        left = _mm256_andnot_si256(_mm256_or_si256(low, high), left);
      }
      if (_mm256_testz_si256(left, left) != 0) break;
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(free + i), left);
    any = _mm256_or_si256(any, left);
  }
  return _mm256_testz_si256(any, any) == 0;
}

[[gnu::target("avx512f")]] bool scan_avx512(const Occupancy& occupancy,
                                            std::span<const Probe> probes, int y, int first_word,
                                            int words, std::uint64_t* free) {
  const int width = occupancy.domain().width;
  const std::ptrdiff_t line = y * occupancy.stride() + first_word;
  const std::ptrdiff_t around = occupancy.domain().height * occupancy.stride();
  bool any = false;
  for (int i = 0; i < words; i += 8) {
    alignas(64) std::uint64_t valid[8];
    for (int k = 0; k < 8; ++k) valid[k] = i + k < words ? in_domain(width, first_word + i + k) : 0;
    __m512i left = _mm512_load_si512(valid);
    const Probe* probe = probes.data();
    const Probe* const end = probe + probes.size();
    while (probe != end) {
      const Probe* const stop = probe + std::min<std::ptrdiff_t>(kChunk, end - probe);
      for (; probe != stop; ++probe) {
        const std::uint64_t* at = look(occupancy, *probe, y, line + i, around);
        const int shift = probe->shift;
        // The forms with a mask leave nothing undefined, which g++ 12 warns of in the others.
        const __m512i low =
            _mm512_maskz_srl_epi64(0xff, _mm512_loadu_si512(at), _mm_cvtsi32_si128(shift));
        const __m512i high = _mm512_maskz_sll_epi64(0xff, _mm512_loadu_si512(at + 1),
                                                    _mm_cvtsi32_si128(kWordBits - shift));
        constexpr int kFirstAndNeitherOther = 0x10;
        left = _mm512_ternarylogic_epi64(left, low, high, kFirstAndNeitherOther);
      }
      if (_mm512_test_epi64_mask(left, left) == 0) break;
    }
    _mm512_storeu_si512(free + i, left);
    any = any || _mm512_test_epi64_mask(left, left) != 0;
  }
  return any;
}
#endif

}  // namespace

Probes probes_of(const Piece& piece, const BitLanes& cells, const Occupancy& occupancy) {
  const Domain& domain = occupancy.domain();
  Probes probes;
  probes.all.reserve(kSquares + 2 * piece.runs.size());
  const auto add = [&](int table, int x, int y) {
    x %= domain.width;
    y %= domain.height;
    probes.all.push_back({y, x % kWordBits, occupancy.row_offset(table, y) + x / kWordBits});
  };
  for (const InnerSquare& square : inner_squares(cells, occupancy.square_levels(), kSquares)) {
    add(occupancy.square_table(square.level), square.x, square.y);
    probes.gates.push_back(
        {square.level, square.y % domain.height, square.x % domain.width / Occupancy::kBlockBits});
  }
  for (const PieceRun& run : piece.runs) {
    const int level = std::bit_width(static_cast<unsigned>(run.end - run.begin)) - 1;
    add(Occupancy::stretch_table(level), run.begin, run.row);
    const int last = run.end - (1 << level);
    if (last != run.begin) add(Occupancy::stretch_table(level), last, run.row);
  }
  return probes;
}

std::uint64_t open_blocks(const Occupancy& occupancy, const Probes& probes, int y) {
  std::uint64_t open = ~std::uint64_t{0};
  for (const Probes::Gate& gate : probes.gates) {
    int row = y + gate.row;
    if (row >= occupancy.domain().height) row -= occupancy.domain().height;
    // A block of translations looks into two blocks; the last bit stands for all that follow.
    const std::uint64_t blocks = occupancy.open_blocks(gate.level, row);
    const auto far = static_cast<std::uint64_t>(static_cast<std::int64_t>(blocks) >> gate.block);
    open &= far | static_cast<std::uint64_t>(static_cast<std::int64_t>(far) >> 1);
  }
  return open;
}

FreeRowKernel free_row_scalar() { return scan_scalar; }

FreeRowKernel free_row_avx2() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return scan_avx2;
#endif
  return nullptr;
}

FreeRowKernel free_row_avx512() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return scan_avx512;
#endif
  return nullptr;
}

bool free_row(const Occupancy& occupancy, std::span<const Probe> probes, int y, int first_word,
              int words, std::uint64_t* free) {
  static const FreeRowKernel widest = [] {
    for (const FreeRowKernel kernel : {free_row_avx512(), free_row_avx2()}) {
      if (kernel != nullptr) return kernel;
    }
    return free_row_scalar();
  }();
  return widest(occupancy, probes, y, first_word, words, free);
}

}  // namespace wrapatlas
