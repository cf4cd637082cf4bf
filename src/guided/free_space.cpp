#include "guided/free_space.h"

#include <algorithm>

#include "guided/inner_squares.h"
#include "guided/words.h"

namespace wrapatlas {
namespace {

constexpr std::size_t kSquares = 4;  ///< squares within a piece that are asked for first

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

/// Sets the bits that stand for translations in the domain: those of `words` words from `word` on.
template <typename Words>
[[gnu::always_inline]] inline void set_in_domain(Words& bits, int width, int word, int words) {
  if (words >= Words::kCount && width - word * kWordBits >= Words::kCount * kWordBits) {
    bits.set();
    return;
  }
  std::uint64_t valid[Words::kCount];
  for (int k = 0; k < Words::kCount; ++k) valid[k] = k < words ? in_domain(width, word + k) : 0;
  bits.load(valid);
}

template <typename Words>
[[gnu::always_inline]] inline bool scan(const Occupancy& occupancy, std::span<const Probe> probes,
                                        int y, int first_word, int words, std::uint64_t* free) {
  const int width = occupancy.domain().width;
  const std::ptrdiff_t line = y * occupancy.stride() + first_word;
  const std::ptrdiff_t around = occupancy.domain().height * occupancy.stride();
  bool any = false;
  for (int i = 0; i < words; i += Words::kCount) {
    Words left;
    set_in_domain(left, width, first_word + i, words - i);
    const Probe* probe = probes.data();
    const Probe* const end = probe + probes.size();
    while (probe != end) {
      const Probe* const stop = probe + std::min(Words::kClears, end - probe);
      for (; probe != stop; ++probe) {
        left.clear(look(occupancy, *probe, y, line + i, around), probe->shift);
      }
      if (!left.any()) break;
    }
    left.store(free + i);
    any = any || left.any();
  }
  return any;
}

bool scan_scalar(const Occupancy& occupancy, std::span<const Probe> probes, int y, int first_word,
                 int words, std::uint64_t* free) {
  return scan<ScalarWords>(occupancy, probes, y, first_word, words, free);
}

#if defined(__x86_64__)
WRAPATLAS_AVX2 bool scan_avx2(const Occupancy& occupancy, std::span<const Probe> probes, int y,
                              int first_word, int words, std::uint64_t* free) {
  return scan<Avx2Words>(occupancy, probes, y, first_word, words, free);
}
WRAPATLAS_AVX512 bool scan_avx512(const Occupancy& occupancy, std::span<const Probe> probes, int y,
                                  int first_word, int words, std::uint64_t* free) {
  return scan<Avx512Words>(occupancy, probes, y, first_word, words, free);
}
constexpr Versions<FreeRowKernel> kFreeRowVersions{scan_scalar, scan_avx2, scan_avx512};
#else
constexpr Versions<FreeRowKernel> kFreeRowVersions{scan_scalar, nullptr, nullptr};
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
        {square.level, square.y % domain.height, square.x % domain.width / kWordBits});
  }
  for (const PieceRun& run : piece.runs) {
    int level = 0;
    while (level + 1 < occupancy.stretch_levels() && 2 << level <= run.end - run.begin) ++level;
    const int last = run.end - (1 << level);
    for (int x = run.begin; x < last; x += 1 << level) {
      add(Occupancy::stretch_table(level), x, run.row);
    }
    add(Occupancy::stretch_table(level), last, run.row);
  }
  return probes;
}

bool open_words(const Occupancy& occupancy, const Probes& probes, int y,
                std::span<std::uint64_t> open) {
  std::fill(open.begin(), open.end(), ~std::uint64_t{0});
  std::uint64_t any = ~std::uint64_t{0};
  for (const Probes::Gate& gate : probes.gates) {
    int row = y + gate.row;
    if (row >= occupancy.domain().height) row -= occupancy.domain().height;
    const std::uint64_t* words = occupancy.open_words(gate.level, row);
    any = 0;
    // The translations of a word look into two.
    int first = gate.word;
    for (std::uint64_t& bits : open) {
      bits &= bits_at(words, first) | bits_at(words, first + 1);
      any |= bits;
      first += kWordBits;
    }
    if (any == 0) return false;
  }
  return true;
}

void prefetch_rows(const Occupancy& occupancy, const Probes& probes, int y, int first_word,
                   int words) {
  constexpr int kAhead = 2, kLineWords = 8;
  const int height = occupancy.domain().height;
  const int ahead = (y + kAhead) % height;
  const std::ptrdiff_t line = ahead * occupancy.stride() + first_word;
  for (std::size_t k = 0; k < std::min(kSquares, probes.all.size()); ++k) {
    const std::uint64_t* at =
        look(occupancy, probes.all[k], ahead, line, height * occupancy.stride());
    for (int i = 0; i <= words; i += kLineWords) __builtin_prefetch(at + i);
  }
}

std::vector<FreeRowKernel> free_row_kernels() { return kFreeRowVersions.usable(); }

bool free_row(const Occupancy& occupancy, std::span<const Probe> probes, int y, int first_word,
              int words, std::uint64_t* free) {
  static const FreeRowKernel widest = free_row_kernels().front();
  return widest(occupancy, probes, y, first_word, words, free);
}

}  // namespace wrapatlas
