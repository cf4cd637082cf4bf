// Flipped triangles are turned back, as far as single points can do it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "parameterize/untangle.h"
#include "support/shapes.h"

namespace wrapatlas {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Flat {
  std::vector<Vec2> uv;
  Triangles triangles;
};

/// n x n squares of size 1, each cut in two.
Flat grid(std::uint32_t n) {
  Flat flat;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) flat.uv.push_back({double(i), double(j)});
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      flat.triangles.push_back({a, a + 1, a + n + 2});
      flat.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  return flat;
}

std::uint32_t flipped(const Flat& flat) {
  std::uint32_t count = 0;
  for (const auto& [a, b, c] : flat.triangles) {
    count += signed_area2(flat.uv[a], flat.uv[b], flat.uv[c]) <= 0 ? 1 : 0;
  }
  return count;
}

TEST(Untangle, PutsPointsBack) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    Flat flat = grid(12);
    const Flat before = flat;
    for (int moved = 0; moved < 4; ++moved) {
      const auto i = 1 + static_cast<std::uint32_t>(random() % 11);
      const auto j = 1 + static_cast<std::uint32_t>(random() % 11);
      flat.uv[j * 13 + i] = {i + test::uniform(random, -2, 2), j + test::uniform(random, -2, 2)};
    }
    EXPECT_EQ(untangle(flat.uv, flat.triangles), 0U) << trial;
    EXPECT_EQ(flipped(flat), 0U);
  }
}

TEST(Untangle, LeavesAloneWhatIsFine) {
  Flat flat = grid(5);
  const std::vector<Vec2> before = flat.uv;
  EXPECT_EQ(untangle(flat.uv, flat.triangles), 0U);
  EXPECT_EQ(flat.uv, before);
}

TEST(Untangle, AHubOfManyFlippedTriangles) {
  // Half of the rim is drawn through the hub; points of the hub count once, not once a triangle.
  constexpr std::uint32_t kCount = 20'000;
  Flat fan;
  fan.uv.push_back({0.3, 0});
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * 3.141592653589793 * i / kCount;
    fan.uv.push_back({i % 2 == 0 ? std::cos(angle) : -0.5 * std::cos(angle), std::sin(angle)});
    fan.triangles.push_back({0, i + 1, (i + 1) % kCount + 1});
  }
  untangle(fan.uv, fan.triangles);
  for (const Vec2 p : fan.uv) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
}

TEST(Untangle, SaysWhatIsLeft) {
  // Front and back of one triangle.
  Flat flat{{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_GT(untangle(flat.uv, flat.triangles), 0U);
  for (const Vec2 p : flat.uv) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  EXPECT_EQ(untangle({}, {}), 0U);
}

}  // namespace
}  // namespace wrapatlas
