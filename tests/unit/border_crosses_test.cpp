// Borders that cross themselves, against all pairs of edges in exact integers.
#include <gtest/gtest.h>

#include <limits>

#include "parameterize/orient2d.h"
#include "support/surfaces.h"
#include "wrapatlas/parameterize.h"

namespace wrapatlas {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Triangles whose border is the polygon 0, 1, ... n - 1; where they lie does not matter.
Triangles polygon(std::uint32_t corners) {
  Triangles triangles;
  for (std::uint32_t i = 2; i < corners; ++i) triangles.push_back({0, i - 1, i});
  return triangles;
}
bool crosses(const std::vector<Vec2>& corners) {
  return border_crosses(corners, polygon(static_cast<std::uint32_t>(corners.size())));
}

__extension__ using Wide = __int128;
struct Point {
  std::int64_t x, y;
};
int side(Point a, Point b, Point c) {
  const Wide left = Wide(b.x - a.x) * (c.y - a.y), right = Wide(b.y - a.y) * (c.x - a.x);
  return (left > right) - (left < right);
}
bool between(Point a, Point b, Point p) {  // p is on their line
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}
bool on_segment(Point a, Point b, Point p) { return side(a, b, p) == 0 && between(a, b, p); }
bool segments_meet(Point a, Point b, Point c, Point d) {
  if (on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b)) {
    return true;
  }
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}
bool crosses_slowly(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (p[i].x == p[j].x && p[i].y == p[j].y) return true;
      const std::size_t i2 = (i + 1) % n, j2 = (j + 1) % n;
      if (i2 == j || j2 == i) {  // o is common; the far ends must not be on the other edge
        if (i2 == j && on_segment(p[i], p[i2], p[j2])) return true;
        if (i2 == j && on_segment(p[j], p[j2], p[i])) return true;
        if (j2 == i && on_segment(p[i], p[i2], p[j])) return true;
        if (j2 == i && on_segment(p[j], p[j2], p[i2])) return true;
      } else if (segments_meet(p[i], p[i2], p[j], p[j2])) {
        return true;
      }
    }
  }
  return false;
}

TEST(BorderCrosses, HandMadePolygons) {
  EXPECT_FALSE(crosses({{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(crosses({{0, 0}, {0, 1}, {1, 0}}));  // clockwise
  EXPECT_FALSE(crosses({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_TRUE(crosses({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(crosses({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}}));  // straight on
  EXPECT_TRUE(crosses({{0, 0}, {2, 0}, {1, 0}, {1, 1}}));                   // folds back
  EXPECT_TRUE(crosses({{0, 0}, {2, 0}, {1, 0}}));                           // no area
  EXPECT_TRUE(crosses({{0, 0}, {2, 0}, {0, 0}}));
  EXPECT_TRUE(crosses({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}));          // a corner on a side
  EXPECT_TRUE(crosses({{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}}));  // two at one place
  EXPECT_TRUE(crosses({{0, 0}, {1, 0}, {1, 0}, {0, 1}}));
  EXPECT_TRUE(crosses({{0, 0}, {6, 0}, {6, 1}, {1, 1}, {1, 0}, {5, 0}, {5, 2}, {0, 2}}));
  EXPECT_FALSE(crosses({}));
}

TEST(BorderCrosses, WhatIsNoNumberCrosses) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(crosses({{0, 0}, {nan, 0}, {0, 1}}));
  EXPECT_TRUE(crosses({{0, 0}, {1, 0}, {0, infinity}}));
  EXPECT_TRUE(crosses({{0, 0}, {0, 0}, {0, 0}}));
}

TEST(BorderCrosses, ManyLoops) {
  // Two squares apart, one inside of the other, and across.
  const auto squares = [](Vec2 corner, double size) {
    std::vector<Vec2> uv{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    for (const Vec2 p : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
      uv.push_back(corner + size * p);
    }
    return border_crosses(uv, Triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
  };
  EXPECT_FALSE(squares({5, 0}, 1));
  EXPECT_FALSE(squares({1, 1}, 1));
  EXPECT_TRUE(squares({3, 1}, 2));
  EXPECT_TRUE(squares({4, 1}, 1));
  // Triangles that share a point alone, and those that share an edge.
  const std::vector<Vec2> uv{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  EXPECT_TRUE(border_crosses(uv, Triangles{{0, 1, 2}, {0, 3, 4}}));
  EXPECT_FALSE(border_crosses(uv, Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_FALSE(border_crosses(uv, Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}));
}

TEST(BorderCrosses, AsAllPairsSay) {
  std::mt19937_64 random(1);
  int crossing = 0, simple = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::size_t corners = 3 + random() % 6;
    const std::int64_t size = 2 + static_cast<std::int64_t>(random() % 9);
    std::vector<Point> points;
    std::vector<Vec2> uv;
    for (std::size_t i = 0; i < corners; ++i) {
      const auto x = static_cast<std::int64_t>(random() % size);
      const auto y = static_cast<std::int64_t>(random() % size);
      points.push_back({x, y});
      uv.push_back({double(x), double(y)});
    }
    const bool expected = crosses_slowly(points);
    ++(expected ? crossing : simple);
    ASSERT_EQ(crosses(uv), expected) << "round " << round;
    for (const double scale : {0x1p-1040, 0x1p1000}) {  // bits of small ones are all kept
      std::vector<Vec2> scaled;
      for (const Vec2 p : uv) scaled.push_back(scale * p);
      ASSERT_EQ(crosses(scaled), expected) << "round " << round << ", scaled by " << scale;
    }
  }
  EXPECT_GT(crossing, 1000);
  EXPECT_GT(simple, 1000);
}

TEST(BorderCrosses, NearlyTouchingInTheLastBit) {
  // Corners are integers below 2^52 * 2^-52; a long edge almost through another corner.
  std::mt19937_64 random(2);
  int crossing = 0;
  for (int round = 0; round < 5000; ++round) {
    const auto whole = [&] { return static_cast<std::int64_t>(random() >> 12U); };
    const Point a{whole(), whole()}, b{whole(), whole()};
    Point c{a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
    c.x += static_cast<std::int64_t>(random() % 3) - 1;
    c.y += static_cast<std::int64_t>(random() % 3) - 1;
    const std::vector<Point> points{a, b, {whole(), whole()}, c, {whole(), whole()}};
    std::vector<Vec2> uv;
    for (const Point p : points) uv.push_back({0x1p-52 * double(p.x), 0x1p-52 * double(p.y)});
    const bool expected = crosses_slowly(points);
    crossing += expected;
    ASSERT_EQ(crosses(uv), expected) << "round " << round;
  }
  EXPECT_GT(crossing, 500);
  EXPECT_LT(crossing, 4500);
}

TEST(BorderCrosses, LongBordersTakeNoTime) {
  // A spiral, a comb and a circle of 200,000 corners each: all pairs would take minutes.
  const int n = 100000;
  std::vector<Vec2> spiral, comb, circle;
  for (int i = 0; i < n; ++i) {
    const double turn = 60.0 * i / n;
    spiral.push_back({(1 + turn) * std::cos(turn), (1 + turn) * std::sin(turn)});
  }
  for (int i = n; i-- > 0;) {
    const double turn = 60.0 * i / n;
    spiral.push_back({(2 + turn) * std::cos(turn), (2 + turn) * std::sin(turn)});
  }
  for (int i = 0; i < 2 * n; ++i) {
    const double angle = std::numbers::pi * i / n;
    comb.push_back({double(i), i % 2 == 0 ? 0.0 : 1000.0});
    circle.push_back({std::cos(angle), std::sin(angle)});
  }
  comb.insert(comb.end(), {{2.0 * n, -1}, {-1, -1}});
  EXPECT_FALSE(crosses(spiral));
  EXPECT_FALSE(crosses(comb));
  EXPECT_FALSE(crosses(circle));
  spiral[n / 2] = spiral[n / 3];
  EXPECT_TRUE(crosses(spiral));
  circle[n] = 1.0000001 * circle[0];
  EXPECT_TRUE(crosses(circle));
}

TEST(Orient2d, OnTheGridOfTheLastBits) {
  // Kettner et al. 2008: where plain doubles give noise.
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec2 p{0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53}, q{12, 12}, r{24, 24};
      EXPECT_EQ(orient2d(p, q, r), (j > i) - (j < i)) << i << " " << j;
      EXPECT_EQ(orient2d(q, r, p), (j > i) - (j < i));
      EXPECT_EQ(orient2d(r, q, p), (j < i) - (j > i));
    }
  }
}

}  // namespace
}  // namespace wrapatlas
