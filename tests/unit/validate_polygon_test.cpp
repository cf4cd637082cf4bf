// What the judge takes a polygon for, however it is turned, rounded or cut up.
#include <gtest/gtest.h>

#include <random>

#include "unit/validate_helpers.h"
#include "validate/crossing.h"
#include "validate/polygon.h"
#include "validate/slabs.h"
#include "validate/stored.h"

namespace wrapatlas {
namespace {

using validate::Triangle;

double distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return length(a + t * along - p);
}

/// Negative inside.
double distance(Vec2 p, const Triangle& t) {
  double least = 1e300, inside = 1;
  const double sign = signed_area2(t[0], t[1], t[2]) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, distance(p, t[i], t[(i + 1) % 3]));
    if (sign * signed_area2(t[i], t[(i + 1) % 3], p) <= 0) inside = 0;
  }
  return inside > 0 ? -least : least;
}

double distance(Vec2 p, const std::vector<Triangle>& triangles) {
  double least = 1e300;
  for (const Triangle& t : triangles) least = std::min(least, distance(p, t));
  return least;
}

int winding(Vec2 p, const std::vector<Vec2>& polygon) {
  int winding = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (a.y <= p.y && b.y > p.y && signed_area2(a, b, p) > 0) ++winding;
    if (b.y <= p.y && a.y > p.y && signed_area2(a, b, p) < 0) --winding;
  }
  return winding;
}

std::vector<Vec2> on_grid(std::mt19937& random, int corners, std::uint32_t side) {
  std::vector<Vec2> polygon;
  for (int i = 0; i < corners; ++i) {
    polygon.push_back({static_cast<double>(random() % side), static_cast<double>(random() % side)});
  }
  return polygon;
}

/// Places off the grid, and so off most sides.
std::vector<Vec2> probes(std::uint32_t side) {
  std::vector<Vec2> points;
  for (int i = 0; - 0.37 + 0.29 * i < side; ++i) {
    for (int j = 0; - 0.41 + 0.31 * j < side; ++j) {
      points.push_back({-0.37 + 0.29 * i, -0.41 + 0.31 * j});
    }
  }
  return points;
}

TEST(ValidatePolygon, SlabsCoverWhatTheOutlineWindsAround) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Vec2> polygon = on_grid(random, 4 + round % 7, 7);
    std::vector<Triangle> triangles;
    validate::cover_by_slabs(polygon, triangles);
    if (validate::crosses_itself(polygon, 0)) continue;  // between corners sides stay in order
    for (const Vec2 p : probes(7)) {
      bool on_outline = false;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        on_outline =
            on_outline || distance(p, polygon[i], polygon[(i + 1) % polygon.size()]) < 1e-9;
      }
      if (on_outline) continue;
      EXPECT_EQ(distance(p, triangles) < 1e-9, winding(p, polygon) != 0) << "round " << round;
    }
  }
}

TEST(ValidatePolygon, TurningAndRoundingMoveWhatIsCoveredByNoMoreThanThat) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  int crossing = 0, touching = 0;
  for (int round = 0; round < 400; ++round) {
    const std::vector<Vec2> polygon = on_grid(random, 4 + round % 6, 6);
    const double off = 1e-7, angle = 3 * unit(random);
    const Similarity turn = Similarity::from(1, angle, {unit(random), unit(random)});
    std::vector<Vec2> turned;
    for (const Vec2 p : polygon) {
      turned.push_back(turn.apply(p) + Vec2{off * unit(random), off * unit(random)});
    }
    std::vector<Triangle> before, after;
    const bool crosses = validate::cover_polygon(polygon, 2 * off, before);
    EXPECT_EQ(validate::cover_polygon(turned, 2 * off, after), crosses) << "round " << round;
    ++(crosses ? crossing : touching);
    for (const Vec2 p : probes(6)) {
      const double was = distance(p, before), is = distance(turn.apply(p), after);
      if (std::abs(was) < 1e-5 && std::abs(is) < 1e-5) continue;  // on the outline
      ASSERT_EQ(was < 1e-6, is < 1e-6) << "round " << round << " at " << p.x << ", " << p.y;
    }
  }
  EXPECT_GT(crossing, 50);
  EXPECT_GT(touching, 50);
}

TEST(ValidatePolygon, OneThatCrossesItselfIsItsHull) {
  Builder b;
  b.face({{0, 0}, {20, 20}, {20, 0}, {0, 20}});  // its sides leave the upper quarter free
  b.face({{8, 18}, {12, 18}, {10, 14}});         // which is where this one lies
  const CheckReport report = check(b.mesh, options_of());
  EXPECT_EQ(kinds(report), Kinds{Violation::overlap});
  ASSERT_EQ(report.remarks.size(), 1U);
  EXPECT_NE(report.remarks[0].find("face 0 crosses itself"), std::string::npos);
}

TEST(ValidatePolygon, OneThatCrossesByRoundingIsNot) {
  for (const double through : {-1e-7, 0.0, 1e-7, 0.01}) {
    Builder b;  // a corner comes to the opposite side from inside, or goes through it
    b.face({{0, 10}, {40, 10}, {40, 30}, {20, 10 - through}, {0, 30}});
    b.face({{18, 22}, {22, 22}, {20, 18}});
    EXPECT_EQ(kinds(check(b.mesh, options_of())),
              through > 0.001 ? Kinds{Violation::overlap} : Kinds{})
        << through;
  }
}

TEST(ValidateStored, FloatsInBitsAndAsText) {
  const auto error = [](std::initializer_list<double> values) {
    validate::Stored stored;
    bool all = true;
    for (const double value : values) all = stored.as_floats(value) && all;
    return all ? stored.float_error() : 0;
  };
  const double half = 1.0 / (1 << 24), third = static_cast<float>(1.0 / 3);
  EXPECT_EQ(error({0.5, third, -1e20F}), half);
  EXPECT_EQ(error({0.5, 0.1, 0.33333334}), 2 * half);              // shortest
  EXPECT_EQ(error({0.5, 0.100000001, 0.333333343}), half + 5e-9);  // nine digits
  EXPECT_EQ(error({0.5, 0.1, 0.3333333333}), 0);
  EXPECT_EQ(error({1.0 / 3, 0.5}), 0);
}

/// The text of an OBJ: it tells the floats, but is up to half of their last bit beside them.
TEST(ValidateStored, TextOfFloatsMayBeAWholeUnitOff) {
  Builder b;
  b.width = b.height = 16384;
  b.face({{8191, 100}, {16000, 3}, {9000, 12000}});
  Mesh atlas = b.mesh;
  for (Vec2& uv : atlas.texcoords) {
    for (double* x : {&uv.x, &uv.y}) {
      char text[32];
      const volatile float stored = static_cast<float>(*x);
      std::snprintf(text, sizeof text, "%.8g", static_cast<double>(stored));
      *x = std::strtod(text, nullptr);
    }
  }
  CheckOptions options = options_of();
  options.width = options.height = 16384;
  options.tolerance = 0;
  EXPECT_TRUE(check(atlas, options, &b.mesh).ok());
  atlas.texcoords[0].x += 0.05 / 16384;
  EXPECT_EQ(kinds(check(atlas, options, &b.mesh)), Kinds{Violation::not_similar});
}

}  // namespace
}  // namespace wrapatlas
