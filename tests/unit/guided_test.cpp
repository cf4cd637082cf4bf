#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "guided/best_shift.h"
#include "guided/cover.h"
#include "guided/field.h"
#include "guided/piece.h"
#include "guided/piece_library.h"
#include "guided/random.h"
#include "support/random_piece.h"
#include "support/same_packing.h"
#include "support/shapes.h"
#include "support/soup_check.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {
namespace {

using test::random_piece;

/// Weights cell by cell.
struct SlowField {
  Domain domain;
  std::vector<int> weight;

  explicit SlowField(const Domain& d)
      : domain(d), weight(static_cast<std::size_t>(d.width * d.height)) {}
  int& at(int x, int y) {
    return weight[static_cast<std::size_t>(y % domain.height * domain.width + x % domain.width)];
  }
  void add(const Piece& piece, int x, int y, int by) {
    for (const PieceRun& run : piece.runs) {
      for (int k = run.begin; k < run.end; ++k) at(x + k, y + run.row) += by;
    }
  }
  int cost(const Piece& piece, int x, int y) {
    int sum = 0;
    for (const PieceRun& run : piece.runs) {
      for (int k = run.begin; k < run.end; ++k) {
        sum += std::min(at(x + k, y + run.row), kLargestWeight);
      }
    }
    return std::min<int>(sum, kMostCost);
  }
};

TEST(Field, CostsAreThoseOfTheCellsOnATorus) {
  Random random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Domain domain{5 + random.below(90), 5 + random.below(70), true, true};
    SlowField slow(domain);
    Field field;
    const int reach = 150;
    field.reset(domain, {0, domain.width, true}, {0, domain.height, true}, reach);
    for (int i = 0; i < 6; ++i) {
      const Piece piece = random_piece(random, 1 + random.below(100), 1 + random.below(100));
      const int x = random.below(domain.width), y = random.below(domain.height);
      const int weight = 1 + random.below(20);
      field.add(piece, x, y, weight);
      slow.add(piece, x, y, weight);
    }
    field.sum();
    const Piece moved = random_piece(random, 1 + random.below(120), 1 + random.below(120));
    for (int i = 0; i < 20; ++i) {
      const int x = random.below(domain.width), y = random.below(domain.height);
      EXPECT_EQ(cost_at(field, moved.spread, x, y), slow.cost(moved, x, y));
    }
  }
}

TEST(Field, ManyHeavyLayersDoNotOverflow) {
  Piece bar;
  bar.width = kLongestRun;
  bar.height = 1;
  bar.runs = bar.spread = {{0, 0, kLongestRun}};
  const Domain domain{200, 3, true, true};
  for (int layers = 1; layers <= 200; layers += 7) {
    SlowField slow(domain);
    Field field;
    field.reset(domain, {0, domain.width, true}, {0, domain.height, true}, kLongestRun);
    for (int i = 0; i < layers; ++i) {
      field.add(bar, 10, 1, 120);
      slow.add(bar, 10, 1, 120);
    }
    field.sum();
    for (int x = 0; x < domain.width; x += 9) {
      EXPECT_EQ(cost_at(field, bar.spread, x, 1), slow.cost(bar, x, 1)) << layers << " layers";
    }
  }
}

TEST(Field, APartOfTheDomainHasTheSameCosts) {
  Random random(2);
  for (int trial = 0; trial < 60; ++trial) {
    const bool wraps = trial % 2 == 0;
    const Domain domain{60 + random.below(50), 60 + random.below(50), wraps, wraps};
    SlowField slow(domain);
    const Stretch x{random.below(wraps ? domain.width : 20), 40, false};
    const Stretch y{random.below(wraps ? domain.height : 20), 35, false};
    Field field;
    field.reset(domain, x, y, 0);
    for (int i = 0; i < 8; ++i) {
      const Piece piece = random_piece(random, 1 + random.below(50), 1 + random.below(50));
      const int px = random.below(wraps ? domain.width : domain.width - piece.width + 1);
      const int py = random.below(wraps ? domain.height : domain.height - piece.height + 1);
      field.add(piece, px, py, 3);
      slow.add(piece, px, py, 3);
    }
    field.sum();
    const Piece moved = random_piece(random, 1 + random.below(30), 1 + random.below(30));
    for (int dx = 0; dx + moved.width <= x.count; ++dx) {
      for (int dy = 0; dy + moved.height <= y.count; ++dy) {
        ASSERT_EQ(cost_at(field, moved.spread, dx, dy),
                  slow.cost(moved, x.origin + dx, y.origin + dy));
      }
    }
  }
}

TEST(BestShift, EveryVersionFindsTheFirstLeastCost) {
  Random random(3);
  int cores = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Domain domain{20 + random.below(200), 20 + random.below(40), true, true};
    SlowField slow(domain);
    Field field;
    field.reset(domain, {0, domain.width, true}, {0, domain.height, true}, 40);
    for (int i = 0; i < 12; ++i) {
      const Piece piece = random_piece(random, 1 + random.below(30), 1 + random.below(30));
      const int x = random.below(domain.width), y = random.below(domain.height);
      field.add(piece, x, y, 8);
      slow.add(piece, x, y, 8);
    }
    field.sum();
    if (trial % 3 > 0) field.sort_by_phase();
    const Piece moved =
        random_piece(random, 1 + random.below(40), 1 + random.below(20), trial % 2 == 0 ? 6 : 60);
    cores += moved.core.empty() ? 0 : 1;
    ShiftRange range;
    range.x_begin = random.below(5);
    range.x_end = range.x_begin + 1 + random.below(domain.width - range.x_begin);
    range.y_begin = random.below(5);
    range.y_end = range.y_begin + 1 + random.below(domain.height - range.y_begin);
    range.y_start = range.y_begin + random.below(range.y_end - range.y_begin);
    const Shift limit{static_cast<std::uint16_t>(1 + random.below(2000)), -1, -1};
    Shift expected = limit;
    for (int i = 0, y = range.y_start; i < range.y_end - range.y_begin; ++i, ++y) {
      if (y == range.y_end) y = range.y_begin;
      for (int x = range.x_begin; x < range.x_end; ++x) {
        const int cost = slow.cost(moved, x, y);
        if (cost < expected.cost) expected = {static_cast<std::uint16_t>(cost), x, y};
      }
    }
    for (const BestShiftKernel kernel : best_shift_kernels()) {
      Shift best = limit;
      kernel(field, moved, range, best);
      EXPECT_EQ(best.cost, expected.cost);
      EXPECT_EQ(best.x, expected.x);
      EXPECT_EQ(best.y, expected.y);
    }
  }
  EXPECT_GT(cores, 50);
}

TEST(Piece, TheCoreIsCoveredAllOverABlock) {
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    const Piece piece = random_piece(random, 1 + random.below(200), 1 + random.below(30), 90);
    const BitLanes cells = test::cells_of(piece);
    for (const PieceRun& run : piece.core) {
      ASSERT_LE(run.end - run.begin, kLongestRun);
      for (int x = run.begin; x < run.end; ++x) {
        for (int k = 0; k < kBlock * kBlock; ++k) {
          const int column = x - k % kBlock, row = run.row - k / kBlock;
          ASSERT_TRUE(column >= 0 && row >= 0 && cells.test(row, column));
        }
      }
    }
  }
}

TEST(Cover, SharedCellsAreCounted) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Domain domain{10 + random.below(150), 10 + random.below(60), true, true};
    SlowField both(domain);
    Cover covers[2];
    for (Cover& cover : covers) {
      const Piece piece =
          random_piece(random, 1 + random.below(domain.width), 1 + random.below(domain.height));
      const int x = random.below(domain.width), y = random.below(domain.height);
      cover.set(domain, piece, x, y);
      both.add(piece, x, y, 1);
    }
    const auto expected = std::count(both.weight.begin(), both.weight.end(), 2);
    EXPECT_EQ(Cover::shared(covers[0], covers[1]), expected);
    EXPECT_EQ(Cover::shared(covers[1], covers[0]), expected);
  }
}

TEST(Piece, AdmittedIfNoCellIsCoveredTwice) {
  Random random(5);
  int admitted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Domain domain{8 + random.below(30), 8 + random.below(30), random.below(2) == 0,
                        random.below(2) == 0};
    Piece piece = random_piece(random, 1 + random.below(40), 1 + random.below(40));
    if (trial % 2 == 0) {  // a thin diagonal, which may wind around without meeting itself
      piece.runs.clear();
      piece.width = piece.height;
      for (int y = 0; y < piece.height; ++y) piece.runs.push_back({y, y, y + 1});
    }
    bool expected = (domain.wraps_x || piece.width <= domain.width) &&
                    (domain.wraps_y || piece.height <= domain.height);
    SlowField cells(domain);
    cells.add(piece, 0, 0, 1);
    if (*std::max_element(cells.weight.begin(), cells.weight.end()) > 1) expected = false;
    EXPECT_EQ(admits(domain, piece), expected);
    admitted += expected ? 1 : 0;
  }
  EXPECT_GT(admitted, 50);
  EXPECT_LT(admitted, 250);
}

PackOptions guided_options() {
  PackOptions options;
  options.method = Method::guided;
  options.width = options.height = 256;
  options.time = 0;
  return options;
}

TEST(Guided, MovesGiveTheSameBitsForAnyNumberOfThreads) {
  for (const int count : {10, 50}) {
    const std::vector<Chart> charts = test::mixed_charts(7, count);
    PackOptions options = guided_options();
    options.moves = 40 * count;
    options.threads = 1;
    const auto one = pack(charts, options);
    options.threads = 3;
    const auto three = pack(charts, options);
    ASSERT_TRUE(one && three);
    test::expect_same(*one, *three);
  }
}

TEST(Guided, IsDenserThanModulo) {
  double guided = 0, modulo = 0;
  for (std::uint64_t seed = 30; seed < 34; ++seed) {
    const std::vector<Chart> charts = test::mixed_charts(seed, 12);
    PackOptions options = guided_options();
    guided += pack(charts, options)->efficiency;
    options.method = Method::modulo;
    modulo += pack(charts, options)->efficiency;
  }
  EXPECT_GT(guided, modulo * 1.1);
}

TEST(Guided, WithoutWrapNoOlderPackerIsDenserHoweverShortTheSearch) {
  int denser = 0;  // than modulo
  for (std::uint64_t seed = 40; seed < 52; ++seed) {
    const std::vector<Chart> charts = test::mixed_charts(seed, 7);
    PackOptions options = guided_options();
    options.wrap = Wrap::none;
    options.moves = 1;
    const double guided = pack(charts, options)->efficiency;
    options.method = Method::modulo;
    const double modulo = pack(charts, options)->efficiency;
    for (const Method method : {Method::swg03, Method::zsgs04}) {
      options.method = method;
      const double older = pack(charts, options)->efficiency;
      EXPECT_GE(guided, older);
      denser += older > modulo ? 1 : 0;
    }
    EXPECT_GE(guided, modulo);
  }
  EXPECT_GT(denser, 0);
}

TEST(Guided, ManyChartsArePackedByBestFit) {
  const std::vector<Chart> charts = test::mixed_charts(1, 260);
  for (const Wrap wrap : {Wrap::uv, Wrap::u, Wrap::none}) {
    PackOptions options = guided_options();
    options.width = 500;
    options.height = 300;
    options.padding = 1.5;
    options.wrap = wrap;
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    EXPECT_EQ(test::check_packing(charts, *packing, options), "");
    options.method = Method::modulo;
    EXPECT_GT(packing->efficiency, 1.1 * pack(charts, options)->efficiency);
    options.method = Method::guided;
    options.threads = 1;
    const auto alone = pack(charts, options);
    ASSERT_TRUE(alone);
    test::expect_same(*alone, *packing);
  }
}

TEST(Guided, SearchesTheAspect) {
  const std::vector<Chart> charts{test::rectangle(4, 1)};  // fills an atlas of 4 x 1
  PackOptions options = guided_options();
  options.padding = 0;
  options.wrap = Wrap::none;  // around a torus it winds
  const double square = pack(charts, options)->efficiency;
  for (const Aspect aspect : {Aspect::search, Aspect::pow2}) {
    options.aspect = aspect;
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    EXPECT_EQ(test::check_packing(charts, *packing, options), "");
    EXPECT_GT(packing->efficiency, square + 0.6);
    EXPECT_NEAR(double(packing->width) * packing->height, 256.0 * 256, 1200);
  }
}

TEST(Guided, StopsWithTheBestSoFar) {
  PackOptions options = guided_options();
  options.time = 1000;
  double seen = 0;
  options.progress = [&seen](const Progress& progress) {
    seen = progress.best_efficiency;
    return seen == 0;
  };
  const auto packing = pack(test::mixed_charts(3, 8), options);
  ASSERT_TRUE(packing) << packing.error().message();
  EXPECT_TRUE(packing->interrupted);
  EXPECT_GE(packing->efficiency, seen);
}

TEST(Guided, IsToldToStopOnce) {
  for (const Wrap wrap : {Wrap::uv, Wrap::none}) {
    for (const int last : {1, 2, 3, 4}) {
      PackOptions options = guided_options();
      options.wrap = wrap;
      options.time = 1000;
      int asked = 0;
      double seen = 0;
      options.progress = [&](const Progress& progress) {
        EXPECT_LT(asked, last) << "once more than it was told to stop";
        EXPECT_GE(progress.best_efficiency, seen);
        seen = progress.best_efficiency;
        return ++asked < last;
      };
      const auto packing = pack(test::mixed_charts(3, 8), options);
      EXPECT_EQ(asked, last);
      if (packing) {
        EXPECT_TRUE(packing->interrupted);
        EXPECT_GE(packing->efficiency, seen);
      } else {
        EXPECT_EQ(packing.error().kind, ErrorKind::interrupted);
        EXPECT_EQ(seen, 0);
      }
    }
  }
}

/// If nothing lay inside the rings, no more than `area / apart` could be in use.
TEST(Guided, ThinRingsHaveOthersInside) {
  PackOptions options = guided_options();
  options.padding = 0;
  for (const int squares : {20, 50, 220}) {
    std::vector<Chart> charts(3, test::arc(1, 0.01, 6.2, 64));
    const double side = std::sqrt(1.9 / squares);
    charts.resize(charts.size() + static_cast<std::size_t>(squares), test::rectangle(side, side));
    double area = 0, apart = 0;
    for (const ChartShape& shape : make_shapes(charts)) {
      area += shape.area;
      apart += shape.extent;
    }
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    EXPECT_EQ(test::check_packing(charts, *packing, options), "");
    EXPECT_GT(packing->efficiency, area / apart) << squares;
  }
}

/// Of a needle, less than a cell of a coarse grid wide, there is nothing to be seen at some angles.
TEST(Guided, NeedlesArePacked) {
  std::vector<Chart> charts = test::mixed_charts(2, 6);
  double side = 0;
  for (const Chart& chart : charts) side = std::max(side, length(chart.box.size()));
  for (const double width : {1e-2, 1e-3, 1e-4}) {
    charts.push_back(test::rectangle(0.7 * side, width * side));
    charts.push_back(test::rectangle(width * side, 0.4 * side));
  }
  // A body with a tail.
  charts.push_back(*chart_from_loops(std::vector<std::vector<Vec2>>{{{0, 0},
                                                                     {0.2 * side, 0},
                                                                     {0.2 * side, 0.001 * side},
                                                                     {0.8 * side, 0.0012 * side},
                                                                     {0.2 * side, 0.0014 * side},
                                                                     {0.2 * side, 0.2 * side},
                                                                     {0, 0.2 * side}}}));
  for (const Wrap wrap : {Wrap::uv, Wrap::v, Wrap::none}) {
    PackOptions options = guided_options();
    options.wrap = wrap;
    options.moves = 300;
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    EXPECT_EQ(test::check_packing(charts, *packing, options), "");
  }
}

TEST(Guided, AVeryLongChartIsSeparatedToo) {
  const std::vector<Chart> charts{test::rectangle(40, 1), test::rectangle(3, 1)};
  for (const Wrap wrap : {Wrap::uv, Wrap::none}) {
    PackOptions options = guided_options();
    options.wrap = wrap;
    options.method = Method::modulo;
    const double modulo = pack(charts, options)->efficiency;
    options.method = Method::guided;
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    EXPECT_EQ(test::check_packing(charts, *packing, options), "");
    EXPECT_GT(packing->efficiency, modulo);
  }
}

/// It winds around the torus, at an angle at which it does not lie on itself.
TEST(Guided, ALongStripFillsTheTorus) {
  const std::vector<Chart> charts{test::rectangle(40, 1), test::rectangle(3, 1)};
  for (const int side : {256, 1024}) {
    PackOptions options = guided_options();
    options.width = options.height = side;
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    EXPECT_EQ(test::check_packing(charts, *packing, options), "");
    EXPECT_GT(packing->efficiency, 0.6);
  }
}

TEST(Guided, GivesUpOnWhatNoDomainHolds) {
  const std::vector<Chart> charts{test::rectangle(2000, 1), test::rectangle(3, 1)};
  PackOptions options = guided_options();
  options.wrap = Wrap::none;
  const auto packing = pack(charts, options);
  ASSERT_TRUE(packing) << packing.error().message();
  EXPECT_EQ(test::check_packing(charts, *packing, options), "");
}

}  // namespace
}  // namespace wrapatlas
