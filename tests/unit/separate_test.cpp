// Separation and the search on shrinking domains, against a look at every cell.
#include "guided/separate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "guided/coarse.h"
#include "support/shapes.h"

namespace wrapatlas {
namespace {

std::vector<ChartShape> random_shapes(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  std::vector<Chart> charts;
  for (int i = 0; i < count; ++i) {
    const double size = test::uniform(random, 0.3, 1);
    charts.push_back(i % 3 == 0 ? test::arc(size, size / 4, 4, 12)
                                : test::star(random, 9, size / 3, size));
  }
  return make_shapes(charts);
}

RasterScale cells(double per_unit) {
  RasterScale scale;
  scale.cells_per_unit = {per_unit, per_unit};
  scale.coverage = Coverage::center;
  return scale;
}

/// Pairs of charts on a cell, summed over all cells; and the cells of charts out of the domain.
std::int64_t overlap(PieceLibrary& library, const Domain& domain,
                     const std::vector<Place>& places) {
  std::vector<int> on(static_cast<std::size_t>(domain.width * domain.height));
  std::int64_t outside = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const PieceRun& run : library.piece(i, places[i].angle).runs) {
      for (int k = run.begin; k < run.end; ++k) {
        int x = places[i].x + k, y = places[i].y + run.row;
        if (domain.wraps_x) x %= domain.width;
        if (domain.wraps_y) y %= domain.height;
        if (x < 0 || x >= domain.width || y < 0 || y >= domain.height) {
          ++outside;
          continue;
        }
        ++on[static_cast<std::size_t>(y * domain.width + x)];
      }
    }
  }
  std::int64_t pairs = outside;
  for (const int count : on) pairs += std::int64_t{count} * (count - 1) / 2;
  return pairs;
}

/// Does any way of steps from cell to cell, across corners too, lead out of the piece's middle?
bool leads_out(const Piece& piece) {
  const int width = piece.width + 2, height = piece.height + 2;
  std::vector<char> closed(static_cast<std::size_t>(width * height));
  for (const PieceRun& run : piece.runs) {
    const auto row = closed.begin() + (run.row + 1) * width + 1;
    std::fill(row + run.begin, row + run.end, 1);
  }
  std::vector<std::pair<int, int>> next{{width / 2, height / 2}};
  while (!next.empty()) {
    const auto [x, y] = next.back();
    next.pop_back();
    if (x < 0 || y < 0 || x >= width || y >= height) return true;
    char& here = closed[static_cast<std::size_t>(y * width + x)];
    if (here != 0) continue;
    here = 1;
    for (int step = 0; step < 9; ++step) next.emplace_back(x + step % 3 - 1, y + step / 3 - 1);
  }
  return false;
}

Domain with_wrap(int side, int wrap) { return {side, side, (wrap & 1) != 0, (wrap & 2) != 0}; }

TEST(PieceLibrary, NothingSlipsThroughThinCharts) {
  std::vector<std::vector<Vec2>> loops(2);
  for (int i = 0; i < 60; ++i) {
    const double turn = 2 * 3.14159265358979 * i / 60;
    loops[0].push_back({std::cos(turn), std::sin(turn)});
    loops[1].push_back({0.999 * std::cos(turn), -0.999 * std::sin(turn)});
  }
  const std::vector<ChartShape> shapes = make_shapes(std::vector<Chart>{*chart_from_loops(loops)});
  EXPECT_NEAR(shapes[0].thickness, 0.001, 1e-5);
  PieceOptions options;
  options.least_thickness = 1.5;
  PieceLibrary as_it_is(shapes, cells(20), 64, 400), grown(shapes, cells(20), 64, 400, options);
  for (int angle = 0; angle < 64; ++angle) {
    EXPECT_TRUE(leads_out(as_it_is.piece(0, angle)));
    EXPECT_FALSE(leads_out(grown.piece(0, angle))) << angle;
    EXPECT_LE(grown.piece(0, angle).width, grown.reach(0));
  }
}

/// The cells of runs, in order.
std::vector<std::pair<int, int>> cells_of(const std::vector<PieceRun>& runs) {
  std::vector<std::pair<int, int>> cells;
  for (const PieceRun& run : runs) {
    for (int x = run.begin; x < run.end; ++x) cells.emplace_back(run.row, x);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

TEST(PieceLibrary, SpreadRunsAreTheSameCellsWithCoresAndWithout) {
  const std::vector<ChartShape> shapes = random_shapes(3, 8);
  PieceOptions options;
  options.cores = false;
  PieceLibrary with(shapes, cells(200), 64, 4000), without(shapes, cells(200), 64, 4000, options);
  for (std::size_t chart = 0; chart < shapes.size(); ++chart) {
    for (int angle = 0; angle < 64; angle += 7) {
      const Piece& piece = with.piece(chart, angle);
      EXPECT_FALSE(piece.core.empty());
      EXPECT_TRUE(without.piece(chart, angle).core.empty());
      ASSERT_EQ(cells_of(piece.spread), cells_of(piece.runs));
      ASSERT_EQ(cells_of(without.piece(chart, angle).spread), cells_of(piece.runs));
    }
  }
}

TEST(PieceLibrary, AGrownChartCoversMore) {
  const auto shapes = make_shapes(std::vector<Chart>(2, test::rectangle(1, 0.5)));
  PieceLibrary library(shapes, cells(40), 16, 1000);
  const std::int64_t before = library.piece(0, 0).cells, other = library.piece(1, 0).cells;
  const int reach = library.reach(0);
  EXPECT_EQ(library.growth(0), 0);
  library.set_growth(0, 2);
  EXPECT_EQ(library.growth(0), 2);
  // Two cells wider to each side, round at the corners.
  EXPECT_GT(library.piece(0, 0).cells, before + 2 * 2 * (40 + 20));
  EXPECT_LE(library.piece(0, 0).cells, 44 * 24);
  EXPECT_EQ(library.reach(0), reach + 4);
  EXPECT_EQ(library.piece(1, 0).cells, other);
}

TEST(Separator, LeavesTheOverlapItSays) {
  const auto shapes = random_shapes(1, 11);
  PieceLibrary library(shapes, cells(12), 64, 400);
  int separated = 0, stuck = 0;
  for (int trial = 0; trial < 48; ++trial) {
    const Domain domain = with_wrap(25 + trial / 4, trial);
    Random random(static_cast<std::uint64_t>(trial));
    std::vector<Place> places(shapes.size());
    for (Place& place : places) place.angle = random.below(64);
    Effort effort(nullptr);
    SeparateOptions options;
    options.stall_rounds = 8;
    options.window = trial % 3 == 0 ? 10 : 0;
    Separator separator(library, domain, random);
    const bool done = separator.run(places, options, effort);
    const std::int64_t left = overlap(library, domain, places);
    EXPECT_EQ(separator.least(), left);
    EXPECT_EQ(done, left == 0);
    ++(done ? separated : stuck);
  }
  EXPECT_GT(separated, 10);
  EXPECT_GT(stuck, 10);
}

TEST(Separator, ARunThatIsStoppedGivesTheBestSoFar) {
  const auto shapes = random_shapes(2, 9);
  PieceLibrary library(shapes, cells(20), 64, 400);
  const Domain domain = with_wrap(50, 3);
  Random random(5);
  std::vector<Place> places(shapes.size());
  const std::int64_t before = overlap(library, domain, places);
  Effort effort(nullptr);
  effort.moves(40);
  SeparateOptions options;
  Separator separator(library, domain, random);
  EXPECT_FALSE(separator.run(places, options, effort));
  EXPECT_EQ(effort.moves_made(), 40);
  EXPECT_LT(overlap(library, domain, places), before);
  EXPECT_EQ(separator.least(), overlap(library, domain, places));
}

/// The layout of a search drawn again: on a grid eight times as fine, where hardly a cell is
/// shared.
double overlapping_share(std::span<const ChartShape> shapes, const Layout& layout, Vec2 lengths,
                         int wrap) {
  constexpr double kFine = 8;
  const Domain domain{static_cast<int>(std::lround(kFine * lengths.x)),
                      static_cast<int>(std::lround(kFine * lengths.y)), (wrap & 1) != 0,
                      (wrap & 2) != 0};
  PieceLibrary library(shapes, cells(kFine * layout.scale), kAngleSteps,
                       4 * std::max(domain.width, domain.height));
  const auto places = to_places(layout, library, domain);
  return static_cast<double>(overlap(library, domain, places)) / domain.width / domain.height;
}

TEST(CoarseSearch, ItsBestLayoutIsOneAndGetsNoWorse) {
  const auto shapes = random_shapes(3, 8);
  for (int wrap = 0; wrap < 4; ++wrap) {
    const Vec2 lengths = wrap == 1 ? Vec2{100, 50} : Vec2{70, 70};
    CoarseOptions options;
    options.side = 96;
    CoarseSearch search(shapes, lengths, (wrap & 1) != 0, (wrap & 2) != 0, options, 7);
    EXPECT_FALSE(search.found());
    double last = 0;
    for (const int moves : {300, 1000, 2000}) {
      Effort effort(nullptr);
      effort.moves(moves);
      search.run(effort, false);
      ASSERT_TRUE(search.found());
      EXPECT_GE(search.efficiency(), last);
      last = search.efficiency();
      const Layout layout = search.best().on(lengths);
      EXPECT_NEAR(layout.scale * layout.scale * total_area(shapes), last * lengths.x * lengths.y,
                  1e-6 * lengths.x * lengths.y);
      ASSERT_EQ(layout.spots.size(), shapes.size());
      EXPECT_LT(overlapping_share(shapes, layout, lengths, wrap), 0.01);
    }
    EXPECT_GT(last, 0.5);
    CoarseSearch other(shapes, lengths, (wrap & 1) != 0, (wrap & 2) != 0, options, 8);
    other.adopt(search);
    EXPECT_EQ(other.efficiency(), last);
    Effort effort(nullptr);
    effort.moves(1000);
    other.run(effort, false);
    EXPECT_GE(other.efficiency(), last);
  }
}

TEST(CoarseSearch, WhatCameNearIsDenserAndOverlapsLittle) {
  const auto shapes = random_shapes(3, 8);
  const Vec2 lengths{70, 70};
  CoarseSearch search(shapes, lengths, true, true, {.side = 96}, 7);
  std::size_t all = 0;
  for (int i = 0; i < 5; ++i) {
    Effort effort(nullptr);
    effort.moves(3000);
    search.run(effort, false);
    ASSERT_TRUE(search.found());
    const auto finds = search.near(2);
    ASSERT_LE(finds.size(), 2);
    for (const CoarseFind& find : finds) {
      EXPECT_GT(find.layout.scale, search.best().layout.scale);
      EXPECT_LT(overlapping_share(shapes, find.on(lengths), lengths, 3), 0.01);
    }
    all += finds.size();
  }
  EXPECT_GT(all, 2);
}

TEST(CoarseSearch, LeavesRoomAroundChartsThatHeldEachOther) {
  const auto shapes = random_shapes(3, 8);
  const Vec2 lengths{70, 70};
  CoarseSearch search(shapes, lengths, true, true, {.side = 96}, 7);
  const auto run = [&] {
    Effort effort(nullptr);
    effort.moves(6000);
    search.run(effort, false);
  };
  run();
  ASSERT_TRUE(search.found());
  const double before = search.efficiency();
  const std::vector<std::size_t> all{0, 1, 2, 3, 4, 5, 6, 7}, first{0};
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(search.enlarge(all));
  EXPECT_FALSE(search.found());
  run();
  ASSERT_TRUE(search.found());
  EXPECT_LT(search.efficiency(), before);
  Layout layout = search.best().on(lengths);
  EXPECT_EQ(overlapping_share(shapes, layout, lengths, 3), 0);
  layout.scale *= 1.02;  // as there is room to each side
  EXPECT_EQ(overlapping_share(shapes, layout, lengths, 3), 0);
  CoarseSearch other(shapes, lengths, true, true, {.side = 96}, 8);
  other.adopt(search);
  EXPECT_EQ(other.efficiency(), search.efficiency());
  Effort effort(nullptr);
  effort.moves(1000);
  other.run(effort, false);  // as large as in the other search
  layout = other.best().on(lengths);
  layout.scale *= 1.02;
  EXPECT_EQ(overlapping_share(shapes, layout, lengths, 3), 0);
  EXPECT_TRUE(search.enlarge(first));
  EXPECT_TRUE(search.enlarge(first));
  EXPECT_FALSE(search.enlarge(first));  // six times in all
}

/// Two bars fill a domain of 2:1 between them, and half a square.
TEST(CoarseSearch, LeavesTheShapeItBeganWithWhereThatIsBetter) {
  const auto shapes = make_shapes(std::vector<Chart>(2, test::rectangle(1, 0.25)));
  double efficiency[2];
  for (const bool any : {false, true}) {
    CoarseOptions options;
    options.side = 64;
    options.any_shape = any;
    CoarseSearch search(shapes, {70, 70}, false, false, options, 1);
    Effort effort(nullptr);
    effort.moves(10000);
    search.run(effort, false);
    ASSERT_TRUE(search.found());
    efficiency[any ? 1 : 0] = search.efficiency();
    const double aspect = search.best().aspect;
    EXPECT_LT(std::abs(std::log(aspect)), any ? 2.1 : 0.03);
    const Vec2 lengths{70 * std::sqrt(aspect), 70 / std::sqrt(aspect)};
    const Layout layout = search.best().on(lengths);
    EXPECT_NEAR(layout.scale * layout.scale * total_area(shapes), search.efficiency() * 4900, 1);
    EXPECT_LT(overlapping_share(shapes, layout, lengths, 0), 0.01);
  }
  EXPECT_LT(efficiency[0], 0.6);
  EXPECT_GT(efficiency[1], 0.95);
}

TEST(CoarseSearch, OfOneChartMovesComeToAnEnd) {
  const auto shapes = make_shapes(std::vector<Chart>{test::rectangle(1, 0.2)});
  for (const bool wraps : {false, true}) {
    CoarseSearch search(shapes, {64, 64}, wraps, wraps, {.side = 48}, 1);
    Effort effort(nullptr);
    effort.moves(300);
    search.run(effort, false);
    EXPECT_TRUE(search.found());
  }
}

}  // namespace
}  // namespace wrapatlas
