#include "raster/chart_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "support/shapes.h"

namespace wrapatlas {
namespace {

using test::uniform;

double point_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 ab = b - a;
  const double norm = dot(ab, ab);
  const double t = norm > 0 ? std::clamp(dot(p - a, ab) / norm, 0.0, 1.0) : 0;
  return length(p - (a + t * ab));
}

bool segments_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double p = signed_area2(a, b, c), q = signed_area2(a, b, d);
  const double r = signed_area2(c, d, a), s = signed_area2(c, d, b);
  return p * q < 0 && r * s < 0;
}

bool inside(Vec2 p, const std::array<Vec2, 3>& t) {
  const double a = signed_area2(t[0], t[1], p), b = signed_area2(t[1], t[2], p),
               c = signed_area2(t[2], t[0], p);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/// Distance between convex polygons by all pairs of corners and sides: slow and obvious.
template <std::size_t N, std::size_t M>
double polygon_distance(const std::array<Vec2, N>& p, const std::array<Vec2, M>& q) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < M; ++j) {
      const Vec2 a = p[i], b = p[(i + 1) % N], c = q[j], d = q[(j + 1) % M];
      if (segments_cross(a, b, c, d)) return 0;
      least = std::min({least, point_to_segment(a, c, d), point_to_segment(c, a, b)});
    }
  }
  return least;
}

double cell_to_triangle(int x, int y, const std::array<Vec2, 3>& t) {
  const std::array<Vec2, 4> cell{Vec2{double(x), double(y)}, Vec2{x + 1.0, double(y)},
                                 Vec2{x + 1.0, y + 1.0}, Vec2{double(x), y + 1.0}};
  for (const Vec2 p : cell) {
    if (inside(p, t)) return 0;
  }
  for (const Vec2 p : t) {
    if (p.x >= x && p.x <= x + 1 && p.y >= y && p.y <= y + 1) return 0;
  }
  return polygon_distance(cell, t);
}

/// The definition of both coverages, cell by cell and triangle by triangle. Cells whose answer
/// hangs on rounding are left undecided (-1).
int oracle(const std::vector<std::array<Vec2, 3>>& triangles, Coverage coverage, double growth,
           int x, int y) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : triangles) {
    if (coverage == Coverage::conservative) {
      least = std::min(least, cell_to_triangle(x, y, t));
    } else {
      const Vec2 centre{x + 0.5, y + 0.5};
      const double d =
          std::min({point_to_segment(centre, t[0], t[1]), point_to_segment(centre, t[1], t[2]),
                    point_to_segment(centre, t[2], t[0])});
      if (d < 1e-9 && growth == 0) return -1;
      least = std::min(least, inside(centre, t) && signed_area2(t[0], t[1], t[2]) != 0 ? 0 : d);
    }
  }
  if (growth > 0 && std::abs(least - growth) < 1e-9) return -1;
  return growth > 0 ? least < growth : least == 0;
}

void check_horizons(const Silhouette& view, const BitLanes& cells) {
  EXPECT_EQ(view.lanes, cells.lanes);
  EXPECT_EQ(view.length, cells.length);
  std::int32_t hollow = 0, filled = 0, sum_first = 0, sum_last = 0;
  for (int lane = 0; lane < cells.lanes; ++lane) {
    int first = -1, last = -1, count = 0;
    for (int i = 0; i < cells.length; ++i) {
      if (!cells.test(lane, i)) continue;
      if (first < 0) first = i;
      last = i;
      ++count;
    }
    const auto k = static_cast<std::size_t>(lane);
    if (first < 0) {
      EXPECT_GT(view.first()[k], view.last()[k]);
      continue;
    }
    EXPECT_EQ(view.first()[k], first);
    EXPECT_EQ(view.last()[k], last);
    hollow += last - first + 1 - count;
    ++filled;
    sum_first += first;
    sum_last += last;
  }
  std::int32_t in_runs = 0, previous_end = -1;
  for (const Silhouette::LaneRun run : view.filled()) {
    EXPECT_GT(run.begin, previous_end);
    previous_end = run.end;
    in_runs += run.end - run.begin;
    for (std::int32_t lane = run.begin; lane < run.end; ++lane) {
      EXPECT_LE(view.first()[static_cast<std::size_t>(lane)],
                view.last()[static_cast<std::size_t>(lane)]);
    }
  }
  EXPECT_EQ(in_runs, filled);
  EXPECT_EQ(view.hollow, hollow);
  EXPECT_EQ(view.filled_lanes, filled);
  EXPECT_EQ(view.sum_first, sum_first);
  EXPECT_EQ(view.sum_last, sum_last);
}

void compare_with_oracle(const Chart& chart, const RasterScale& scale, const ChartRaster& raster);

/// The raster at an angle, and its three quarter turns.
void compare_with_oracle(const Chart& chart, const RasterScale& scale, double angle) {
  ChartRaster raster = rasterize(make_raster_shape(chart), scale, angle);
  raster.angle = angle;
  compare_with_oracle(chart, scale, raster);
  for (int turn = 1; turn < 4 && scale.cells_per_unit.x == scale.cells_per_unit.y; ++turn) {
    raster = quarter_turned(raster);
    raster.angle = angle + turn * std::numbers::pi / 2;
    compare_with_oracle(chart, scale, raster);
  }
}

void compare_with_oracle(const Chart& chart, const RasterScale& scale, const ChartRaster& raster) {
  const double angle = raster.angle;
  std::vector<std::array<Vec2, 3>> triangles;
  for (const auto& t : chart.triangles) {
    std::array<Vec2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 p = chart.points[t[i]];
      corners[i] = Vec2{(std::cos(angle) * p.x - std::sin(angle) * p.y) * scale.cells_per_unit.x,
                        (std::sin(angle) * p.x + std::cos(angle) * p.y) * scale.cells_per_unit.y} +
                   raster.offset;
    }
    triangles.push_back(corners);
  }
  const CellViews cells = cells_of(raster);
  int covered = 0;
  for (int y = -1; y <= raster.height; ++y) {
    for (int x = -1; x <= raster.width; ++x) {
      const bool within = x >= 0 && y >= 0 && x < raster.width && y < raster.height;
      const int expected = oracle(triangles, scale.coverage, scale.growth, x, y);
      const bool got = within && cells.rows.test(y, x);
      if (within) {
        ASSERT_EQ(cells.columns.test(x, y), got) << "views differ at " << x << "," << y;
      }
      covered += got;
      // The grown box touches the sides of its outermost cells: outside of them nothing is meant.
      if (within && expected >= 0) {
        ASSERT_EQ(got, expected == 1) << "cell " << x << "," << y;
      }
      if (!within && (scale.growth > 0 || scale.coverage == Coverage::center) && raster.cells > 1) {
        ASSERT_NE(expected, 1) << "cell " << x << "," << y;
      }
    }
  }
  EXPECT_EQ(raster.cells, covered);
  check_horizons(raster.columns, cells.columns);
  check_horizons(raster.rows, cells.rows);
}

class RasterOracle : public ::testing::TestWithParam<Coverage> {};

TEST_P(RasterOracle, RandomStarsAndArcs) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 60; ++i) {
    const Chart chart =
        i % 2 == 0 ? test::star(random, 4 + i % 17, 0.2, 1)
                   : test::arc(1, uniform(random, 0.01, 0.5), uniform(random, 0.5, 6.2), 30);
    const double size = uniform(random, 1, 24);
    const double growth = i % 3 == 0 ? 0 : uniform(random, 0.05, 2.5);
    const RasterScale scale{{size, size * uniform(random, 0.95, 1.05)}, growth, GetParam()};
    compare_with_oracle(chart, scale, uniform(random, -7, 7));
    if (HasFatalFailure()) FAIL() << "round " << i;
  }
}

TEST_P(RasterOracle, RandomSoupsOfBothWindings) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 40; ++i) {
    const Chart chart = test::soup(random, 8, 2 + i % 9);
    const double size = uniform(random, 2, 20);
    const RasterScale scale{{size, size}, i % 2 == 0 ? 0 : uniform(random, 0.05, 1.5), GetParam()};
    compare_with_oracle(chart, scale, uniform(random, -7, 7));
    if (HasFatalFailure()) FAIL() << "round " << i;
  }
}

TEST_P(RasterOracle, WiderThanAWord) {
  std::mt19937_64 random(3);
  const Chart chart = test::star(random, 40, 0.3, 1);
  compare_with_oracle(chart, {{75, 75}, 0.7, GetParam()}, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Coverages, RasterOracle,
                         ::testing::Values(Coverage::center, Coverage::conservative),
                         [](const auto& suite) {
                           return suite.param == Coverage::center ? "center" : "conservative";
                         });

TEST(Raster, TinyChartStillCoversACell) {
  const ChartRaster raster =
      rasterize(make_raster_shape(test::rectangle(1, 1)), {{0.01, 0.01}, 0, Coverage::center}, 0.5);
  EXPECT_EQ(raster.cells, 1);
}

TEST(Raster, LoopsFillByNonZeroWinding) {
  // A pentagram winds twice around its middle, which must not stay free.
  std::vector<Vec2> star;
  for (int i = 0; i < 5; ++i) {
    const double angle = 4 * std::numbers::pi * i / 5;
    star.push_back({std::cos(angle), std::sin(angle)});
  }
  const std::vector<std::vector<Vec2>> loops{star};
  const auto chart = chart_from_loops(loops);
  ASSERT_TRUE(chart);
  const ChartRaster raster =
      rasterize(make_raster_shape(*chart), {{40, 40}, 0, Coverage::center}, 0);
  const Vec2 middle = raster.offset;
  EXPECT_TRUE(cells_of(raster).rows.test(static_cast<int>(middle.y), static_cast<int>(middle.x)));
  // Five points of a pentagram of radius 1 and its pentagon, once.
  EXPECT_NEAR(chart->area, 1.1226, 1e-3);
  EXPECT_NEAR(static_cast<double>(raster.cells) / 1600, chart->area, 0.02);
}

TEST(Raster, TooLongIsNotMade) {
  const ChartRaster raster =
      rasterize(make_raster_shape(test::rectangle(1e9, 1)), {{1, 1}, 0, Coverage::center}, 0, 4096);
  EXPECT_EQ(raster.width, 0);
}

TEST(Bits, TransposeTwiceIsTheSame) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 20; ++i) {
    BitLanes lanes(1 + static_cast<int>(random() % 200), 1 + static_cast<int>(random() % 200));
    for (int k = 0; k < 500; ++k) {
      lanes.set(static_cast<int>(random() % static_cast<unsigned>(lanes.lanes)),
                static_cast<int>(random() % static_cast<unsigned>(lanes.length)));
    }
    const BitLanes other = transposed(lanes);
    for (int a = 0; a < lanes.lanes; ++a) {
      for (int b = 0; b < lanes.length; ++b) ASSERT_EQ(lanes.test(a, b), other.test(b, a));
    }
    EXPECT_EQ(transposed(other).bits, lanes.bits);
  }
}

TEST(Bits, RunsSpansAndSearches) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    const int length = 1 + static_cast<int>(random() % 150);
    BitLanes lanes(1, length);
    std::vector<bool> plain(static_cast<std::size_t>(length));
    for (int k = 0; k < 4; ++k) {
      const int begin = static_cast<int>(random() % static_cast<unsigned>(length));
      const int end =
          begin + 1 + static_cast<int>(random() % static_cast<unsigned>(length - begin));
      if (k % 2 == 0 || end - begin < 20) {
        set_span(lanes.lane(0), begin, end);
        std::fill(plain.begin() + begin, plain.begin() + end, true);
      }
    }
    std::vector<bool> rebuilt(static_cast<std::size_t>(length));
    int previous_end = -1;
    for_each_run(lanes.lane(0), length, [&](int begin, int end) {
      EXPECT_GT(begin, previous_end);
      EXPECT_LT(begin, end);
      std::fill(rebuilt.begin() + begin, rebuilt.begin() + end, true);
      previous_end = end;
    });
    EXPECT_EQ(rebuilt, plain);
    EXPECT_EQ(last_set(lanes.lane(0), length), previous_end - 1);
  }
}

}  // namespace
}  // namespace wrapatlas
