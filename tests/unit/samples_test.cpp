// Which samples of a picture a triangle has.
#include "render/samples.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/shapes.h"
#include "support/solids.h"

namespace wrapatlas {
namespace {

constexpr PixelBox kBox{0, 0, 40, 30};

std::vector<int> visits_of(const std::vector<std::array<Vec2, 3>>& triangles) {
  std::vector<int> visits(std::size_t(kBox.width()) * kBox.height(), 0);
  for (const auto& triangle : triangles) {
    for_each_span(triangle, kBox, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x) ++visits[std::size_t(y) * kBox.width() + x];
    });
  }
  return visits;
}

TEST(Samples, AreThoseInsideTheTriangle) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 300; ++round) {
    std::array<Vec2, 3> corner;
    for (Vec2& p : corner) p = {test::uniform(random, -20, 60), test::uniform(random, -20, 50)};
    const std::vector<int> visits = visits_of({corner});
    const double area = signed_area2(corner[0], corner[1], corner[2]);
    for (int y = 0; y < kBox.height(); ++y) {
      for (int x = 0; x < kBox.width(); ++x) {
        double depth = 1e9;  // in doubles' noise of an edge either answer is right
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec2 p{double(x), double(y)};
          const double twice = signed_area2(corner[i], corner[(i + 1) % 3], p);
          depth = std::min(depth, area > 0 ? twice : -twice);
        }
        if (std::abs(depth) < 1e-9) continue;
        ASSERT_EQ(visits[std::size_t(y) * kBox.width() + x], depth > 0 ? 1 : 0) << x << " " << y;
      }
    }
  }
}

TEST(Samples, BelongToOneOfTheTrianglesThatShareAnEdge) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 40; ++round) {
    // Corners on samples, or anywhere; every second triangle the other way round.
    Mesh mesh = test::with_turned_faces(test::sheet(12), 2);
    for (Vec3& p : mesh.positions) {
      const bool inner = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1;
      const double by = inner ? 0.02 : 0;
      p = p + Vec3{test::uniform(random, -by, by), test::uniform(random, -by, by), 0};
      p = {p.x * 60 - 10, p.y * 50 - 10, 0};
      if (round % 2 == 0) p = {std::round(p.x), std::round(p.y), 0};
    }
    std::vector<std::array<Vec2, 3>> triangles;
    for (std::size_t c = 0; c < mesh.corner_count(); c += 3) {
      std::array<Vec2, 3> corner;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = mesh.positions[mesh.corner_position[c + i]];
        corner[i] = {p.x, p.y};
      }
      triangles.push_back(corner);
    }
    for (const int visits : visits_of(triangles)) ASSERT_EQ(visits, 1);
  }
}

TEST(Samples, NoneOfWhatHasNoAreaOrNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Vec2 p :
       {Vec2{2, 2}, {1, 1}, {9, 9}, {nan, 3}, {3, infinity}, {-1e300, 4}, {3, 2e12}}) {
    const std::vector<int> visits = visits_of({{{{1, 1}, {9, 9}, p}}});
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 0), std::ssize(visits)) << p.x;
  }
}

TEST(Samples, OfTrianglesFarLargerThanThePicture) {
  for (const double size : {3e6, 1e9, 1e11}) {
    const Vec2 a{-size, -size}, b{2 * size, -0.5 * size}, c{20.5, size};
    for (const int visits : visits_of({{{a, b, c}}})) ASSERT_EQ(visits, 1) << size;
    // Two that share an edge across the picture.
    const Vec2 low{20.25, -size}, high{20.25, size}, left{-size, 3}, right{size, 5};
    for (const int visits : visits_of({{{low, high, left}}, {{high, low, right}}})) {
      ASSERT_EQ(visits, 1) << size;
    }
  }
}

}  // namespace
}  // namespace wrapatlas
