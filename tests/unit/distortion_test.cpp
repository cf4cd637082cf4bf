// Measures of distortion against maps whose distortion is known, and against slow ones.
#include <gtest/gtest.h>

#include <limits>

#include "support/surfaces.h"
#include "wrapatlas/parameterize.h"

namespace wrapatlas {
namespace {

using test::bumpy;
using test::Surface;
using test::uniform;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Vec2> mapped(const Surface& surface, Vec2 x, Vec2 y) {
  std::vector<Vec2> uv;
  for (const Vec3& p : surface.points) uv.push_back(p.x * x + p.y * y);
  return uv;
}

TEST(Distortion, OfLinearMaps) {
  const Surface flat = bumpy(5, 0, 1);
  // Any turn at any size is none.
  const Distortion none =
      measure_distortion(flat.points, mapped(flat, {3, 4}, {-4, 3}), flat.triangles);
  for (const double value : {none.l2, none.linf, none.angle, none.area})
    EXPECT_NEAR(value, 1, 1e-12);
  EXPECT_EQ(none.flipped, 0U);
  // 2 by 1/2: the map to space has singular values 1/2 and 2.
  const Distortion wide =
      measure_distortion(flat.points, mapped(flat, {2, 0}, {0, 0.5}), flat.triangles);
  EXPECT_NEAR(wide.l2, std::sqrt((4 + 0.25) / 2), 1e-12);
  EXPECT_NEAR(wide.linf, 2, 1e-12);
  EXPECT_NEAR(wide.angle, (4 + 0.25) / 2, 1e-12);
  EXPECT_NEAR(wide.area, 1, 1e-12);
  // A shear by 1: singular values are the golden ratio and its inverse.
  const Distortion shear =
      measure_distortion(flat.points, mapped(flat, {1, 0}, {1, 1}), flat.triangles);
  EXPECT_NEAR(shear.linf, (1 + std::sqrt(5.0)) / 2, 1e-12);
  EXPECT_NEAR(shear.l2, std::sqrt(1.5), 1e-12);
}

TEST(Distortion, OfAreas) {
  // Two triangles of the same area in space, one of them scaled by 2: A2 / A3 = (1 + 4) / 2.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const std::vector<Vec2> uv{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {0, 2}, {0, 0}};
  const Distortion found = measure_distortion(
      points, uv, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {5, 3, 4}});
  EXPECT_NEAR(found.area, (2.5 + 4 / 2.5) / 2, 1e-12);
  EXPECT_NEAR(found.l2, std::sqrt((1 + 0.25) / 2 * 2.5), 1e-12);
  EXPECT_NEAR(found.linf, std::sqrt(2.5), 1e-12);
  EXPECT_NEAR(found.angle, 1, 1e-12);
}

/// How much longer a vector in the plane becomes in space, at most and at least: by trying.
std::pair<double, double> stretch_slowly(const Surface& surface, const std::vector<Vec2>& uv,
                                         std::size_t t) {
  const auto& [i, j, k] = surface.triangles[t];
  const Vec2 p = uv[j] - uv[i], q = uv[k] - uv[i];
  double most = 0, least = kInfinity;
  const int steps = 20000;
  for (int step = 0; step < steps; ++step) {
    const double angle = std::numbers::pi * step / steps;
    const Vec2 d{std::cos(angle), std::sin(angle)};
    const double of_p = cross(d, q) / cross(p, q), of_q = cross(p, d) / cross(p, q);
    const double stretch = length(of_p * (surface.points[j] - surface.points[i]) +
                                  of_q * (surface.points[k] - surface.points[i]));
    most = std::max(most, stretch);
    least = std::min(least, stretch);
  }
  return {most, least};
}

TEST(Distortion, AsMeasuredSlowly) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 20; ++round) {
    const Surface surface = bumpy(3, 0.3, random());
    std::vector<Vec2> uv = mapped(surface, {1, 0.2}, {0.1, 1.5});
    for (Vec2& p : uv) p = p + Vec2{uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05)};
    const Distortion found = measure_distortion(surface.points, uv, surface.triangles);
    ASSERT_EQ(found.flipped, 0U);
    double space = 0, plane = 0, l2 = 0, linf = 0, angle = 0, area = 0;
    std::vector<double> areas, growths;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto [most, least] = stretch_slowly(surface, uv, t);
      const auto& [i, j, k] = surface.triangles[t];
      const double flat = signed_area2(uv[i], uv[j], uv[k]) / 2, solid = flat * most * least;
      space += solid;
      plane += flat;
      l2 += solid * (most * most + least * least) / 2;
      linf = std::max(linf, most);
      angle += solid * (most / least + least / most) / 2;
      areas.push_back(solid);
      growths.push_back(flat / solid);
    }
    for (std::size_t t = 0; t < areas.size(); ++t) {
      const double growth = growths[t] * space / plane;
      area += areas[t] * std::max(growth, 1 / growth);
    }
    EXPECT_NEAR(found.l2, std::sqrt(l2 / space * plane / space), 1e-5);
    EXPECT_NEAR(found.linf, linf * std::sqrt(plane / space), 1e-5);
    EXPECT_NEAR(found.angle, angle / space, 1e-5);
    EXPECT_NEAR(found.area, area / space, 1e-5);
  }
}

TEST(Distortion, FlippedTrianglesAreCounted) {
  const Surface flat = bumpy(4, 0, 1);
  std::vector<Vec2> uv = mapped(flat, {1, 0}, {0, 1});
  const Distortion before = measure_distortion(flat.points, uv, flat.triangles);
  EXPECT_EQ(before.flipped, 0U);
  uv[12] = uv[12] + Vec2{0.4, 0};  // over the edges of two of its triangles
  const Distortion after = measure_distortion(flat.points, uv, flat.triangles);
  std::uint32_t flipped = 0;
  for (const auto& [a, b, c] : flat.triangles) flipped += signed_area2(uv[a], uv[b], uv[c]) <= 0;
  EXPECT_GT(flipped, 0U);
  EXPECT_EQ(after.flipped, flipped);
  EXPECT_EQ(after.l2, kInfinity);
  EXPECT_EQ(after.linf, kInfinity);
  EXPECT_TRUE(std::isfinite(after.angle) && std::isfinite(after.area));
  // Seen from below all are.
  const Distortion below =
      measure_distortion(flat.points, mapped(flat, {-1, 0}, {0, 1}), flat.triangles);
  EXPECT_EQ(below.flipped, flat.triangles.size());
  // On a line, none has an area.
  const Distortion line =
      measure_distortion(flat.points, mapped(flat, {1, 0}, {1, 0}), flat.triangles);
  EXPECT_EQ(line.flipped, flat.triangles.size());
}

TEST(Distortion, TrianglesOfNoAreaInSpaceCountOnlyWhereTheyTurn) {
  Surface flat{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 0, 0}}, {}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}};
  std::vector<Vec2> uv = mapped(flat, {1, 0}, {0, 1});
  const auto found = [&] { return measure_distortion(flat.points, uv, flat.triangles); };
  EXPECT_EQ(found().flipped, 0U);
  EXPECT_NEAR(found().linf, 1, 1e-12);
  uv[4].y = 1e-14;  // rounding
  EXPECT_EQ(found().flipped, 0U);
  uv[4].y = -0.01;
  EXPECT_EQ(found().flipped, 0U);
  uv[4].y = 0.01;
  EXPECT_EQ(found().flipped, 1U);
  EXPECT_EQ(found().l2, kInfinity);
  const Distortion nothing =
      measure_distortion(flat.points, uv, std::vector<std::array<std::uint32_t, 3>>{});
  EXPECT_EQ(nothing.l2, 1);
  EXPECT_EQ(nothing.flipped, 0U);
}

}  // namespace
}  // namespace wrapatlas
