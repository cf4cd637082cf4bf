// The configuration space, against a look at every cell.
#include "guided/free_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "guided/contact.h"
#include "guided/free_map.h"
#include "guided/inner_squares.h"
#include "support/random_piece.h"

namespace wrapatlas {
namespace {

/// Cell by cell, with what is beyond a side that does not wrap.
class SlowBoard {
 public:
  explicit SlowBoard(const Domain& domain)
      : domain_(domain), taken_(static_cast<std::size_t>(domain.width * domain.height)) {}

  [[nodiscard]] bool taken(int x, int y) const {
    if (!domain_.wraps_x && (x < 0 || x >= domain_.width)) return true;
    if (!domain_.wraps_y && (y < 0 || y >= domain_.height)) return true;
    return taken_[index(x, y)];
  }
  void take(int x, int y) { taken_[index(x, y)] = true; }
  [[nodiscard]] bool free(const Piece& piece, int x, int y) const {
    for (const PieceRun& run : piece.runs) {
      for (int k = run.begin; k < run.end; ++k) {
        if (taken(x + k, y + run.row)) return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    const int column = (x % domain_.width + domain_.width) % domain_.width;
    const int row = (y % domain_.height + domain_.height) % domain_.height;
    return static_cast<std::size_t>(row * domain_.width + column);
  }
  Domain domain_;
  std::vector<bool> taken_;
};

struct Boards {
  Occupancy fast;
  SlowBoard slow;

  /// Some runs taken, in two goes, or in one go each.
  Boards(Random& random, const Domain& domain) : fast(domain), slow(domain) {
    const bool each = random.below(2) == 0;
    for (int go = 0; go < 2; ++go) {
      const int runs = random.below(domain.height);
      for (int i = 0; i < runs; ++i) {
        const int y = random.below(domain.height), begin = random.below(domain.width);
        const int longest = domain.wraps_x ? domain.width : domain.width - begin;
        const int end = begin + 1 + random.below(std::min(longest, 12));
        fast.take(y, begin, end);
        for (int x = begin; x < end; ++x) slow.take(x, y);
        if (each) fast.update();
      }
      fast.update();
    }
  }
};

Domain random_domain(Random& random) {
  constexpr int kWidths[] = {1, 7, 63, 64, 65, 128, 200, 384, 600, 1024};
  return {random.below(2) == 0 ? kWidths[random.below(10)] : 1 + random.below(150),
          1 + random.below(40), random.below(2) == 0, random.below(2) == 0};
}

TEST(Occupancy, TablesSayWhetherAnyCellIsTaken) {
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Domain domain = random_domain(random);
    const Boards boards(random, domain);
    const int y = random.below(domain.height);
    const int end = domain.wraps_x ? 2 * domain.width : domain.width;
    const auto expect_table = [&](int table, int width, int height) {
      for (int x = table == 0 ? -kWordBits : 0; x < end; ++x) {
        bool expected = false;
        for (int k = 0; k < width * height; ++k) {
          expected = expected || boards.slow.taken(x + k % width, y + k / width);
        }
        const bool bit = (bits_at(boards.fast.row(table, y), x) & 1U) != 0;
        ASSERT_EQ(bit, expected) << domain.width << " wide, " << width << " x " << height
                                 << " cells from " << x << ", " << y;
      }
    };
    for (int level = 0; level < boards.fast.stretch_levels(); ++level) {
      expect_table(Occupancy::stretch_table(level), 1 << level, 1);
    }
    for (int level = 0; level < boards.fast.square_levels(); ++level) {
      expect_table(boards.fast.square_table(level), 1 << level, 1 << level);
    }
    for (int level = 1; level < boards.fast.square_levels(); ++level) {
      const std::uint64_t* row = boards.fast.row(boards.fast.square_table(level), y);
      for (int word = 0; word < 2 * words_for(domain.width); ++word) {
        const std::uint64_t open = bits_at(boards.fast.open_words(level, y), word) & 1U;
        ASSERT_EQ(open != 0, ~row[word] != 0) << domain.width << " wide, word " << word;
      }
    }
  }
}

TEST(InnerSquares, LieInThePieceLargestFirst) {
  Random random(15);
  int met = 0;
  for (int trial = 0; trial < 200; ++trial) {
    BitLanes cells(1 + random.below(40), 1 + random.below(150));
    for (int y = 0; y < cells.lanes; ++y) set_span(cells.lane(y), 0, cells.length);
    for (int i = random.below(40); i > 0; --i) {
      const int y = random.below(cells.lanes), x = random.below(cells.length);
      cells.lane(y)[x / kWordBits] &= ~(std::uint64_t{1} << (x % kWordBits));
    }
    const auto inside = [&](const InnerSquare& s) {
      const int side = 1 << s.level;
      if (s.x + side > cells.length || s.y + side > cells.lanes) return false;
      for (int k = 0; k < side * side; ++k) {
        if (!cells.test(s.y + k / side, s.x + k % side)) return false;
      }
      return true;
    };
    int largest = 0;
    for (int level = 1; level < 5; ++level) {
      for (int k = 0; k < cells.lanes * cells.length; ++k) {
        if (inside({level, k % cells.length, k / cells.length})) largest = level;
      }
    }
    const std::vector<InnerSquare> squares = inner_squares(cells, 5, 4);
    ASSERT_EQ(squares.empty(), largest == 0);
    if (largest > 0) {
      EXPECT_EQ(squares.front().level, largest);
    }
    EXPECT_LE(squares.size(), 4U);
    for (const InnerSquare& square : squares) {
      EXPECT_TRUE(inside(square));
      ++met;
    }
  }
  EXPECT_GT(met, 200);
}

TEST(FreeSpace, EveryVersionFindsAllFreeTranslations) {
  Random random(12);
  int free = 0, blocked = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Domain domain = random_domain(random);
    const Boards boards(random, domain);
    const bool larger = trial % 3 == 0;  // may wind around
    const Piece piece = test::random_piece(random, 1 + random.below(larger ? 2 * domain.width : 20),
                                           1 + random.below(larger ? 2 * domain.height : 8));
    if (piece.cells == 0 || !admits(domain, piece)) continue;
    const Probes probes = probes_of(piece, test::cells_of(piece), boards.fast);
    const int words = words_for(domain.width);
    const int first = random.below(words), count = 1 + random.below(words - first);
    const int rows = domain.wraps_y ? domain.height : domain.height - piece.height + 1;
    for (int y = 0; y < rows; ++y) {
      for (const FreeRowKernel kernel : free_row_kernels()) {
        std::vector<std::uint64_t> row(static_cast<std::size_t>(count) + 8, ~std::uint64_t{0});
        const bool any = kernel(boards.fast, probes.all, y, first, count, row.data());
        bool expected_any = false;
        const auto open_size = static_cast<std::size_t>(words_for(words));
        std::vector<std::uint64_t> open(open_size + 1);  // bits_at() reads one more
        const bool any_open = open_words(boards.fast, probes, y, {open.data(), open_size});
        for (int x = first * kWordBits; x < (first + count) * kWordBits; ++x) {
          const bool expected = x < domain.width && boards.slow.free(piece, x, y);
          const auto word = static_cast<std::size_t>(x / kWordBits - first);
          ASSERT_EQ(((row[word] >> (x % kWordBits)) & 1U) != 0, expected)
              << domain.width << " x " << domain.height << ", " << x << ", " << y;
          expected_any = expected_any || expected;
          if (expected) {
            ASSERT_TRUE(any_open);
            ASSERT_NE(bits_at(open.data(), x / kWordBits) & 1U, 0U);
          }
          (expected ? free : blocked) += 1;
        }
        ASSERT_EQ(any, expected_any);
      }
    }
  }
  EXPECT_GT(free, 10000);
  EXPECT_GT(blocked, 10000);
}

/// Calls check(random, domain, boards, piece) for random ones, where the domain admits the piece.
template <typename Check>
void for_random_pieces(std::uint64_t seed, int trials, Check check) {
  Random random(seed);
  for (int trial = 0; trial < trials; ++trial) {
    const Domain domain = random_domain(random);
    const Boards boards(random, domain);
    const Piece piece = test::random_piece(random, 1 + random.below(10), 1 + random.below(6));
    if (piece.cells > 0 && admits(domain, piece)) check(random, domain, boards, piece);
  }
}

TEST(FreeMap, TightTranslationsComeFirst) {
  for_random_pieces(
      13, 200, [&](Random&, const Domain& domain, const Boards& boards, const Piece& piece) {
        FreeRange range;
        range.x_end = domain.width;
        range.y_count = domain.wraps_y ? domain.height : domain.height - piece.height + 1;
        range.whole = true;
        const auto free = [&](int x, int y) {
          if (!domain.wraps_y && (y < 0 || y >= range.y_count)) return false;
          if (!domain.wraps_x && (x < 0 || x >= domain.width)) return false;
          return boards.slow.free(piece, x, y);
        };
        std::vector<std::size_t> with_blocked(5);
        std::size_t all = 0;
        for (int y = 0; y < range.y_count; ++y) {
          for (int x = 0; x < domain.width; ++x) {
            if (!free(x, y)) continue;
            const int neighbours = int(free(x - 1, y)) + int(free(x + 1, y)) + int(free(x, y - 1)) +
                                   int(free(x, y + 1));
            ++with_blocked[static_cast<std::size_t>(4 - neighbours)];
            ++all;
          }
        }
        FreeMap map;
        EXPECT_EQ(
            map.scan(boards.fast, probes_of(piece, test::cells_of(piece), boards.fast), range, 0),
            range.y_count);
        EXPECT_EQ(map.first_row() >= 0, all > 0);
        std::vector<CellShift> shifts;
        map.tightest(all + 10, shifts);
        if (all > 0 && with_blocked[0] == all) {
          ASSERT_EQ(shifts.size(), 1U);
          EXPECT_TRUE(free(shifts[0].x, shifts[0].y));
          return;
        }
        ASSERT_EQ(shifts.size(), all - with_blocked[0]);
        std::size_t i = 0;
        for (std::size_t n = 5; n-- > 1;) {
          for (std::size_t k = 0; k < with_blocked[n]; ++k, ++i) {
            const CellShift s = shifts[i];
            ASSERT_TRUE(free(s.x, s.y));
            const int neighbours = int(free(s.x - 1, s.y)) + int(free(s.x + 1, s.y)) +
                                   int(free(s.x, s.y - 1)) + int(free(s.x, s.y + 1));
            ASSERT_EQ(4 - neighbours, static_cast<int>(n));
          }
        }
      });
}

/// Of a part of the domain, as best fit settles a chart: what is beyond counts as free, but for the
/// first and the last column.
TEST(FreeMap, PartsOfTheDomainAreRankedByWhatIsInThem) {
  int ranked = 0;
  for_random_pieces(
      14, 300, [&](Random& random, const Domain& domain, const Boards& boards, const Piece& piece) {
        const int rows = domain.wraps_y ? domain.height : domain.height - piece.height + 1;
        FreeRange range;
        range.x_begin = random.below(domain.width);
        range.x_end = range.x_begin + 1 + random.below(domain.width - range.x_begin);
        range.y_begin = random.below(rows);
        range.y_count = 1 + random.below(domain.wraps_y ? rows : rows - range.y_begin);
        const auto free = [&](int x, int row) {
          if (row < 0 || row >= range.y_count) return true;
          if (x < 0 || x >= domain.width) return false;
          if (x < range.x_begin || x >= range.x_end) return true;
          return boards.slow.free(piece, x, (range.y_begin + row) % domain.height);
        };
        const auto blocked = [&](int x, int row) {
          return int(!free(x - 1, row)) + int(!free(x + 1, row)) + int(!free(x, row - 1)) +
                 int(!free(x, row + 1));
        };
        std::vector<int> expected;
        int all = 0;
        for (int row = 0; row < range.y_count; ++row) {
          for (int x = range.x_begin; x < range.x_end; ++x) {
            if (!free(x, row)) continue;
            ++all;
            if (blocked(x, row) > 0) expected.push_back(blocked(x, row));
          }
        }
        std::sort(expected.rbegin(), expected.rend());
        FreeMap map;
        const Probes probes = probes_of(piece, test::cells_of(piece), boards.fast);
        EXPECT_EQ(map.scan(boards.fast, probes, range, 0), range.y_count);
        EXPECT_EQ(map.first_row() >= 0, all > 0);
        std::vector<CellShift> shifts;
        map.tightest(static_cast<std::size_t>(all) + 10, shifts);
        if (expected.empty()) {
          ASSERT_EQ(shifts.size(), all > 0 ? 1U : 0U);
          return;
        }
        ASSERT_EQ(shifts.size(), expected.size());
        for (std::size_t i = 0; i < shifts.size(); ++i) {
          const int row = (shifts[i].y - range.y_begin + domain.height) % domain.height;
          ASSERT_TRUE(row < range.y_count && free(shifts[i].x, row));
          ASSERT_EQ(blocked(shifts[i].x, row), expected[i]);
          ++ranked;
        }
      });
  EXPECT_GT(ranked, 1000);
}

TEST(FreeMap, EndsWhereEnoughIsFound) {
  int early = 0, late = 0;
  for_random_pieces(
      15, 300, [&](Random& random, const Domain& domain, const Boards& boards, const Piece& piece) {
        FreeRange range;
        range.x_end = domain.width;
        range.y_count = domain.wraps_y ? domain.height : domain.height - piece.height + 1;
        range.whole = true;
        const Probes probes = probes_of(piece, test::cells_of(piece), boards.fast);
        const int enough = 1 + random.below(20);
        FreeMap map;
        std::vector<CellShift> shifts;
        const int rows = map.scan(boards.fast, probes, range, enough);
        map.tightest(static_cast<std::size_t>(enough), shifts);
        ASSERT_LE(rows, range.y_count);
        for (const CellShift s : shifts) {
          ASSERT_LT(s.y, rows);
          ASSERT_TRUE(boards.slow.free(piece, s.x, s.y));
        }
        if (rows < range.y_count) {
          ++early;
          ASSERT_EQ(shifts.size(), static_cast<std::size_t>(enough));
        } else {
          ++late;
        }
        // What is in front of the first row with a free translation may be left out next time.
        for (int y = 0; y < (map.first_row() < 0 ? rows : map.first_row()); ++y) {
          for (int x = 0; x < domain.width; ++x) ASSERT_FALSE(boards.slow.free(piece, x, y));
        }
      });
  EXPECT_GT(early, 50);
  EXPECT_GT(late, 20);
}

TEST(Contact, IsTheShareOfNeighbouringCellsThatAreTaken) {
  Random random(14);
  for (int trial = 0; trial < 200; ++trial) {
    const Domain domain = random_domain(random);
    const Boards boards(random, domain);
    BitLanes rows(1 + random.below(domain.height), 1 + random.below(domain.width));
    for (int y = 0; y < rows.lanes; ++y) {
      for (int x = 0; x < rows.length; ++x) {
        if (random.below(3) != 0) rows.set(y, x);
      }
    }
    rows.set(0, 0);
    const auto own = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < rows.length && y < rows.lanes && rows.test(y, x);
    };
    const int at_x = random.below(domain.width), at_y = random.below(domain.height);
    int count = 0, touching = 0;
    for (int y = -1; y <= rows.lanes; ++y) {
      for (int x = -1; x <= rows.length; ++x) {
        bool near = false;
        for (int k = 0; k < 9; ++k) near = near || own(x + k % 3 - 1, y + k / 3 - 1);
        if (!near || own(x, y)) continue;
        ++count;
        touching += boards.slow.taken(at_x + x, at_y + y) ? 1 : 0;
      }
    }
    const Ring ring = ring_of(rows);
    EXPECT_EQ(ring.count, count);
    EXPECT_DOUBLE_EQ(contact(boards.fast, ring, at_x, at_y), double(touching) / count);
  }
}

}  // namespace
}  // namespace wrapatlas
