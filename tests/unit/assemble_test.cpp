#include "guided/assemble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "guided/borders.h"
#include "guided/random.h"
#include "pack/aspects.h"

namespace wrapatlas {
namespace {

constexpr double kPi = std::numbers::pi;

/// A wave of period 1, a different one for each number.
double wave(double t, int which) {
  return 0.6 * std::sin(2 * kPi * t * 2 + which) + 0.4 * std::sin(2 * kPi * t * 5 + 2.3 * which);
}

/// A sheet of 1 x 1 that wraps along some axes, cut into n x n pieces along waves, each piece
/// turned and moved.
struct Sheet {
  std::vector<Chart> charts;
  std::vector<Pose> poses;  ///< from the sheet to the chart

  Sheet(int n, double height, Wrap wrap, std::uint64_t seed) {
    Random random(seed);
    const auto bent = [&](int line, double t, int which) {
      const bool wraps = which == 0 ? wraps_u(wrap) : wraps_v(wrap);
      const bool straight = !wraps && (line == 0 || line == n);
      return (line + (straight ? 0 : height * wave(t, line % n + which))) / n;
    };
    const auto upwards = [&](int line, double y) { return Vec2{bent(line, y, 0), y}; };
    const auto sideways = [&](int line, double x) { return Vec2{x, bent(line, x, n)}; };
    const auto meeting = [&](int i, int j) {
      Vec2 p{i / double(n), j / double(n)};
      for (int k = 0; k < 50; ++k) p = {upwards(i, p.y).x, sideways(j, p.x).y};
      return p;
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const Vec2 a = meeting(i, j), b = meeting(i + 1, j), c = meeting(i + 1, j + 1),
                   d = meeting(i, j + 1);
        std::vector<Vec2> loop;
        constexpr int kPoints = 40;
        for (int side = 0; side < 4; ++side) {
          for (int k = 0; k < kPoints; ++k) {
            const double t = k / double(kPoints);
            if (side == 0) loop.push_back(sideways(j, a.x + t * (b.x - a.x)));
            if (side == 1) loop.push_back(upwards(i + 1, b.y + t * (c.y - b.y)));
            if (side == 2) loop.push_back(sideways(j + 1, c.x + t * (d.x - c.x)));
            if (side == 3) loop.push_back(upwards(i, d.y + t * (a.y - d.y)));
          }
        }
        const Pose pose{2 * kPi * random.unit(), {10 * random.unit(), 10 * random.unit()}};
        for (Vec2& p : loop) p = pose.apply(p);
        auto chart = chart_from_loops(std::vector<std::vector<Vec2>>{loop});
        charts.push_back(std::move(*chart));
        poses.push_back(pose);
      }
    }
  }
};

std::vector<ChartShape> shapes_of(const std::vector<Chart>& charts) {
  std::vector<ChartShape> shapes;
  for (const Chart& chart : charts) shapes.push_back({make_raster_shape(chart), 0.3, chart.area});
  return shapes;
}

std::optional<Assembly> assembled(const std::vector<Chart>& charts, Wrap wrap, int width = 512,
                                  int height = 512) {
  PackOptions options;
  options.width = width;
  options.height = height;
  options.wrap = wrap;
  options.padding = 0;
  const auto frames = make_frames(options, 1);
  EXPECT_TRUE(frames);
  return assemble(shapes_of(charts), *frames, options, 10, Effort({}));
}

/// How far charts lie from where they were in the sheet, in parts of its side; the sheet as a whole
/// may lie anywhere and turned by quarters.
double largest_miss(const Sheet& sheet, const Layout& layout) {
  const auto spot_pose = [&](std::size_t i) {
    return Pose{0.3 + 2 * kPi * layout.spots[i].angle / kAngleSteps, layout.spots[i].centre};
  };
  // The sheet seen from chart 0, twice.
  const auto centre = [&](std::size_t i) {
    const Box2& box = sheet.charts[i].box;
    return 0.5 * (box.min + box.max);
  };
  double worst = 0;
  const Pose home{sheet.poses[0].inverse().angle, sheet.poses[0].inverse().apply(centre(0))};
  const Pose to_atlas = spot_pose(0).after(home.inverse());
  for (std::size_t i = 1; i < sheet.charts.size(); ++i) {
    const Pose back = sheet.poses[i].inverse();
    const Vec2 wanted = to_atlas.apply(back.apply(centre(i)));
    const Vec2 miss = wanted - layout.spots[i].centre;
    worst = std::max(
        {worst, std::abs(std::remainder(miss.x, 1.0)), std::abs(std::remainder(miss.y, 1.0)),
         std::abs(std::remainder(to_atlas.angle + back.angle - spot_pose(i).angle, 2 * kPi))});
  }
  return worst;
}

TEST(Pose, InverseUndoesAndAfterComposes) {
  const Pose a{0.7, {1, 2}}, b{-2.1, {3, -1}};
  const Vec2 p{0.3, 0.9}, back = a.inverse().apply(a.apply(p)), twice = a.after(b).apply(p);
  EXPECT_NEAR(back.x, p.x, 1e-15);
  EXPECT_NEAR(back.y, p.y, 1e-15);
  EXPECT_NEAR(twice.x, a.apply(b.apply(p)).x, 1e-15);
  EXPECT_NEAR(twice.y, a.apply(b.apply(p)).y, 1e-15);
}

TEST(MotionFit, FindsASmallMotionFromLinesAlone) {
  const Pose motion{0.01, {0.02, -0.03}};
  MotionFit fit({0.5, 0.5});
  for (int i = 0; i < 40; ++i) {  // points of a circle, which says nothing about the turn, and more
    const Vec2 on{std::cos(0.3 * i), i % 2 == 0 ? std::sin(0.3 * i) : 2.0};
    const Vec2 along = i % 2 == 0 ? Vec2{-std::sin(0.3 * i), std::cos(0.3 * i)} : Vec2{1, 0};
    fit.add(motion.inverse().apply(on), on, along);
  }
  const Pose found = fit.solve();
  EXPECT_NEAR(found.angle, motion.angle, 2e-4);
  EXPECT_NEAR(found.shift.x, motion.shift.x, 1e-3);
  EXPECT_NEAR(found.shift.y, motion.shift.y, 1e-3);
}

TEST(MotionFit, WithoutPointsNothingMoves) {
  const Pose found = MotionFit({1, 1}).solve();
  EXPECT_EQ(found.angle, 0);
  EXPECT_EQ(found.shift, Vec2());
}

TEST(Borders, PointsOfASquareAreAsFarApartAsWished) {
  const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<Chart> charts{*chart_from_loops(std::vector<std::vector<Vec2>>{square})};
  const auto borders = sample_borders(shapes_of(charts), 0.05);
  ASSERT_EQ(borders.size(), 1U);
  EXPECT_EQ(borders[0].size(), 80);
  for (int i = 0; i < 80; ++i) {
    EXPECT_NEAR(length(borders[0].point(i + 1) - borders[0].point(i)), 0.05, 1e-12);
    EXPECT_NEAR(std::max(std::abs(borders[0].point(i).x), std::abs(borders[0].point(i).y)), 0.5,
                1e-12);
  }
}

TEST(Borders, NeighboursMatchAndTheMatchTakesOneToTheOther) {
  const Sheet sheet(2, 0.15, Wrap::none, 1);
  const double step = 0.5 / 40;
  const auto shapes = shapes_of(sheet.charts);
  const auto borders = sample_borders(shapes, step);
  ASSERT_EQ(borders.size(), 4U);
  const auto matches = match_borders(borders, step, 1, Effort({}));
  ASSERT_GE(matches.size(), 4U);
  int right = 0;
  for (int k = 0; k < 4; ++k) {  // the strongest
    const BorderMatch& match = matches[static_cast<std::size_t>(k)];
    const Pose found = match.b_to_a;
    const auto frame = [&](std::uint32_t border) {  // from the sheet to points of the border
      Pose pose = sheet.poses[borders[border].chart];
      pose.shift = pose.shift - shapes[borders[border].chart].raster.centre;
      return pose;
    };
    const Pose wanted = frame(match.a).after(frame(match.b).inverse());
    const Vec2 p = borders[match.b].point(match.begin_b);
    right += length(found.apply(p) - wanted.apply(p)) < 0.2 * step ? 1 : 0;
  }
  EXPECT_EQ(right, 4);
}

TEST(Assemble, ATorusIsPutTogether) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Sheet sheet(3, 0.15, Wrap::uv, seed);
    const auto result = assembled(sheet.charts, Wrap::uv);
    ASSERT_TRUE(result) << seed;
    EXPECT_NEAR(result->layout.scale, 512, 0.5);
    EXPECT_LT(largest_miss(sheet, result->layout), 0.01) << seed;
  }
}

TEST(Assemble, ASquareIsPutTogether) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Sheet sheet(4, 0.15, Wrap::none, seed);
    const auto result = assembled(sheet.charts, Wrap::none);
    ASSERT_TRUE(result) << seed;
    EXPECT_LT(largest_miss(sheet, result->layout), 0.01) << seed;
    for (const ChartSpot& spot : result->layout.spots) {
      EXPECT_GT(std::min(spot.centre.x, spot.centre.y), 0.05);
      EXPECT_LT(std::max(spot.centre.x, spot.centre.y), 0.95);
    }
  }
}

TEST(Assemble, ASheetThatWrapsAlongOneAxisIsPutTogether) {
  for (const Wrap wrap : {Wrap::u, Wrap::v}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const Sheet sheet(4, 0.15, wrap, seed);
      const auto result = assembled(sheet.charts, wrap);
      ASSERT_TRUE(result) << seed;
      EXPECT_LT(largest_miss(sheet, result->layout), 0.01) << seed;
      for (const ChartSpot& spot : result->layout.spots) {
        const double across = wrap == Wrap::u ? spot.centre.y : spot.centre.x;
        EXPECT_GT(across, 0.05);
        EXPECT_LT(across, 0.95);
      }
    }
  }
}

TEST(Assemble, AnAtlasOfAnotherShapeIsNotFilled) {
  EXPECT_FALSE(assembled(Sheet(3, 0.15, Wrap::uv, 1).charts, Wrap::uv, 1024, 512));
  EXPECT_FALSE(assembled(Sheet(3, 0.15, Wrap::none, 1).charts, Wrap::none, 1024, 512));
}

TEST(Assemble, PiecesOfManySheetsAreNotPutTogether) {
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < 9; ++i) {
    const double height = 0.1 + 0.01 * static_cast<double>(i);
    charts.push_back(Sheet(3, height, Wrap::uv, i).charts[i]);
  }
  EXPECT_FALSE(assembled(charts, Wrap::uv));
}

TEST(Assemble, SquaresWhoseSidesFitAnywhereAreLeftAlone) {
  std::vector<Chart> charts;
  for (int i = 0; i < 5; ++i) {
    const double side = 1 + 0.3 * i;
    const std::vector<std::vector<Vec2>> loops{{{0, 0}, {side, 0}, {side, side}, {0, side}}};
    charts.push_back(*chart_from_loops(loops));
  }
  EXPECT_FALSE(assembled(charts, Wrap::uv));
}

TEST(Assemble, StopsWhenItIsTold) {
  const Sheet sheet(3, 0.15, Wrap::uv, 1);
  PackOptions options;
  options.width = options.height = 512;
  const auto frames = make_frames(options, 1);
  ASSERT_TRUE(frames);
  EXPECT_FALSE(
      assemble(shapes_of(sheet.charts), *frames, options, 10, Effort([] { return true; })));
}

}  // namespace
}  // namespace wrapatlas
