#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pack/first_contact.h"
#include "support/shapes.h"
#include "support/soup_check.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {
namespace {

struct Placed {
  Chart chart;
  Vec2 centre;  ///< of its box, texels
  double angle = 0;
  int page = 0;
};

/// The placement that puts the centre of a chart's placed box somewhere.
Placement centred(const Chart& chart, double scale, double angle, Vec2 centre, int page) {
  Box2 box;
  for (const Vec2 p : chart.points) box.add(Similarity::from(scale, angle, {0, 0}).apply(p));
  return {angle, centre - 0.5 * (box.min + box.max), page};
}

/// `k` of charts placed by hand at scale 1.
double growth(const std::vector<Placed>& placed, int width, int height, Wrap wrap) {
  std::vector<Chart> charts;
  Packing packing;
  packing.width = width;
  packing.height = height;
  packing.wrap = wrap;
  packing.scale = 1;
  double area = 0;
  for (const Placed& p : placed) {
    charts.push_back(p.chart);
    packing.placements.push_back(centred(p.chart, 1, p.angle, p.centre, p.page));
    packing.pages = std::max(packing.pages, p.page + 1);
    area += p.chart.area;
  }
  packing.efficiency = area / (double{1} * width * height * packing.pages);
  return std::sqrt(unpadded_efficiency(charts, packing) / packing.efficiency);
}

constexpr double kExact = 1e-12;
constexpr double kPi = std::numbers::pi;

TEST(Unpadded, TwoSquaresMeet) {
  const Chart square = test::rectangle(10, 10);
  // A gap of 4 between sides of 10.
  EXPECT_NEAR(growth({{square, {43, 50}}, {square, {57, 50}}}, 100, 100, Wrap::none), 1.4, kExact);
  EXPECT_NEAR(growth({{square, {43, 47}}, {square, {57, 53}}}, 100, 100, Wrap::none), 1.4, kExact);
  EXPECT_NEAR(growth({{square, {44, 43}}, {square, {56, 57}}}, 100, 100, Wrap::none), 1.4, kExact);
  // One of them on its corner.
  EXPECT_NEAR(growth({{square, {40, 50}}, {square, {60, 50}, kPi / 4}}, 100, 100, Wrap::none),
              20 / (5 + 5 * std::sqrt(2)), kExact);
  // Sizes differ: the smaller one counts less.
  EXPECT_NEAR(growth({{square, {40, 50}}, {test::rectangle(2, 2), {50, 51}}}, 100, 100, Wrap::none),
              10 / 6.0, kExact);
}

TEST(Unpadded, BordersThatDoNotWrapAreMet) {
  const Chart square = test::rectangle(10, 10);
  for (const Vec2 at : {Vec2{6, 50}, Vec2{94, 50}, Vec2{50, 6}, Vec2{50, 94}}) {
    EXPECT_NEAR(growth({{square, at}}, 100, 100, Wrap::none), 1.2, kExact);
    const bool beside_u = at.x != 50;
    EXPECT_NEAR(growth({{square, at}}, 100, 100, beside_u ? Wrap::v : Wrap::u), 1.2, kExact);
    EXPECT_NEAR(growth({{square, at}}, 100, 100, beside_u ? Wrap::u : Wrap::v), 10, kExact);
    EXPECT_NEAR(growth({{square, at}}, 100, 100, Wrap::uv), 10, kExact);
  }
}

TEST(Unpadded, ChartsMeetAcrossTheBorder) {
  const Chart square = test::rectangle(10, 10);
  const std::vector<Placed> sides{{square, {7, 50}}, {square, {93, 50}}};
  EXPECT_NEAR(growth(sides, 100, 100, Wrap::none), 1.4, kExact);  // the border
  EXPECT_NEAR(growth(sides, 100, 100, Wrap::u), 1.4, kExact);     // each other
  const std::vector<Placed> corners{{square, {7, 8}}, {square, {93 + 300, 92 - 200}}};
  EXPECT_NEAR(growth(corners, 100, 100, Wrap::uv), 1.6, kExact);
  // And its own image.
  EXPECT_NEAR(growth({{test::rectangle(80, 20), {50, 50}}}, 100, 100, Wrap::uv), 1.25, kExact);
  EXPECT_NEAR(growth({{test::rectangle(80, 20), {3, 50}, kPi / 2}}, 100, 100, Wrap::uv), 1.25,
              kExact);
  // A strip that winds around the torus: at 45 degrees its images are 100 / sqrt(2) apart.
  const double diagonal = 100 * std::sqrt(2);
  EXPECT_NEAR(
      growth({{test::rectangle(0.9 * diagonal, 10), {50, 50}, kPi / 4}}, 100, 100, Wrap::uv),
      1 / 0.9, kExact);
}

TEST(Unpadded, PagesDoNotMeet) {
  const Chart square = test::rectangle(10, 10);
  const std::vector<Placed> two{{square, {50, 50}}, {square, {57, 50}, 0, 1}};
  EXPECT_NEAR(growth(two, 100, 100, Wrap::none), 43 / 5.0, kExact);
  std::vector<Placed> three = two;
  three.push_back({square, {57, 63}, 0, 1});
  EXPECT_NEAR(growth(three, 100, 100, Wrap::none), 1.3, kExact);
}

TEST(Unpadded, TheFirstMeetingCounts) {
  std::vector<Vec2> c{{0, 0}, {40, 0}, {40, 10}, {1, 10}, {1, 30}, {40, 30}, {40, 40}, {0, 40}};
  const auto mouth = chart_from_loops(std::vector<std::vector<Vec2>>{c});
  ASSERT_TRUE(mouth);
  const Chart bar = test::rectangle(2, 4);
  // A bar between the arms of a C meets neither these nor its back, only the C the border.
  EXPECT_NEAR(growth({{*mouth, {50, 50}}, {bar, {74, 50}}}, 100, 100, Wrap::none), 2.5, kExact);
  // One beside the upper arm meets it, though it would be between them again from 2.25 on.
  EXPECT_NEAR(growth({{*mouth, {50, 50}}, {bar, {74, 68}}}, 100, 100, Wrap::none), 24 / 21.0,
              kExact);
}

TEST(Unpadded, WhatTouchesOrCrossesDoesNotGrow) {
  const Chart square = test::rectangle(10, 10);
  EXPECT_EQ(growth({{square, {40, 50}}, {square, {50, 50}}}, 100, 100, Wrap::none), 1);
  EXPECT_EQ(growth({{square, {40, 50}}, {square, {45, 53}}}, 100, 100, Wrap::none), 1);
  EXPECT_EQ(growth({{square, {5, 50}}}, 100, 100, Wrap::none), 1);
  const Chart bar = test::rectangle(30, 2);
  EXPECT_EQ(growth({{bar, {50, 50}}, {bar, {51, 51}, kPi / 2}}, 100, 100, Wrap::none), 1);
}

TEST(Unpadded, ChartsWithoutExtentAreInNobodysWay) {
  Chart dot;
  dot.points = {{0, 0}};
  const Chart square = test::rectangle(10, 10);
  EXPECT_NEAR(growth({{dot, {46, 50}}, {square, {50, 50}}}, 100, 100, Wrap::none), 10, kExact);
  // A needle is as long as it wants to be, but not for ever.
  const double k = growth({{test::rectangle(90, 1e-9), {50, 50}, 0.3}}, 100, 100, Wrap::uv);
  EXPECT_GT(k, 1);
  EXPECT_LT(k, 10);
}

/// The packing with all charts k times as large.
Packing enlarged(const std::vector<Chart>& charts, const Packing& packing, double k) {
  Packing larger = packing;
  larger.scale *= k;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    Box2 box;
    for (const Vec2 p : charts[i].points) box.add(packing.transform(i).apply(p));
    const Placement& at = packing.placements[i];
    larger.placements[i] =
        centred(charts[i], larger.scale, at.angle, 0.5 * (box.min + box.max), at.page);
  }
  return larger;
}

/// Against every pair of triangles.
TEST(Unpadded, IsWhereChartsBeginToOverlap) {
  for (const Wrap wrap : {Wrap::none, Wrap::u, Wrap::uv}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const std::vector<Chart> charts = test::mixed_charts(seed, 4 + 2 * static_cast<int>(seed));
      PackOptions options;
      options.method = Method::modulo;
      options.wrap = wrap;
      options.width = 256;
      options.height = seed % 2 == 0 ? 256 : 150;
      options.padding = static_cast<double>(seed % 3) * 4;
      const auto packing = pack(charts, options);
      ASSERT_TRUE(packing);
      const double unpadded = unpadded_efficiency(charts, *packing);
      EXPECT_GE(unpadded, packing->efficiency);
      EXPECT_LE(unpadded, 1);
      EXPECT_TRUE(options.padding == 0 || unpadded > packing->efficiency);
      const double k = std::sqrt(unpadded / packing->efficiency);
      options.padding = options.margin = 0;
      for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        const Packing less = enlarged(charts, *packing, 1 + share * (k - 1) - 1e-7);
        EXPECT_EQ(test::check_packing(charts, less, options), "") << seed << " " << share;
      }
      const Packing more = enlarged(charts, *packing, k + 1e-5);
      EXPECT_NE(test::check_packing(charts, more, options), "") << seed;
    }
  }
}

TEST(Unpadded, WithoutPaddingThereIsLittleToGain) {
  const std::vector<Chart> charts = test::mixed_charts(3, 30);
  PackOptions options;
  options.method = Method::modulo;
  options.width = options.height = options.grid = 1024;
  options.padding = 0;
  const auto packing = pack(charts, options);
  ASSERT_TRUE(packing);
  EXPECT_LT(unpadded_efficiency(charts, *packing), packing->efficiency + 0.01);
}

Outline square_outline(double side) {
  Outline outline;
  outline.add({0, 0}, {side, 0});
  outline.add({side, 0}, {side, side});
  outline.add({side, side}, {0, side});
  outline.add({0, side}, {0, 0});
  return outline;
}

TEST(FirstContact, GlidingIsNone) {
  const Outline square = square_outline(1);
  EXPECT_EQ(first_contact(square, square, {0.5, 1}, {1, 0}, 1), 1);     // along a side
  EXPECT_EQ(first_contact(square, square, {0, 1.5}, {0, 1}, 1), 1);     // away
  EXPECT_EQ(first_contact(square, square, {0, 1}, {0, -1}, 1), 0);      // into it
  EXPECT_EQ(first_contact(square, square, {3, 0}, {-4, 0}, 1), 0.5);    // on the way
  EXPECT_EQ(first_contact(square, square, {3, 0}, {-4, 0}, 0.4), 0.4);  // later
  EXPECT_EQ(first_contact(square, square, {3, 1.5}, {-4, 0}, 1), 1);    // beside it
}

TEST(FirstContact, NoWayLeadsNowhere) {
  const Outline ring = square_outline(10), inner = square_outline(1);
  EXPECT_EQ(first_contact(ring, inner, {5, 5}, {0, 0}, 1), 1);
  EXPECT_EQ(first_contact(ring, Outline{}, {5, 5}, {1, 0}, 1), 1);
  EXPECT_EQ(first_contact(ring, inner, {5, 5}, {8, 0}, 1), 0.5);  // from within
}

}  // namespace
}  // namespace wrapatlas
