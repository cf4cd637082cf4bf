// Rotating calipers against looking at everything.
#include "charts/hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace wrapatlas {
namespace {

double box_area(std::span<const Vec2> hull, double direction) {
  Box2 box;
  const Vec2 side{std::cos(direction), std::sin(direction)};
  for (const Vec2 p : hull) box.add({dot(side, p - hull[0]), cross(side, p - hull[0])});
  return box.size().x * box.size().y;
}

Vec2 box_of(std::span<const Vec2> hull) {
  Box2 box;
  for (const Vec2 p : hull) box.add(p);
  return box.size();
}

double smallest_box_slowly(std::span<const Vec2> hull) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
    smallest = std::min(smallest, box_area(hull, std::atan2(side.y, side.x)));
  }
  return smallest;
}

double diameter_slowly(std::span<const Vec2> hull) {
  double longest = -1, direction = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      const Vec2 d = hull[j] - hull[i];
      if (dot(d, d) > longest) {
        longest = dot(d, d);
        direction = std::atan2(d.y, d.x);
      }
    }
  }
  return direction;
}

void expect_as_slow(std::span<const Vec2> points, const char* what) {
  const std::vector<Vec2> hull = convex_hull(points);
  EXPECT_EQ(diameter_direction(hull), diameter_slowly(hull)) << what << ", " << hull.size();
  const double slow = smallest_box_slowly(hull);
  const double longest = box_of(hull).x + box_of(hull).y;  // no area at all is measured as 1e-17
  EXPECT_NEAR(box_area(hull, smallest_box_direction(hull)), slow,
              1e-9 * slow + 1e-15 * longest * longest)
      << what << ", " << hull.size();
}

/// Far from the origin; every third one flat.
std::vector<Vec2> cloud(int round, int most, double flat, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec2> points(static_cast<std::size_t>(2 + round % most));
  for (Vec2& p : points) p = {100 + unit(random), (round % 3 == 0 ? flat : 1) * unit(random)};
  return points;
}

TEST(Hull, CalipersOnRandomPoints) {
  std::mt19937 random(3);
  for (int round = 0; round < 3000; ++round) {
    expect_as_slow(cloud(round, 40, 1e-3, random), "cloud");
  }
}

TEST(Hull, CalipersOnParallelSidesAndEqualDiameters) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> small(0, 6);
  for (int round = 0; round < 3000; ++round) {
    std::vector<Vec2> points(static_cast<std::size_t>(2 + round % 12));
    for (Vec2& p : points) p = {double(small(random)), double(small(random))};
    if (convex_hull(points).size() > 1) expect_as_slow(points, "grid");
  }
  for (int corners = 3; corners < 300; ++corners) {
    std::vector<Vec2> points;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979 * i / corners;
      points.push_back({1e3 + std::cos(angle), std::sin(angle)});
    }
    expect_as_slow(points, "polygon");
  }
}

TEST(Hull, AreaIsThatOfItsTriangles) {
  const std::vector<Vec2> points{{5, 5}, {0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}, {4, 0}};
  EXPECT_DOUBLE_EQ(hull_area(convex_hull(points)), 12 + 1.5 + 4);
  EXPECT_EQ(hull_area(convex_hull(std::vector<Vec2>{{1, 2}, {2, 4}, {3, 6}})), 0);
}

double smallest_square_slowly(std::span<const Vec2> hull) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200000; ++i) {
    const double angle = i * 1.5707963267948966 / 200000;
    const Vec2 x{std::cos(angle), std::sin(angle)};
    Box2 box;
    for (const Vec2 p : hull) box.add({dot(x, p), cross(x, p)});
    smallest = std::min(smallest, std::max(box.size().x, box.size().y));
  }
  return smallest;
}

TEST(Hull, SquareIsTheSmallestButForALittle) {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    const std::vector<Vec2> hull = convex_hull(cloud(round, 9, 1e-2, random));
    const double slow = smallest_square_slowly(hull);
    EXPECT_GE(square_side(hull), slow * (1 - 1e-5)) << round;
    EXPECT_LE(square_side(hull), slow * 1.004) << round;
  }
}

TEST(Hull, FewPoints) {
  EXPECT_EQ(hull_area({}), 0);
  EXPECT_EQ(diameter_direction({}), 0);
  EXPECT_EQ(smallest_box_direction({}), 0);
  EXPECT_EQ(square_side({}), 0);
  const std::vector<Vec2> one{{1, 2}}, two{{1, 2}, {1, 5}};
  EXPECT_EQ(diameter_direction(one), 0);
  EXPECT_EQ(smallest_box_direction(one), 0);
  EXPECT_EQ(square_side(one), 0);
  EXPECT_NEAR(diameter_direction(two), std::acos(0.0), 1e-12);
  EXPECT_NEAR(smallest_box_direction(two), std::acos(0.0), 1e-12);
  EXPECT_NEAR(square_side(two), 3 / std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace wrapatlas
