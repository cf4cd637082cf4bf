// Outline, area and overlap of single charts, against point sampling.
#include <gtest/gtest.h>

#include <map>

#include "uv_mesh.h"
#include "wrapatlas/charts.h"

namespace wrapatlas {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using test::random_point;

std::vector<Vec2> random_points(std::mt19937& random, std::size_t count) {
  std::vector<Vec2> points(count);
  for (Vec2& p : points) p = random_point(random, {{-1, 2}, {3, 5}});
  return points;
}

Triangles random_triangles(std::mt19937& random, std::uint32_t points, std::size_t count) {
  std::uniform_int_distribution<std::uint32_t> pick(0, points - 1);
  Triangles triangles(count);
  for (auto& t : triangles) {
    for (std::uint32_t& p : t) p = pick(random);
  }
  return triangles;
}

/// A regular grid of n x n quads, each of two triangles, displaced by `jitter`.
Chart grid_chart(std::uint32_t n, double jitter, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Vec2> points;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const Vec2 d = random_point(random, {{-jitter, -jitter}, {jitter, jitter}});
      points.push_back(Vec2{double(x), double(y)} + d);
    }
  }
  Triangles triangles;
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = b + n + 1, d = a + n + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return chart_from_triangles(points, triangles);
}

void expect_covers_its_triangles(const Chart& chart, std::uint32_t seed, int samples = 400) {
  std::mt19937 random(seed);
  for (int i = 0; i < samples; ++i) {
    const Vec2 p = random_point(random, chart.box);
    const bool covered = test::triangles_over(chart, p) > 0;
    const bool claimed = test::winding_at(chart, p) != 0 || test::in_against_grain(chart, p);
    ASSERT_EQ(covered, claimed) << "at " << p.x << ", " << p.y;
  }
}

/// Area and overlap by midpoints of a fine grid.
struct Sampled {
  double area = 0, overlap = 0;
};
Sampled sample_area(const Chart& chart, int n) {
  const Vec2 cell = (1.0 / n) * chart.box.size();
  Sampled s;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const Vec2 p = chart.box.min + Vec2{(x + 0.4987) * cell.x, (y + 0.5013) * cell.y};
      const int count = test::triangles_over(chart, p);
      s.area += count > 0 ? cell.x * cell.y : 0;
      s.overlap += std::max(count - 1, 0) * cell.x * cell.y;
    }
  }
  return s;
}

TEST(ChartGeometry, OneTriangle) {
  const Chart chart = chart_from_triangles({{0, 0}, {4, 0}, {0, 3}}, {{0, 1, 2}});
  EXPECT_DOUBLE_EQ(chart.area, 6);
  EXPECT_EQ(chart.overlap, 0);
  EXPECT_DOUBLE_EQ(chart.max_radius, 2.5);
  EXPECT_EQ(chart.outline.size(), 3U);
  EXPECT_TRUE(chart.against_grain.empty());
  EXPECT_EQ(chart.box.max, (Vec2{4, 3}));
}

TEST(ChartGeometry, InteriorEdgesLeaveTheOutline) {
  const Chart chart = grid_chart(10, 0.2, 1);
  EXPECT_EQ(chart.outline.size(), 40U);
  for (const OutlineEdge& e : chart.outline) EXPECT_EQ(e.winding, 1);
  EXPECT_EQ(chart.overlap, 0);
  expect_covers_its_triangles(chart, 2);
}

TEST(ChartGeometry, MaterialIsOnTheLeft) {
  const Chart chart =
      chart_from_triangles({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  ASSERT_EQ(chart.outline.size(), 4U);
  for (const OutlineEdge& e : chart.outline) EXPECT_EQ(e.to, (e.from + 1) % 4);
}

TEST(ChartGeometry, NegativeChartStaysAsItIs) {
  const Chart chart =
      chart_from_triangles({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 2, 1}, {0, 3, 2}});
  ASSERT_EQ(chart.outline.size(), 4U);
  for (const OutlineEdge& e : chart.outline) EXPECT_EQ(e.from, (e.to + 1) % 4);
  EXPECT_TRUE(chart.against_grain.empty());
  EXPECT_DOUBLE_EQ(chart.area, 1);
  EXPECT_EQ(test::winding_at(chart, {0.5, 0.5}), -1);
}

TEST(ChartGeometry, FlippedTriangleInside) {
  // The middle point of a fan lies outside of one of the fan's triangles.
  std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, -1}};
  const Chart chart = chart_from_triangles(points, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  EXPECT_EQ(chart.against_grain, (std::vector<std::uint32_t>{0}));
  // The flipped triangle lies on parts of its two neighbours that reach below the square.
  EXPECT_DOUBLE_EQ(chart.area, 18);
  EXPECT_DOUBLE_EQ(chart.overlap, 2);
  expect_covers_its_triangles(chart, 3);
}

TEST(ChartGeometry, FoldedPaperCountsOnce) {
  // The right half of a sheet is mirrored onto the left one about their common line x = 0.
  std::mt19937 random(4);
  const std::uint32_t n = 12;
  std::vector<Vec2> points;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= 2 * n; ++x) {
      const double fold = std::abs(double(x) - n);
      points.push_back({fold, double(y) + (fold > 0 && y > 0 && y < n ? 0.1 * (x % 3) : 0)});
    }
  }
  Triangles triangles;
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < 2 * n; ++x) {
      const std::uint32_t a = y * (2 * n + 1) + x, b = a + 1, d = a + 2 * n + 1, c = d + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  const Chart chart = chart_from_triangles(points, triangles);
  EXPECT_NEAR(chart.area, n * n, 1e-9);
  EXPECT_NEAR(chart.overlap, n * n, 1e-9);
  EXPECT_EQ(chart.against_grain.size(), triangles.size() / 2);
  expect_covers_its_triangles(chart, 5);
}

TEST(ChartGeometry, BowTieOfTwoTriangles) {
  const Chart chart =
      chart_from_triangles({{0, 0}, {2, 2}, {0, 2}, {2, 0}, {1, 1}}, {{0, 4, 2}, {3, 1, 4}});
  EXPECT_DOUBLE_EQ(chart.area, 2);
  EXPECT_EQ(chart.overlap, 0);
  EXPECT_EQ(chart.outline.size(), 6U);
  expect_covers_its_triangles(chart, 6);
}

TEST(ChartGeometry, ThreeTrianglesOnOneEdge) {
  const Chart chart = chart_from_triangles({{0, 0}, {4, 0}, {2, 3}, {2, -3}, {1, 1}},
                                           {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_DOUBLE_EQ(chart.area, 12);
  EXPECT_DOUBLE_EQ(chart.overlap, 2);
  expect_covers_its_triangles(chart, 7);
}

TEST(ChartGeometry, HairThinOverlapIsNotReported) {
  const double hair = 1e-12;
  const Chart chart = chart_from_triangles(
      {{0, 0}, {1, 0}, {1, 1}, {0, hair}, {1, 1 + hair}, {0, 1}}, {{0, 1, 4}, {0, 2, 5}});
  EXPECT_EQ(chart.overlap, 0);
  EXPECT_NEAR(chart.area, 1, 1e-9);
}

TEST(ChartGeometry, ZeroAreaChartsKeepTheirExtent) {
  for (const Triangles& triangles :
       {Triangles{{0, 1, 2}, {2, 1, 0}}, Triangles{{0, 1, 0}}, Triangles{{0, 1, 2}, {1, 0, 2}}}) {
    const Chart chart = chart_from_triangles({{0, 0}, {2, 2}, {1, 1}}, triangles);
    EXPECT_EQ(chart.area, 0);
    EXPECT_EQ(chart.against_grain.size(), triangles.size());
    EXPECT_NEAR(chart.max_radius, std::sqrt(2), 1e-15);
  }
}

TEST(ChartGeometry, EmptyChart) {
  const Chart chart = chart_from_triangles({}, {});
  EXPECT_EQ(chart.area, 0);
  EXPECT_EQ(chart.max_radius, 0);
  EXPECT_TRUE(chart.box.empty());
}

TEST(ChartGeometry, RandomTrianglesCoverAndArea) {
  std::mt19937 random(8);
  for (std::uint32_t round = 0; round < 40; ++round) {
    const std::uint32_t points = 4 + round % 17;
    const Chart chart = chart_from_triangles(random_points(random, points),
                                             random_triangles(random, points, 1 + round % 13));
    if (chart.area == 0) continue;
    expect_covers_its_triangles(chart, 100 + round);
    const Sampled sampled = sample_area(chart, 200);
    EXPECT_NEAR(chart.area, sampled.area, 0.02 * sampled.area + 0.01) << round;
    EXPECT_NEAR(chart.overlap, sampled.overlap, 0.02 * sampled.overlap + 0.01) << round;
  }
}

/// max(count - 1, 0) integrated over lines through all places where anything changes: exact, and
/// cubic. An oracle that knows nothing of slabs, blocks or winding numbers.
double overlap_by_all_crossings(const Chart& chart) {
  std::vector<double> ys;
  std::vector<std::pair<Vec2, Vec2>> edges;
  for (const auto& t : chart.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.emplace_back(chart.points[t[i]], chart.points[t[(i + 1) % 3]]);
      ys.push_back(chart.points[t[i]].y);
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const Vec2 p = edges[i].first, r = edges[i].second - p;
      const Vec2 q = edges[j].first, s = edges[j].second - q;
      if (cross(r, s) == 0) continue;
      const double t = cross(q - p, s) / cross(r, s);
      if (t > 0 && t < 1) ys.push_back(p.y + t * r.y);
    }
  }
  std::sort(ys.begin(), ys.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ys.size(); ++i) {
    const double y = 0.5 * (ys[i] + ys[i + 1]);
    std::vector<std::pair<double, int>> ends;
    for (const auto& t : chart.triangles) {
      Box2 cut;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = chart.points[t[k]], b = chart.points[t[(k + 1) % 3]];
        if ((a.y > y) != (b.y > y)) cut.add({a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), y});
      }
      if (cut.empty()) continue;
      ends.emplace_back(cut.min.x, 1);
      ends.emplace_back(cut.max.x, -1);
    }
    std::sort(ends.begin(), ends.end());
    int count = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      count += ends[k].second;
      sum += std::max(count - 1, 0) * (ends[k + 1].first - ends[k].first) * (ys[i + 1] - ys[i]);
    }
  }
  return sum;
}

TEST(ChartGeometry, OverlapIsExact) {
  std::mt19937 random(9);
  for (std::uint32_t round = 0; round < 30; ++round) {
    const std::uint32_t points = 5 + round, count = 2 + round;
    const Chart chart = chart_from_triangles(random_points(random, points),
                                             random_triangles(random, points, count));
    const double expected = overlap_by_all_crossings(chart);
    EXPECT_NEAR(chart.overlap, expected, 1e-9 * (1 + expected)) << round;
  }
}

TEST(ChartGeometry, ManyLinesThroughOnePoint) {
  // 60 long triangles that all cross at the origin; what they cover there is theirs together.
  std::vector<Vec2> points;
  Triangles triangles;
  const int count = 60;
  for (int i = 0; i < count; ++i) {
    const double angle = 3.141592653589793 * (i + 0.3) / count;
    const Vec2 d{std::cos(angle), std::sin(angle)}, n{-0.05 * d.y, 0.05 * d.x};
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {-1.0 * d, d - n, d + n});
    triangles.push_back({first, first + 1, first + 2});
  }
  const Chart chart = chart_from_triangles(points, triangles);
  EXPECT_NEAR(chart.overlap, overlap_by_all_crossings(chart), 1e-9);
  EXPECT_NEAR(chart.area + chart.overlap, count * 0.1, 1e-12);
}

TEST(ChartGeometry, DeepStacksStayFast) {
  std::mt19937 random(10);
  const std::uint32_t points = 3000;
  const Chart chart =
      chart_from_triangles(random_points(random, points), random_triangles(random, points, 1000));
  EXPECT_NEAR(chart.area, sample_area(chart, 60).area, 0.1);
  double sum = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    sum += 0.5 * std::abs(signed_area2(chart.points[a], chart.points[b], chart.points[c]));
  }
  EXPECT_NEAR(chart.area + chart.overlap, sum, 1e-9 * sum);
}

/// Long thin strips side by side, slanted so that every line crosses most of them; twice, the
/// second time shifted by `shift` along the strips. Too much for an exact sweep.
Chart slanted_strips(std::uint32_t count, double shift) {
  const Vec2 along{0.6, 0.8}, across{0.8, -0.6};
  std::vector<Vec2> points;
  Triangles triangles;
  for (std::uint32_t i = 0; i < 2 * count; ++i) {
    const std::uint32_t pair = i / 2;
    const double x = 0.001 * pair, y = i % 2 == 0 ? 0 : shift;
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const Vec2 p : {Vec2{x, y}, {x + 0.0008, y}, {x + 0.0008, y + 10}, {x, y + 10}}) {
      points.push_back(p.x * across + p.y * along);
    }
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  return chart_from_triangles(points, triangles);
}

TEST(ChartGeometry, TooManyStepsForAnExactSweep) {
  const std::uint32_t count = 2000;
  EXPECT_EQ(slanted_strips(count, 11).overlap, 0);  // end to end, with a gap
  const double strip = 0.0008 * 10;
  const Chart chart = slanted_strips(count, 4);
  EXPECT_NEAR(chart.overlap, 0.6 * strip * count, 1e-3 * strip * count);
  EXPECT_NEAR(chart.area + chart.overlap, 2 * strip * count, 1e-9);
}

TEST(ChartGeometry, LoopsMakeTheSameChart) {
  const std::vector<std::vector<Vec2>> loops{{{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                             {{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  const auto chart = chart_from_loops(loops);
  ASSERT_TRUE(chart);
  EXPECT_DOUBLE_EQ(chart->area, 15);
  EXPECT_EQ(chart->outline.size(), 8U);
  EXPECT_EQ(test::winding_at(*chart, {0.5, 0.5}), 1);
  EXPECT_EQ(test::winding_at(*chart, {1.5, 1.5}), 0);
  EXPECT_NEAR(chart->max_radius, std::sqrt(8), 1e-15);
}

TEST(ChartGeometry, BadLoops) {
  const std::vector<std::vector<Vec2>> two{{{0, 0}, {1, 0}}};
  const auto short_loop = chart_from_loops(two);
  ASSERT_FALSE(short_loop);
  EXPECT_EQ(short_loop.error().kind, ErrorKind::input);
  EXPECT_NE(short_loop.error().message().find("loop 0"), std::string::npos);
  const std::vector<std::vector<Vec2>> nan{{{0, 0}, {1, 0}, {0, std::nan("")}}};
  EXPECT_FALSE(chart_from_loops(nan));
}

}  // namespace
}  // namespace wrapatlas
