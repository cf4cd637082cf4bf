// Straight ways over meshes, and charts that go on over their borders along them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bake/surface_walk.h"
#include "mesh/triangulate.h"
#include "support/solids.h"
#include "wrapatlas/bake.h"

namespace wrapatlas {
namespace {

constexpr std::array<double, 3> kMiddle{1.0 / 3, 1.0 / 3, 1.0 / 3};

Vec3 place_of(const Mesh& mesh, const WalkEnd& end) {
  return point_at(triangle_of(mesh, end.triangle), end.weights);
}

TEST(SurfaceWalk, IsStraightOnASheetAndEndsAtItsBorder) {
  const Mesh mesh = test::sheet(9);
  const auto walk = SurfaceWalk::build(mesh);
  ASSERT_TRUE(walk);
  for (std::uint32_t triangle = 0; triangle < mesh.face_count(); ++triangle) {
    const Vec3 from = point_at(triangle_of(mesh, triangle), kMiddle);
    for (int i = 0; i < 24; ++i) {
      const double angle = 0.13 + i * std::numbers::pi / 12;
      const Vec3 by = 0.7 * Vec3{std::cos(angle), std::sin(angle), 0};
      double share = 1;
      for (const auto& [at, step] : {std::pair(from.x, by.x), std::pair(from.y, by.y)}) {
        if (at + step > 1) share = std::min(share, (1 - at) / step);
        if (at + step < 0) share = std::min(share, -at / step);
      }
      const WalkEnd end = walk->go(triangle, kMiddle, by);
      EXPECT_LT(length(place_of(mesh, end) - (from + share * by)), 1e-9);
      EXPECT_LT(length(end.carried({1, 2, 3}) - Vec3{1, 2, 3}), 1e-12);
    }
  }
}

/// The cube [0, 1]^3, some of whose faces are wound the wrong way if `mixed`.
Mesh cube(bool mixed) {
  std::vector<std::vector<std::uint32_t>> faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  if (mixed) std::swap(faces[1][1], faces[1][3]);
  std::vector<Vec3> points;
  for (const double z : {0, 1}) {
    for (const double y : {0, 1}) {
      for (const double x : {0, 1}) points.push_back({x, y, z});
    }
  }
  return triangulated(test::bare_mesh(points, faces)).mesh;
}

TEST(SurfaceWalk, GoesRoundACube) {
  for (const bool mixed : {false, true}) {
    const Mesh mesh = cube(mixed);
    const auto walk = SurfaceWalk::build(mesh);
    ASSERT_TRUE(walk);
    const Triangle bottom = triangle_of(mesh, 0);
    const std::array<double, 3> weights{0.5, 0.3, 0.2};
    const Vec3 from = point_at(bottom, weights);
    ASSERT_EQ(from.z, 0);
    const WalkEnd round = walk->go(0, weights, {4, 0, 0});
    EXPECT_LT(length(place_of(mesh, round) - from), 1e-9);
    EXPECT_LT(length(round.carried({1, 2, 3}) - Vec3{1, 2, 3}), 1e-9);
    const WalkEnd above = walk->go(0, weights, {2, 0, 0});
    EXPECT_LT(length(place_of(mesh, above) - Vec3{1 - from.x, from.y, 1}), 1e-9);
    EXPECT_LT(length(above.carried({1, 2, 3}) - Vec3{-1, 2, -3}), 1e-9);
  }
}

/// A sheet in two halves: the right one is turned by a quarter on the atlas, and away.
Mesh halved_sheet() {
  Mesh mesh = test::sheet(8);
  mesh.corner_texcoord.clear();
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
    const std::uint32_t face = c / 3;
    const Vec3 middle = point_at(triangle_of(mesh, face), kMiddle);
    const Vec3& p = mesh.positions[mesh.corner_position[c]];
    const Vec2 at{0.5 * p.x, 0.5 * p.y};
    mesh.texcoords.push_back(middle.x < 0.5 ? at + Vec2{0.13, 0.07}
                                            : Vec2{0.8 - at.y, 0.45 + at.x});
    mesh.corner_texcoord.push_back(c);
  }
  return mesh;
}

/// Where on the sheet each texel within `reach` of the left half would be; others are left out.
template <typename Visit>
void for_each_around_left(int side, double reach, Visit&& visit) {
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vec2 uv{(x + 0.5) / side, 1 - (y + 0.5) / side};
      const Vec2 p = 2.0 * (uv - Vec2{0.13, 0.07});
      const double beyond = (p.x - 0.5) * side / 2;
      if (beyond > 0 && beyond < reach && p.y > 0.02 && p.y < 0.98) visit(x, y, p, beyond);
    }
  }
}

TEST(Bleed, ChartsGoOnOverTheirBorders) {
  const Mesh low = halved_sheet(), high = test::sheet(5);
  BakeSource source;
  source.mesh = &high;
  const BakedMap maps[] = {BakedMap::positions, BakedMap::tangent_normals};
  BakeOptions options;
  constexpr int kSide = 128;
  options.width = options.height = kSide;
  for (const int samples : {1, 2, 3}) {
    options.samples = samples;
    options.bleed = 12;
    const auto with = bake(low, source, maps, options);
    options.bleed = 0;
    const auto without = bake(low, source, maps, options);
    ASSERT_TRUE(with && without);
    EXPECT_EQ(with->inside, without->inside);
    EXPECT_EQ(with->texels_used, without->texels_used);
    int seen = 0;
    for_each_around_left(kSide, 11, [&](int x, int y, Vec2 p, double beyond) {
      EXPECT_NEAR(with->maps[0].at(x, y)[0], p.x, 1e-5);
      EXPECT_NEAR(with->maps[0].at(x, y)[1], p.y, 1e-5);
      EXPECT_NEAR(with->maps[1].at(x, y)[2], 1, 1e-5);
      // What is only dilated lags behind.
      if (beyond > 3) {
        EXPECT_GT(p.x - double(without->maps[0].at(x, y)[0]), 0.01);
      }
      ++seen;
    });
    EXPECT_GT(seen, 500);
  }
}

TEST(Bleed, NormalsAreAlongTheAxesOfTheChartThatGoesOn) {
  // The high sheet leans to +x, which is along the left half's tangent.
  const Mesh low = halved_sheet();
  Mesh high = test::sheet(1);
  for (Vec3& p : high.positions) p.z = -0.2 * p.x;
  BakeSource source;
  source.mesh = &high;
  const BakedMap maps[] = {BakedMap::tangent_normals};
  BakeOptions options;
  constexpr int kSide = 128;
  options.width = options.height = kSide;
  const auto result = bake(low, source, maps, options);
  ASSERT_TRUE(result);
  const Vec3 lean = (1 / std::sqrt(1.04)) * Vec3{0.2, 0, 1};
  for_each_around_left(kSide, 11, [&](int x, int y, Vec2, double) {
    const float* value = result->maps[0].at(x, y);
    EXPECT_NEAR(2 * value[0] - 1, lean.x, 1e-4);
    EXPECT_NEAR(2 * value[1] - 1, lean.y, 1e-4);
  });
}

TEST(Bleed, MovedTexturesGoOnToo) {
  Mesh before = halved_sheet();
  const Mesh after = before;
  for (std::size_t c = 0; c < before.corner_count(); ++c) {
    const Vec3& p = before.positions[before.corner_position[c]];
    before.texcoords[before.corner_texcoord[c]] = {p.x, p.y};
  }
  constexpr int kSide = 128;
  Texture ramp(64, 64, 3), lean(64, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      ramp.at(x, y)[0] = (float(x) + 0.5F) / 64;
      ramp.at(x, y)[1] = 1 - (float(y) + 0.5F) / 64;
      lean.at(x, y)[0] = 0.5F + 0.3F;
      lean.at(x, y)[1] = 0.5F;
      lean.at(x, y)[2] = 0.5F + 0.4F;
    }
  }
  const std::vector<std::uint32_t> group(before.face_count(), 0);
  TransferTarget data{TextureRole::data, 3, {}}, normals{TextureRole::normals, 3, {}};
  data.of_group.push_back({&ramp});
  normals.of_group.push_back({&lean});
  const TransferTarget targets[] = {data, normals};
  TransferOptions options;
  options.width = options.height = kSide;
  options.bleed = 12;
  const auto made = transfer(before, after, group, targets, options);
  ASSERT_TRUE(made);
  int seen = 0;
  for_each_around_left(kSide, 11, [&](int x, int y, Vec2 p, double) {
    EXPECT_NEAR((*made)[0].at(x, y)[0], p.x, 2e-3);
    EXPECT_NEAR((*made)[0].at(x, y)[1], p.y, 2e-3);
    EXPECT_NEAR((*made)[1].at(x, y)[0], 0.8, 1e-3);
    EXPECT_NEAR((*made)[1].at(x, y)[1], 0.5, 1e-3);
    ++seen;
  });
  EXPECT_GT(seen, 500);
}

/// A face that has no UVs lies beyond the border.
TEST(Bleed, FacesWithoutUvsAreNoTextures) {
  Mesh before = halved_sheet();
  for (std::uint32_t c = 0; c < before.corner_count(); ++c) {
    if (point_at(triangle_of(before, c / 3), kMiddle).x > 0.5) before.corner_texcoord[c] = kNone;
  }
  Texture grey(4, 4, 3);
  std::fill(grey.values.begin(), grey.values.end(), 0.25F);
  const std::vector<std::uint32_t> group(before.face_count(), 0);
  TransferTarget target{TextureRole::data, 3, {}};
  target.of_group.push_back({&grey});
  TransferOptions options;
  options.width = options.height = 64;
  const auto made = transfer(before, before, group, {&target, 1}, options);
  ASSERT_TRUE(made);
  for (const float value : made->front().values) EXPECT_NEAR(value, 0.25, 1e-6);
}

}  // namespace
}  // namespace wrapatlas
