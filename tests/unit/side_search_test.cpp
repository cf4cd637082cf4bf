// The search for the smallest square, on packings that are a formula.
#include "pack/side_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "support/shapes.h"

namespace wrapatlas {
namespace {

struct Found {
  int side = 0, packings = 0, most = 0;
};

Found search(double first, const std::function<double(int side, bool is_quick)>& scale_at) {
  SideSearch search(first);
  Found found;
  for (bool goes_on = true; goes_on; ++found.packings) {
    EXPECT_EQ(search.side() % 4, 0);
    EXPECT_GT(search.side(), 0);
    EXPECT_LE(search.side(), SideSearch::kMost);
    found.most = std::max(found.most, search.side());
    goes_on = search.go_on(scale_at(search.side(), search.is_quick()));
    if (found.packings == 100) break;
  }
  found.side = search.enough();
  return found;
}

/// Squares of that size in a grid, with padding: the scale at a side.
struct Squares {
  int count;
  double size, padding;

  [[nodiscard]] double scale(double side) const {
    const double scale = (side * std::sqrt(0.8 / count) - padding) / size;
    return scale < 1e-3 ? 0 : scale;
  }
  [[nodiscard]] double least_side() const { return (size + padding) / std::sqrt(0.8 / count); }
  [[nodiscard]] double first_side() const { return std::sqrt(count / 0.75) * size; }
};

TEST(SideSearch, FindsTheSmallestWhateverThePadding) {
  for (const int count : {1, 10, 300, 10000, 20000}) {
    for (const double size : {3.0, 5.0, 60.0, 1000.0}) {
      for (const double padding : {0.0, 4.0, 16.0}) {
        const Squares squares{count, size, padding};
        const double least = squares.least_side();
        const Found found =
            search(squares.first_side(), [&](int side, bool) { return squares.scale(side); });
        SCOPED_TRACE(std::to_string(count) + " of " + std::to_string(size) + ", padding " +
                     std::to_string(padding));
        if (least > SideSearch::kMost) {
          EXPECT_EQ(found.side, 0);
          continue;
        }
        EXPECT_GE(found.side, least);
        EXPECT_LE(found.side, 1.012 * least + 8);
        EXPECT_LE(found.packings, 10);
        EXPECT_LE(found.most, std::max(2 * least, squares.first_side()) + 8);
      }
    }
  }
}

TEST(SideSearch, KeepsTheSmallestThatWasEnoughWherePackingsScatter) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const Squares squares{200, test::uniform(random, 20, 200), 4};
    int least = 0;
    const Found found = search(squares.first_side(), [&](int side, bool is_quick) {
      const double scale =
          squares.scale(side) * test::uniform(random, 0.95, 1.03) * (is_quick ? 0.99 : 1);
      if (scale >= 1 && (least == 0 || side < least)) least = side;
      return scale;
    });
    ASSERT_GT(found.side, 0);
    EXPECT_EQ(found.side, least);
    EXPECT_LE(found.packings, 12);
    EXPECT_LE(found.side, 1.1 * squares.least_side());
  }
}

TEST(SideSearch, GivesUpWhereNoneIsEnough) {
  for (const double first : {1e-9, 1000.0, 16384.0, 1e10, 1e30}) {
    int last = 0;
    const auto never = [&](int side, bool) {
      last = side;
      return side < 3000 ? 0.0 : 0.5;
    };
    EXPECT_EQ(search(first, never).side, 0);
    EXPECT_EQ(last, SideSearch::kMost);
    EXPECT_EQ(search(first, [](int, bool) { return 0.0; }).side, 0);
    const Found at_the_end =
        search(first, [](int side, bool) { return side == SideSearch::kMost ? 1.0005 : 0.9; });
    EXPECT_EQ(at_the_end.side, SideSearch::kMost);
  }
  EXPECT_EQ(search(100, [](int, bool) { return 1e9; }).side, 4);
}

}  // namespace
}  // namespace wrapatlas
