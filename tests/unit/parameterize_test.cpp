// What flattened discs must look like, however they are found; the equations are in labf_test.cpp.
#include "wrapatlas/parameterize.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/surfaces.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

using test::bumpy;
using test::cap;
using test::fan;
using test::grid;
using test::Surface;
using test::uniform;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kBoth = {FlattenMethod::labf, FlattenMethod::lscm};

Flattening flatten(const Surface& surface, FlattenMethod method, int iterations = 2) {
  auto flat = flatten_disc(surface.points, surface.triangles, {method, iterations});
  EXPECT_TRUE(flat) << (flat ? "" : flat.error().message());
  return flat ? *flat : Flattening{std::vector<Vec2>(surface.points.size()), method};
}

Distortion distortion(const Surface& surface, const Flattening& flat) {
  return measure_distortion(surface.points, flat.uv, surface.triangles);
}

struct Areas {
  double space = 0, plane = 0, signed_plane = 0;
};
Areas areas(const Surface& surface, const std::vector<Vec2>& uv) {
  Areas sum;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto& p = surface.points;
    const double plane = signed_area2(uv[a], uv[b], uv[c]) / 2;
    sum.space += length(cross(p[b] - p[a], p[c] - p[a])) / 2;
    sum.plane += std::abs(plane);
    sum.signed_plane += plane;
  }
  return sum;
}

/// All that is promised of any disc.
void expect_sound(const Surface& surface, const Flattening& flat, const std::string& what) {
  ASSERT_EQ(flat.uv.size(), surface.points.size()) << what;
  for (const Vec2 p : flat.uv) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << what;
  const Areas sum = areas(surface, flat.uv);
  EXPECT_NEAR(sum.plane, sum.space, 1e-9 * sum.space) << what;
  EXPECT_GT(sum.signed_plane, 0.5 * sum.space) << what;
  EXPECT_TRUE(std::isfinite(flat.wheel_residual)) << what;
}

/// The map to the plane moves and turns, and does nothing else.
void expect_isometric(const Surface& surface, const std::vector<Vec2>& expected,
                      const std::string& what) {
  for (const FlattenMethod method : kBoth) {
    const Flattening flat = flatten(surface, method);
    EXPECT_EQ(flat.method, method) << what;
    expect_sound(surface, flat, what);
    const Distortion found = distortion(surface, flat);
    EXPECT_NEAR(found.l2, 1, 1e-9) << what;
    EXPECT_NEAR(found.linf, 1, 1e-9) << what;
    EXPECT_NEAR(found.angle, 1, 1e-9) << what;
    EXPECT_NEAR(found.area, 1, 1e-9) << what;
    EXPECT_EQ(found.flipped, 0U) << what;
    const double size = length(expected.front() - expected.back());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::size_t j = (7 * i + 3) % expected.size();
      EXPECT_NEAR(length(flat.uv[i] - flat.uv[j]), length(expected[i] - expected[j]), 1e-9 * size)
          << what << ", points " << i << " and " << j;
    }
  }
}

std::vector<Vec2> without_z(const std::vector<Vec3>& points) {
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.push_back({p.x, p.y});
  return flat;
}

/// p -> size * R p + move, R made of two turns.
std::vector<Vec3> moved(std::vector<Vec3> points, double size, double angle, const Vec3& move) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Vec3& p : points) {
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    p = size * Vec3{p.x, c * p.y - s * p.z, s * p.y + c * p.z} + move;
  }
  return points;
}

TEST(Flatten, FlatDiscsStayAsTheyAre) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 30; ++round) {
    Surface surface = bumpy(3 + round % 9, 0, random(), 0.3);
    const double size = std::pow(10, uniform(random, -8, 8)), angle = uniform(random, 0, 6);
    std::vector<Vec2> expected = without_z(surface.points);
    for (Vec2& p : expected) p = size * p;
    surface.points = moved(surface.points, size, angle, size * Vec3{3, -2, 1});
    if (round % 2 != 0) {  // as seen from below
      for (auto& triangle : surface.triangles) std::swap(triangle[0], triangle[1]);
    }
    expect_isometric(surface, expected, "round " + std::to_string(round));
  }
}

TEST(Flatten, NeedlesOfFlatDiscsStayAsTheyAre) {
  const Surface narrow = grid(100, 4, [](double x, double y) { return Vec3{x * x, y, 0}; });
  expect_isometric(narrow, without_z(narrow.points), "narrow squares");
  std::mt19937_64 random(2);
  std::vector<Vec3> circle;
  for (int i = 0; i < 200; ++i) {
    const double angle = std::numbers::pi / 100 * (i + uniform(random, 0, 0.8));
    circle.push_back({std::cos(angle), std::sin(angle), 0});
  }
  const Surface wheel = fan(circle, {0.2, -0.1, 0});
  expect_isometric(wheel, without_z(wheel.points), "a wheel of needles");
  Surface obtuse{{{0, 0, 0}, {1, 1e-3, 0}, {2, 0, 0}, {1, 2e-3, 0}, {1, 1, 0}}, {}};
  obtuse.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {3, 2, 4}};
  expect_isometric(obtuse, without_z(obtuse.points), "obtuse needles");
}

TEST(Flatten, ACylinderUnrolls) {
  const int columns = 40;
  const double step = 5.0 / columns, chord = 2 * std::sin(step / 2);
  const Surface surface = grid(columns, 7, [](double x, double y) {
    return Vec3{std::cos(5 * x), std::sin(5 * x), 3 * y};
  });
  const Surface plane = grid(columns, 7, [&](double x, double y) {
    return Vec3{columns * chord * x, 3 * y, 0};
  });
  expect_isometric(surface, without_z(plane.points), "cylinder");
}

TEST(Flatten, FewTriangles) {
  const Surface one{{{0, 0, 0}, {3, 0, 0}, {0, 0, 4}}, {{0, 1, 2}}};
  expect_isometric(one, {{0, 0}, {3, 0}, {0, 4}}, "one");
  const Surface two{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}}};
  expect_isometric(two, {{0, 0}, {1, 0}, {1, 1}, {0, -1}}, "two");
  std::vector<Vec3> square{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const double height : {0.0, 0.3, 3.0}) {
    const Surface pyramid = fan(square, {0, 0, height});
    for (const FlattenMethod method : kBoth) {
      const Flattening flat = flatten(pyramid, method);
      expect_sound(pyramid, flat, "pyramid");
      EXPECT_LT(flat.wheel_residual, 1e-14);
      if (method == FlattenMethod::lscm && height > 0) continue;  // the pinned corners stand out
      // By symmetry its base stays a square, around the tip.
      for (std::size_t i = 1; i < 5; ++i) {
        const Vec2 side = flat.uv[i] - flat.uv[0], next = flat.uv[i % 4 + 1] - flat.uv[0];
        EXPECT_NEAR(dot(side, next), 0, 1e-9);
        EXPECT_NEAR(length(side), length(next), 1e-9);
      }
    }
  }
  // A fan around a point of its border has no point inside.
  Surface open = fan({{1, 0, 0}, {1, 1, 1}, {0, 2, 0}, {-2, 1, 1}, {-1, 0, 0}}, {0, 0, 0});
  open.triangles.pop_back();
  for (const FlattenMethod method : kBoth) {
    const Flattening flat = flatten(open, method);
    EXPECT_NEAR(distortion(open, flat).linf, 1, 1e-9);  // each triangle hinges on one neighbour
  }
}

TEST(Flatten, CapsAndSaddles) {
  // A conformal map of a half sphere: r = tan(angle / 2), so the scale varies by 2.
  const Surface half = cap(40, std::numbers::pi / 2);
  const Flattening labf = flatten(half, FlattenMethod::labf);
  const Flattening lscm = flatten(half, FlattenMethod::lscm);
  const Distortion a = distortion(half, labf), b = distortion(half, lscm);
  for (const Distortion& found : {a, b}) {
    EXPECT_EQ(found.flipped, 0U);
    EXPECT_LT(found.angle, 1.001);
    // 1 / scale^2 = (1 + cos)^2 / 4 has its mean over the area at 7 / 12; and A2/A3 = 1/2 of
    // 4 (pi tan^2 (pi/4)) / 2 pi. So L2^2 = 7 / 6.
    EXPECT_NEAR(found.l2, std::sqrt(7.0 / 6), 0.005);
    EXPECT_NEAR(found.linf, std::sqrt(2.0), 0.01);
  }
  EXPECT_LT(a.angle - 1, 2 * (b.angle - 1));
  EXPECT_LT(b.angle - 1, 2 * (a.angle - 1));

  const Surface most = cap(30, 0.85 * std::numbers::pi);
  const Surface saddle = grid(30, 30, [](double x, double y) {
    x -= 0.5;
    y -= 0.5;
    return Vec3{x, y, 2 * (x * x - y * y)};
  });
  for (const FlattenMethod method : kBoth) {
    for (const Surface& surface : {most, saddle}) {
      const Flattening flat = flatten(surface, method);
      EXPECT_EQ(flat.method, method);
      expect_sound(surface, flat, "cap or saddle");
      EXPECT_EQ(distortion(surface, flat).flipped, 0U);
      EXPECT_FALSE(border_crosses(flat.uv, surface.triangles));
    }
  }
}

TEST(Flatten, WheelsCloseQuadratically) {
  for (const Surface& surface : {cap(30, std::numbers::pi / 2), bumpy(30, 0.1, 5)}) {
    std::array<double, 3> error;
    for (int i = 0; i < 3; ++i) {
      error[i] = flatten(surface, FlattenMethod::labf, i + 1).wheel_residual;
    }
    EXPECT_LT(error[0], 1e-2);
    EXPECT_GT(error[0], 1e-8);
    EXPECT_LT(error[1], error[0] * error[0] + 1e-13);
    EXPECT_LT(error[2], 1e-12);
  }
}

TEST(Flatten, ResultDoesNotDependOnSizeAndPlace) {
  const Surface surface = cap(12, 1.3);
  for (const FlattenMethod method : kBoth) {
    const Distortion before = distortion(surface, flatten(surface, method));
    for (const double size : {1e-25, 1e-3, 1e25}) {
      Surface other = surface;
      other.points = moved(surface.points, size, 1, size * Vec3{5, 6, 7});
      const Flattening flat = flatten(other, method);
      expect_sound(other, flat, "sized");
      const Distortion after = distortion(other, flat);
      EXPECT_NEAR(before.l2, after.l2, 1e-9);
      EXPECT_NEAR(before.linf, after.linf, 1e-9);
      EXPECT_NEAR(before.angle, after.angle, 1e-9);
    }
  }
}

TEST(Flatten, TrianglesOfNoArea) {
  // A corner in the middle of a neighbour's side, closed by a triangle of no area.
  Surface flat{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0, 0}, {1, -2, 0}}, {}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {0, 5, 4}, {4, 5, 1}};
  const Flattening kept = flatten(flat, FlattenMethod::lscm);
  EXPECT_NEAR(distortion(flat, kept).linf, 1, 1e-9);
  const Flattening bent = flatten(flat, FlattenMethod::labf);
  EXPECT_EQ(bent.method, FlattenMethod::labf);
  expect_sound(flat, bent, "in a side");
  EXPECT_LT(distortion(flat, bent).linf, 1.2);

  std::mt19937_64 random(3);
  for (int round = 0; round < 60; ++round) {
    Surface surface = bumpy(6, 0.05, random(), 0.1);
    for (int k = 0; k < 2; ++k) {
      auto [a, b, c] = surface.triangles[random() % surface.triangles.size()];
      const double t = k == 0 ? 0.5 : 0;  // into the middle of a side, or onto its end
      surface.points[a] = surface.points[b] + t * (surface.points[c] - surface.points[b]);
    }
    for (const FlattenMethod method : kBoth) {
      expect_sound(surface, flatten(surface, method), "round " + std::to_string(round));
    }
  }
}

TEST(Flatten, RandomDiscsAreSound) {
  std::mt19937_64 random(4);
  int flipped = 0, fell_back = 0;
  for (int round = 0; round < 150; ++round) {
    const double height = uniform(random, 0, 0.4);
    const Surface surface = bumpy(2 + round % 15, height, random());
    for (const FlattenMethod method : kBoth) {
      const Flattening flat = flatten(surface, method, 1 + round % 4);
      expect_sound(surface, flat, "round " + std::to_string(round));
      if (method == FlattenMethod::labf) flipped += distortion(surface, flat).flipped > 0;
      if (flat.method != method) ++fell_back;
    }
  }
  EXPECT_EQ(flipped, 0);
  EXPECT_EQ(fell_back, 0);
}

TEST(Flatten, CrumpledDiscsFallBackToLscm) {
  std::mt19937_64 random(5);
  int fell_back = 0;
  for (int round = 0; round < 60; ++round) {
    const int n = 5 + round % 6;
    const Surface surface = grid(n, n, [&](double x, double y) {
      const auto shake = [&] { return uniform(random, -1, 1) / n; };
      return Vec3{x + shake(), y + shake(), shake()};
    });
    const Flattening flat = flatten(surface, FlattenMethod::labf);
    for (const Vec2 p : flat.uv) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
    const Areas sum = areas(surface, flat.uv);
    EXPECT_NEAR(sum.plane, sum.space, 1e-9 * sum.space);
    if (flat.method == FlattenMethod::labf) continue;
    ++fell_back;
    EXPECT_EQ(flat.uv, flatten(surface, FlattenMethod::lscm).uv);
    EXPECT_EQ(flat.wheel_residual, 0);
  }
  EXPECT_GT(fell_back, 10);
}

TEST(Flatten, ManyAtOnceOnThreadsAreTheSame) {
  std::vector<Surface> surfaces;
  for (int i = 0; i < 24; ++i) surfaces.push_back(bumpy(4 + i, 0.1, 10 + i));
  std::vector<Flattening> alone, together(surfaces.size());
  for (const Surface& surface : surfaces) alone.push_back(flatten(surface, FlattenMethod::labf));
  parallel_for(surfaces.size(), 4, [&](std::size_t i) {
    together[i] = *flatten_disc(surfaces[i].points, surfaces[i].triangles);
  });
  for (std::size_t i = 0; i < surfaces.size(); ++i) EXPECT_EQ(alone[i].uv, together[i].uv);
}

/// The error's one line for a disc that is none.
std::string complaint(const Surface& surface, FlattenOptions options = {}) {
  const auto flat = flatten_disc(surface.points, surface.triangles, options);
  return flat ? "none" : flat.error().message();
}

TEST(FlattenErrors, SayWhereWhatAndTheWayOut) {
  const std::string cut =
      "; only a disc can be flattened: cut the chart into pieces that are discs";
  const Surface good = bumpy(3, 0.1, 1);
  Surface bad = good;
  EXPECT_EQ(complaint(good), "none");
  EXPECT_EQ(complaint(good, {FlattenMethod::labf, 0}),
            "iterations: 0 is out of range; choose 1 to 20");
  EXPECT_EQ(complaint(good, {FlattenMethod::labf, 21}),
            "iterations: 21 is out of range; choose 1 to 20");
  EXPECT_EQ(complaint({}), "chart: it has no triangles; pass at least one triangle");
  bad.triangles[4][1] = 16;
  EXPECT_EQ(complaint(bad), "triangle 4: it refers to point 16 of 16; pass indices of points");
  bad.triangles[4][1] = bad.triangles[4][0];
  EXPECT_EQ(complaint(bad),
            "triangle 4: it has a point twice; leave out triangles that are edges or points");
  bad = good;
  bad.points.push_back({0, 0, 0});
  EXPECT_EQ(complaint(bad), "point 16: no triangle uses it; pass only the points of the chart");
  for (const double value : {std::nan(""), kInfinity, -kInfinity, 1e30}) {
    bad = good;
    bad.points[5].z = value;
    EXPECT_EQ(complaint(bad),
              "point 5: a coordinate is not a usable number; pass finite coordinates of magnitude "
              "below 1e30");
  }
  bad = good;
  bad.triangles.resize((1U << 22U) + 1);
  EXPECT_EQ(complaint(bad),
            "chart: it has 4194305 triangles; cut it into charts of at most 4194304");
  bad = good;
  for (Vec3& p : bad.points) p = {p.x, 2 * p.x, 0};
  EXPECT_EQ(complaint(bad), "chart: it has no area; leave it out, or merge it with a neighbour");
  for (Vec3& p : bad.points) p = {1, 2, 3};
  EXPECT_EQ(complaint(bad), "chart: it has no area; leave it out, or merge it with a neighbour");
  bad = good;
  std::swap(bad.triangles[0][0], bad.triangles[0][1]);
  EXPECT_EQ(complaint(bad),
            "edge 1-4: its triangles are oriented against each other; orient all triangles alike, "
            "or cut the chart if it is one-sided");

  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  EXPECT_EQ(complaint({corners, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}),
            "edge 0-1: more than two triangles meet at it" + cut);
  const Surface closed{{corners.begin(), corners.begin() + 4},
                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  EXPECT_EQ(complaint(closed), "chart: it has no border" + cut);
  EXPECT_EQ(complaint({corners, {{0, 1, 2}, {0, 3, 4}}}), "point 0: the border meets itself" + cut);
  bad = good;
  bad.triangles.erase(bad.triangles.begin() + 8, bad.triangles.begin() + 10);
  EXPECT_EQ(complaint(bad), "chart: it has more than one border" + cut);
}

TEST(FlattenErrors, WhatEulerAloneWouldNotSee) {
  const std::string cut =
      "; only a disc can be flattened: cut the chart into pieces that are discs";
  // A closed surface that touches the disc in an inner point, and one that does not touch it.
  const Surface disc = fan({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {0, 0, 0});
  Surface touching = disc;
  touching.points.insert(touching.points.end(), {{1, 0, 1}, {0, 1, 1}, {-1, -1, 1}});
  touching.triangles.insert(touching.triangles.end(), {{0, 5, 6}, {0, 6, 7}, {0, 7, 5}, {5, 7, 6}});
  EXPECT_EQ(complaint(touching), "point 0: parts of the chart meet at it alone" + cut);
  Surface apart = touching;
  apart.points.push_back({0, 0, 2});
  for (std::size_t t = 4; t < 8; ++t) {
    for (std::uint32_t& p : apart.triangles[t]) p = p == 0 ? 8 : p;
  }
  EXPECT_EQ(complaint(apart), "chart: its triangles are not connected" + cut);
  // A torus with a triangle taken out: one border, and a handle.
  const int n = 5;
  Surface torus;
  for (int i = 0; i < n * n; ++i) {
    const int column = i % n, row = i / n;
    const double u = 2 * std::numbers::pi * column / n, v = 2 * std::numbers::pi * row / n;
    torus.points.push_back(
        {(2 + std::cos(u)) * std::cos(v), (2 + std::cos(u)) * std::sin(v), std::sin(u)});
    const auto at = [&](int a, int b) {
      return static_cast<std::uint32_t>((column + a) % n + (row + b) % n * n);
    };
    torus.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
    torus.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
  }
  torus.triangles.pop_back();
  EXPECT_EQ(complaint(torus), "chart: it has a handle" + cut);
}

}  // namespace
}  // namespace wrapatlas
