// Baked maps against surfaces whose normals and positions are known.
#include "wrapatlas/bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/polygon_plane.h"
#include "support/solids.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {
namespace {

/// A sheet over [0, 1]^2 with its positions as UVs, moved by `shift`.
Mesh mapped_sheet(std::uint32_t n, Vec2 shift = {}) {
  Mesh mesh = test::sheet(n);
  for (const Vec3& p : mesh.positions) mesh.texcoords.push_back(Vec2{p.x, p.y} + shift);
  mesh.corner_texcoord = mesh.corner_position;
  return mesh;
}

Vec3 direction_at(const Texture& map, int x, int y) {
  const float* value = map.at(x, y);
  return {2.0 * double(value[0]) - 1, 2.0 * double(value[1]) - 1, 2.0 * double(value[2]) - 1};
}

BakeSource source_of(const Mesh& mesh, const Texture* color = nullptr) {
  BakeSource source;
  source.mesh = &mesh;
  source.color = color;
  return source;
}

BakeOptions small(int side) {
  BakeOptions options;
  options.width = options.height = side;
  options.threads = 2;
  return options;
}

TEST(Bake, ASheetOnItself) {
  const Mesh low = mapped_sheet(1), high = test::sheet(7);
  const BakedMap maps[] = {BakedMap::object_normals, BakedMap::tangent_normals, BakedMap::positions,
                           BakedMap::occlusion};
  const auto result = bake(low, source_of(high), maps, small(32));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->texels_used, 32U * 32U);
  EXPECT_EQ(result->texels_nearest, 0U);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      for (const int map : {0, 1}) {
        EXPECT_LT(length(direction_at(result->maps[map], x, y) - Vec3{0, 0, 1}), 1e-6);
      }
      const float* p = result->maps[2].at(x, y);
      EXPECT_NEAR(p[0], (x + 0.5) / 32, 1e-6);
      EXPECT_NEAR(p[1], 1 - (y + 0.5) / 32, 1e-6);  // v points up, rows go down
      EXPECT_EQ(*result->maps[3].at(x, y), 1);
    }
  }
}

TEST(Bake, FlatNormalsAreExactlySo) {
  const Mesh low = mapped_sheet(1);
  const BakedMap maps[] = {BakedMap::tangent_normals, BakedMap::positions};
  for (int samples = 1; samples <= 16; ++samples) {
    BakeOptions options = small(8);
    options.samples = samples;
    const auto result = bake(low, source_of(low), maps, options);
    ASSERT_TRUE(result);
    const Texture& map = result->maps[0];
    for (std::size_t i = 0; i < map.values.size(); ++i) {
      EXPECT_EQ(map.values[i], i % 3 == 2 ? 1.0F : 0.5F) << samples;  // 0.5 is a tie at 8 bits
    }
    // The mean of equal values is that value.
    for (int i = 0; i < 64; ++i) EXPECT_EQ(result->maps[1].at(i % 8, i / 8)[2], 0);
  }
}

TEST(Bake, NormalsThatCancelAreUp) {
  // Two sheets that face apart where a texel sees both: half a texel each.
  Mesh low = mapped_sheet(1);
  Mesh high = test::sheet(2);
  const BakedMap maps[] = {BakedMap::object_normals};
  std::vector<Vec3> normals;
  for (const std::uint32_t i : high.corner_position) {
    normals.push_back({0, 0, high.positions[i].x < 0.6 ? 1.0 : -1.0});
  }
  BakeSource source = source_of(high);
  source.corner_normals = normals;
  for (const bool fit : {false, true}) {
    BakeOptions options = small(9);
    options.fit = fit;
    const auto result = bake(low, source, maps, options);
    ASSERT_TRUE(result);
    for (int x = 0; x < 9; ++x) EXPECT_NEAR(length(direction_at(result->maps[0], x, 4)), 1, 1e-6);
  }
}

TEST(Bake, ChartsGoOnOverTheBorder) {
  const Mesh low = mapped_sheet(2, {0.4, -0.7}), high = test::sheet(3);
  const BakedMap maps[] = {BakedMap::positions};
  BakeOptions options = small(40);
  const auto whole = bake(low, source_of(high), maps, options);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->texels_used, 1600U);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const double u = (x + 0.5) / 40 - 0.4, v = 1 - (y + 0.5) / 40 + 0.7;
      const float* p = whole->maps[0].at(x, y);
      // Exactly on the seam a texel is a mean of both its sides.
      EXPECT_NEAR(p[0], u - std::floor(u), 1e-5);
      EXPECT_NEAR(p[1], v - std::floor(v), 1e-5);
    }
  }
  options.wrap = Wrap::none;
  const auto cut = bake(low, source_of(high), maps, options);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->texels_used, 24U * 12U);
}

/// A coarse ball in two halves, each seen from its pole, side by side.
Mesh mapped_ball() {
  Mesh mesh = test::ball(8);
  std::vector<Vec2> uvs;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    double middle = 0;
    for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
      middle += mesh.positions[mesh.corner_position[c]].z;
    }
    for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
      const Vec3& p = mesh.positions[mesh.corner_position[c]];
      const double side = middle > 0 ? 1 : -1;
      const double around = std::sqrt(2 / (1 + side * p.z));  // Lambert's azimuthal projection
      mesh.corner_texcoord[c] = c;
      uvs.push_back(
          {0.25 + 0.16 * around * p.x + (side > 0 ? 0 : 0.5), 0.5 + 0.16 * side * around * p.y});
    }
  }
  mesh.texcoords = std::move(uvs);
  return mesh;
}

TEST(Bake, ABallOnACoarseOne) {
  const Mesh low = mapped_ball(), high = test::ball(96);
  const BakedMap maps[] = {BakedMap::object_normals, BakedMap::positions,
                           BakedMap::tangent_normals};
  BakeOptions options = small(96);
  options.samples = 1;
  const auto result = bake(low, source_of(high), maps, options);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->texels_nearest, 0U);
  // Two discs of radius 0.16 * sqrt(2) but for the corners of 16.
  EXPECT_GT(result->texels_used, 2800U);
  EXPECT_LT(result->texels_used, 3200U);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      const Vec3 n = direction_at(result->maps[0], x, y);
      EXPECT_NEAR(length(n), 1, 1e-5);  // those outside charts have a value as well
      if (result->inside[std::size_t(96) * y + x] == 0) continue;
      const float* p = result->maps[1].at(x, y);
      const Vec3 place =
          result->low_corner + result->extent * Vec3{double(p[0]), double(p[1]), double(p[2])};
      EXPECT_GT(dot(n, unit(place)), 0.999);
      EXPECT_GT(result->maps[2].at(x, y)[2], 0.9F);  // the coarse normals are near already
    }
  }
}

/// Radians between what is read from the map and the mesh's own smooth normals; the mean over
/// places all over its faces.
double mean_error(const Mesh& mesh, const Texture& map) {
  const std::vector<Vec3> normals = smooth_normals(mesh);
  double sum = 0;
  int count = 0;
  for (std::size_t c = 0; c < mesh.corner_count(); c += 3) {
    for (int i = 1; i < 8; ++i) {
      for (int j = 1; i + j < 8; ++j) {
        const std::array<double, 3> weights{i / 8.0, j / 8.0, (8 - i - j) / 8.0};
        Vec2 uv;
        Vec3 normal;
        for (std::size_t k = 0; k < 3; ++k) {
          uv = uv + weights[k] * mesh.texcoords[mesh.corner_texcoord[c + k]];
          normal = normal + weights[k] * normals[c + k];
        }
        const TextureValue read = sample_bilinear(map, {uv.x, 1 - uv.y}, Wrap::uv);
        const Vec3 n{2.0 * double(read[0]) - 1, 2.0 * double(read[1]) - 1,
                     2.0 * double(read[2]) - 1};
        sum += std::atan2(length(cross(n, normal)), dot(n, normal));
        ++count;
      }
    }
  }
  return sum / count;
}

TEST(Bake, FittedNormalsAreNearerWhenFiltered) {
  Mesh waves = mapped_sheet(40);
  for (Vec3& p : waves.positions) p.z = 0.02 * std::sin(23 * p.x) * std::cos(19 * p.y);
  for (Vec2& uv : waves.texcoords) uv = 0.8 * uv + Vec2{0.17, 0.53};  // over the atlas's border
  const BakedMap maps[] = {BakedMap::positions, BakedMap::object_normals};
  BakeOptions options = small(40);
  const auto fitted = bake(waves, source_of(waves), maps, options);
  options.fit = false;
  const auto means = bake(waves, source_of(waves), maps, options);
  ASSERT_TRUE(fitted && means);
  EXPECT_LT(mean_error(waves, fitted->maps[1]), 0.6 * mean_error(waves, means->maps[1]));
  EXPECT_EQ(fitted->maps[0].values, means->maps[0].values);  // directions alone are fitted
}

TEST(Bake, TangentSpaceLeadsBackToTheNormal) {
  // A flat square, turned in UV; above it a plane that is tilted.
  Mesh low = mapped_sheet(1);
  for (Vec2& uv : low.texcoords) uv = {0.5 + 0.6 * (uv.y - 0.5), 0.5 - 0.6 * (uv.x - 0.5)};
  Mesh high = test::sheet(1);
  for (Vec3& p : high.positions) p = {3 * p.x - 1, 3 * p.y - 1, 0.1 + 0.3 * p.x + 0.1 * p.y};
  const Vec3 tilted = unit(polygon_normal(high, 0));
  const BakedMap maps[] = {BakedMap::tangent_normals};
  for (const bool down : {false, true}) {
    BakeOptions options = small(16);
    options.v_points_down = down;
    const auto result = bake(low, source_of(high), maps, options);
    ASSERT_TRUE(result);
    const TangentFrames frames = tangent_frames(low, smooth_normals(low), down);
    const Vec3 t = frames.tangent[0], n = frames.normal[0];
    const Vec3 b = double(frames.sign[0]) * cross(n, t);
    const Vec3 stored = direction_at(result->maps[0], 8, 8);
    EXPECT_LT(length(stored.x * t + stored.y * b + stored.z * n - tilted), 1e-5);
    EXPECT_EQ(frames.sign[0], down ? -1 : 1);
  }
}

TEST(Bake, LooksBothWaysAndForTheNearestPoint) {
  const Mesh low = mapped_sheet(1);
  Mesh high = test::sheet(1);
  const BakedMap maps[] = {BakedMap::positions};
  BakeOptions options = small(8);
  for (const double z : {0.2, -0.2}) {
    for (Vec3& p : high.positions) p.z = z;
    options.distance = 0.3;
    const auto near = bake(low, source_of(high), maps, options);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->texels_nearest, 0U);
    options.distance = 0.1;
    const auto far = bake(low, source_of(high), maps, options);
    ASSERT_TRUE(far);
    EXPECT_EQ(far->texels_nearest, 64U);
    EXPECT_TRUE(near->met);
    EXPECT_FALSE(far->met);
    for (std::size_t i = 0; i < near->maps[0].values.size(); ++i) {
      EXPECT_NEAR(near->maps[0].values[i], far->maps[0].values[i], 1e-6);
    }
  }
}

/// A sheet over [0, 1]^2 at a height, facing up or down.
void add_layer(Mesh& mesh, double z, bool up) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec2 p : {Vec2{-1, -1}, {2, -1}, {2, 2}, {-1, 2}})
    mesh.positions.push_back({p.x, p.y, z});
  for (std::uint32_t i = 0; i < 4; ++i) {
    mesh.corner_position.push_back(first + (up ? i : 3 - i));
    mesh.corner_texcoord.push_back(kNone);
  }
  mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
}

TEST(Bake, RaysGoThroughTheBackOfAWall) {
  const Mesh low = mapped_sheet(1);
  Mesh wall;
  add_layer(wall, 0.05, false);
  add_layer(wall, 0.1, true);
  const BakedMap maps[] = {BakedMap::object_normals, BakedMap::positions};
  BakeOptions options = small(8);
  options.distance = 0.3;
  const auto result = bake(low, source_of(wall), maps, options);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->texels_nearest, 0U);
  EXPECT_NEAR(direction_at(result->maps[0], 4, 4).z, 1, 1e-6);
  // Farther than rays look, the nearest point is still one of a face that looks the same way.
  options.distance = 0.01;
  const auto far = bake(low, source_of(wall), maps, options);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->texels_nearest, 64U);
  EXPECT_NEAR(direction_at(far->maps[0], 4, 4).z, 1, 1e-6);
}

TEST(Bake, TheDistanceDoesNotDependOnWhichCornerIsFirst) {
  Mesh low = mapped_sheet(1);
  low.positions[2].z = 0.5;
  Mesh high;
  add_layer(high, 0, true);
  const BakedMap maps[] = {BakedMap::positions};
  for (int turn = 0; turn < 3; ++turn) {
    const auto result = bake(low, source_of(high), maps, small(8));
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->distance, 1, 1e-6);
    for (std::uint32_t f = 0; f < low.face_count(); ++f) {
      for (auto* indices : {&low.corner_position, &low.corner_texcoord}) {
        const auto begin = indices->begin() + low.face_begin[f];
        std::rotate(begin, begin + 1, indices->begin() + low.face_begin[f + 1]);
      }
    }
  }
}

TEST(Bake, RefusesUvsWithoutBoundsAndMeshesWorldsApart) {
  const BakedMap maps[] = {BakedMap::positions};
  const Mesh high = test::sheet(2);
  for (const double reach : {1e5, 1e8, 1e25}) {
    Mesh low = mapped_sheet(1);
    for (Vec2& uv : low.texcoords) uv = reach * uv;
    for (const Wrap wrap : {Wrap::uv, Wrap::u}) {
      BakeOptions options = small(16);
      options.wrap = wrap;
      const auto result = bake(low, source_of(high), maps, options);
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().kind, ErrorKind::input);
    }
    BakeOptions options = small(16);
    options.wrap = Wrap::none;  // one large triangle over all texels
    EXPECT_TRUE(bake(low, source_of(high), maps, options));
  }
  Mesh outside = mapped_sheet(1, {5, 5});
  BakeOptions options = small(16);
  options.wrap = Wrap::none;
  EXPECT_FALSE(bake(outside, source_of(high), maps, options));
  Mesh away = mapped_sheet(1);
  for (Vec3& p : away.positions) p.z = 1e25;
  EXPECT_FALSE(bake(away, source_of(high), maps, small(16)));
  Mesh speck = high;
  for (Vec3& p : speck.positions) p = 1e-20 * p;
  EXPECT_FALSE(bake(mapped_sheet(1), source_of(speck), maps, small(16)));
}

TEST(Bake, OcclusionInAPit) {
  const Mesh low = mapped_sheet(1);
  Mesh pit = test::sheet(1);  // its floor, and four walls of height 20
  for (int i = 0; i < 4; ++i) {
    const double a = i * std::numbers::pi / 2;
    const auto corner = [&](double x, double z) {
      const Vec2 at{std::cos(a) * 0.5 - std::sin(a) * x, std::sin(a) * 0.5 + std::cos(a) * x};
      return Vec3{0.5 + at.x, 0.5 + at.y, z};
    };
    pit = test::both(
        pit, test::bare_mesh({corner(-0.5, 0), corner(0.5, 0), corner(0.5, 20), corner(-0.5, 20)},
                             {{0, 1, 2, 3}}));
  }
  const BakedMap maps[] = {BakedMap::occlusion};
  BakeOptions options = small(8);
  options.high_hard_angle = 0.1;
  const auto deep = bake(low, source_of(pit), maps, options);
  ASSERT_TRUE(deep);
  options.occlusion_distance = 1e-3;
  const auto blind = bake(low, source_of(pit), maps, options);
  ASSERT_TRUE(blind);
  EXPECT_LT(*deep->maps[0].at(4, 4), 0.02F);
  EXPECT_EQ(*blind->maps[0].at(4, 4), 1);
}

TEST(Bake, ColourOfTheHighMesh) {
  const Mesh low = mapped_sheet(1);
  Mesh high = mapped_sheet(4);
  Texture ramp(64, 64, 4);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      float* value = ramp.at(x, y);
      value[0] = (float(x) + 0.5F) / 64;
      value[1] = (float(y) + 0.5F) / 64;
      value[3] = 0.5F;
    }
  }
  const BakedMap maps[] = {BakedMap::color};
  const auto result = bake(low, source_of(high, &ramp), maps, small(32));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->maps[0].channels, 4);
  for (int y = 2; y < 30; ++y) {
    for (int x = 2; x < 30; ++x) {
      const float* value = result->maps[0].at(x, y);
      EXPECT_NEAR(value[0], (x + 0.5) / 32, 1e-5);
      EXPECT_NEAR(value[1], (y + 0.5) / 32, 1e-5);
      EXPECT_NEAR(value[3], 0.5, 1e-6);
    }
  }
}

TEST(Bake, ThreadsDoNotMatter) {
  const Mesh low = mapped_ball(), high = test::ball(40, 1.1);
  const BakedMap maps[] = {BakedMap::object_normals, BakedMap::occlusion,
                           BakedMap::tangent_normals};
  BakeOptions options = small(64);
  options.threads = 1;
  const auto one = bake(low, source_of(high), maps, options);
  options.threads = 4;
  const auto four = bake(low, source_of(high), maps, options);
  ASSERT_TRUE(one && four);
  for (const std::size_t map : {0, 1, 2}) EXPECT_EQ(one->maps[map].values, four->maps[map].values);
  EXPECT_EQ(one->texels_used, four->texels_used);
}

TEST(Bake, Refuses) {
  const Mesh low = mapped_sheet(1), bare = test::sheet(1), empty;
  const BakedMap maps[] = {BakedMap::object_normals}, color[] = {BakedMap::color};
  const auto kind = [&](const Mesh& a, const Mesh& b, std::span<const BakedMap> which,
                        const BakeOptions& options) {
    const auto result = bake(a, source_of(b), which, options);
    EXPECT_FALSE(result);
    return result.error().kind;
  };
  EXPECT_EQ(kind(bare, bare, maps, small(8)), ErrorKind::input);
  EXPECT_EQ(kind(empty, bare, maps, small(8)), ErrorKind::input);
  EXPECT_EQ(kind(low, empty, maps, small(8)), ErrorKind::input);
  EXPECT_EQ(kind(low, bare, color, small(8)), ErrorKind::usage);
  EXPECT_EQ(kind(low, bare, {}, small(8)), ErrorKind::usage);
  EXPECT_EQ(kind(low, bare, maps, small(0)), ErrorKind::usage);
  const BakedMap twice[] = {BakedMap::occlusion, BakedMap::occlusion};
  EXPECT_EQ(kind(low, bare, twice, small(8)), ErrorKind::usage);
  BakeOptions options = small(64);
  options.progress = [](double) { return false; };
  EXPECT_EQ(kind(low, bare, maps, options), ErrorKind::interrupted);
}

}  // namespace
}  // namespace wrapatlas
