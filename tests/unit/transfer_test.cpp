// Textures moved to new UVs against the functions that they were drawn from.
#include "wrapatlas/transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bake/texel_samples.h"
#include "support/solids.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A sheet over [0, 1]^2 whose UVs are `uv` of its positions.
template <typename Uv>
Mesh mapped_sheet(Uv&& uv, bool quads = true) {
  Mesh mesh = test::sheet(3, quads);
  for (const Vec3& p : mesh.positions) mesh.texcoords.push_back(uv(Vec2{p.x, p.y}));
  mesh.corner_texcoord = mesh.corner_position;
  return mesh;
}

/// Smooth, and the same beyond [0, 1]. v from the top.
double wave(Vec2 p, int channel) {
  return 0.5 + 0.2 * std::sin(kTurn * (p.x + 0.1 * channel)) + 0.2 * std::cos(kTurn * p.y);
}

Texture waves(int width, int height, int channels) {
  Texture texture(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        texture.at(x, y)[c] = float(wave({(x + 0.5) / width, (y + 0.5) / height}, c));
      }
    }
  }
  return texture;
}

Vec2 turned(Vec2 p) {  // by 30 degrees, to 0.7 of the size
  const double c = 0.7 * std::cos(kTurn / 12), s = 0.7 * std::sin(kTurn / 12);
  return {0.37 + c * p.x - s * p.y, 0.05 + s * p.x + c * p.y};
}

Result<std::vector<Texture>> moved(const Mesh& before, const Mesh& after,
                                   const TransferTarget& target, TransferOptions options) {
  const std::vector<std::uint32_t> group(before.face_count(), 0);
  return transfer(before, after, group, {&target, 1}, options);
}

TransferOptions of_size(int side, bool down = false) {
  TransferOptions options;
  options.width = options.height = side;
  options.v_points_down = down;
  return options;
}

/// Calls visit(x, y, position on the sheet) for each texel whose centre is on the sheet.
template <typename Visit>
void for_each_texel(const Mesh& after, int side, bool down, Visit&& visit) {
  const Mesh triangles = [&] {
    Mesh mesh = test::sheet(3);
    mesh.texcoords = after.texcoords;
    mesh.corner_texcoord = mesh.corner_position;
    return mesh;
  }();
  const TexelSamples samples(triangles, side, side, Wrap::uv, down, 1);
  std::vector<TexelSample> band;
  std::size_t seen = 0;
  for (std::size_t b = 0; b < samples.band_count(); ++b) {
    samples.read_band(b, band);
    for (std::size_t i = 0; i < band.size(); ++i) {
      if (!band[i].is_on()) continue;
      Vec3 p;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t corner = 3 * std::size_t{band[i].triangle} + k;
        p = p + band[i].weights[k] * triangles.positions[triangles.corner_position[corner]];
      }
      const std::size_t texel = b * samples.rows_per_band() * std::size_t(side) + i;
      visit(int(texel % std::size_t(side)), int(texel / std::size_t(side)), Vec2{p.x, p.y});
      ++seen;
    }
  }
  EXPECT_GT(seen, 100U);
}

TEST(Transfer, FollowsTheSurface) {
  const Texture texture = waves(64, 96, 3);
  for (const bool down : {false, true}) {
    const Mesh before = mapped_sheet([](Vec2 p) { return p; }), after = mapped_sheet(turned);
    const auto made = moved(before, after, {TextureRole::data, 3, {{&texture}}}, of_size(96, down));
    ASSERT_TRUE(made);
    for_each_texel(after, 96, down, [&](int x, int y, Vec2 p) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR((*made)[0].at(x, y)[c], wave({p.x, down ? p.y : 1 - p.y}, c), 2e-3);
      }
    });
  }
}

TEST(Transfer, WhatATextureDoesOutside) {
  const Texture texture = waves(64, 64, 1);
  const Mesh before = mapped_sheet([](Vec2 p) { return Vec2{3 * p.x - 1, 0.5 * p.y}; });
  const Mesh after = mapped_sheet(turned);
  for (const Repeat repeat : {Repeat::repeat, Repeat::mirror, Repeat::clamp}) {
    TransferSource source{&texture, repeat};
    const auto made = moved(before, after, {TextureRole::data, 1, {source}}, of_size(256, true));
    ASSERT_TRUE(made);
    for_each_texel(after, 256, true, [&](int x, int y, Vec2 p) {
      double u = 3 * p.x - 1;
      if (repeat == Repeat::clamp) u = std::clamp(u, 0.5 / 64, 1 - 0.5 / 64);
      if (repeat == Repeat::mirror) u = u < 0 ? -u : u > 1 ? 2 - u : u;
      if (repeat != Repeat::repeat && (u < 0.05 || u > 0.95)) return;  // there it has an edge
      EXPECT_NEAR(*(*made)[0].at(x, y), wave({u, 0.5 * p.y}, 0), 4e-3);
    });
  }
}

TEST(Transfer, ATextureTransform) {
  const Texture texture = waves(64, 64, 1);
  const Mesh before = mapped_sheet([](Vec2 p) { return p; }), after = mapped_sheet(turned);
  TransferSource source{&texture};
  source.matrix = {0, -0.5, 0.2, 0.5, 0, 0.1};
  const auto made = moved(before, after, {TextureRole::data, 1, {source}}, of_size(96, true));
  ASSERT_TRUE(made);
  for_each_texel(after, 96, true, [&](int x, int y, Vec2 p) {
    EXPECT_NEAR(*(*made)[0].at(x, y), wave({-0.5 * p.y + 0.2, 0.5 * p.x + 0.1}, 0), 2e-3);
  });
}

TEST(Transfer, NormalsPointWhereTheyDid) {
  // One direction of space everywhere, stored along the tangents of either UVs.
  const Vec3 direction{0.48, -0.36, 0.8};
  const auto mirrored = [](Vec2 p) { return Vec2{0.9 - 0.6 * p.y, 0.1 + 0.6 * p.x}; };
  const auto flipped = [](Vec2 p) { return Vec2{0.9 - 0.6 * p.x, 0.1 + 0.6 * p.y}; };
  const auto along = [&](const Mesh& mesh, bool down) {
    const Mesh triangles = [&] {
      Mesh made = test::sheet(3);
      made.texcoords = mesh.texcoords;
      made.corner_texcoord = made.corner_position;
      return made;
    }();
    const TangentFrames frames = tangent_frames(triangles, smooth_normals(triangles), down);
    const Vec3 t = frames.tangent[0], n = frames.normal[0];
    const Vec3 b = double(frames.sign[0]) * cross(n, t);
    return Vec3{dot(direction, t), dot(direction, b), dot(direction, n)};
  };
  const auto check = [&](auto&& uv) {
    for (const bool down : {false, true}) {
      const Mesh before = mapped_sheet([](Vec2 p) { return p; }), after = mapped_sheet(uv);
      const Vec3 stored = along(before, down), expected = along(after, down);
      Texture texture(8, 8, 3);
      for (std::size_t i = 0; i < texture.texel_count(); ++i) {
        texture.values[3 * i] = float(0.5 + 0.5 * stored.x);
        texture.values[3 * i + 1] = float(0.5 + 0.5 * stored.y);
        texture.values[3 * i + 2] = float(0.5 + 0.5 * stored.z);
      }
      TransferOptions options = of_size(48, down);
      const TransferTarget target{TextureRole::normals, 3, {{&texture}}};
      const auto made = moved(before, after, target, options);
      const std::vector<std::uint8_t> keeps(before.face_count(), 1);
      options.keeps_tangents = keeps;
      const auto kept = moved(before, after, target, options);
      ASSERT_TRUE(made && kept);
      for_each_texel(after, 48, down, [&](int x, int y, Vec2) {
        const float* value = (*made)[0].at(x, y);
        EXPECT_NEAR(2.0 * double(value[0]) - 1, expected.x, 1e-5);
        EXPECT_NEAR(2.0 * double(value[1]) - 1, expected.y, 1e-5);
        EXPECT_NEAR(2.0 * double(value[2]) - 1, expected.z, 1e-5);
        EXPECT_NEAR((*kept)[0].at(x, y)[0], texture.values[0], 1e-6);
      });
    }
  };
  check(turned);
  check(mirrored);
  check(flipped);
}

TEST(Transfer, GroupsHaveTheirOwnTexturesOrNone) {
  Texture red(4, 4, 3), grey(2, 2, 1);
  for (std::size_t i = 0; i < red.texel_count(); ++i) red.values[3 * i] = 1;
  for (float& value : grey.values) value = 0.25F;
  const Mesh before = mapped_sheet([](Vec2 p) { return p; });
  const Mesh after = mapped_sheet([](Vec2 p) { return p; });
  std::vector<std::uint32_t> group;
  for (std::uint32_t face = 0; face < before.face_count(); ++face) group.push_back(face / 3);
  const TransferTarget targets[] = {{TextureRole::color, 4, {{&red}, {}, {&grey}}},
                                    {TextureRole::data, 1, {{}, {&grey}, {}}}};
  const auto made = transfer(before, after, group, targets, of_size(30, true));
  ASSERT_TRUE(made);
  const auto expect = [&](int y, std::array<float, 4> wanted) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR((*made)[0].at(15, y)[c], wanted[c], 1e-5);
  };
  expect(5, {1, 0, 0, 1});
  expect(25, {0.25F, 0.25F, 0.25F, 1});
  expect(13, {1, 0, 0, 1});  // the group between has no texture: the nearest texel's
  EXPECT_NEAR(*(*made)[1].at(15, 15), 0.25, 1e-6);
}

TEST(Transfer, FinerTexturesAreAveraged) {
  Texture stripes(256, 256, 1);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) *stripes.at(x, y) = float(x % 2);
  }
  const Mesh mesh = mapped_sheet([](Vec2 p) { return p; });
  const auto made = moved(mesh, mesh, {TextureRole::data, 1, {{&stripes}}}, of_size(32));
  ASSERT_TRUE(made);
  for (const float value : (*made)[0].values) EXPECT_NEAR(value, 0.5, 1e-3);
}

TEST(Transfer, Refuses) {
  const Texture texture = waves(4, 4, 3);
  const Mesh mesh = mapped_sheet([](Vec2 p) { return p; }), bare = test::sheet(3, true);
  const TransferTarget target{TextureRole::data, 3, {{&texture}}};
  const auto kind = [](const auto& result) {
    EXPECT_FALSE(result);
    return result ? ErrorKind::check : result.error().kind;
  };
  EXPECT_EQ(kind(moved(mesh, bare, target, of_size(8))), ErrorKind::input);
  EXPECT_EQ(kind(moved(mesh, test::sheet(2, true), target, of_size(8))), ErrorKind::usage);
  EXPECT_EQ(kind(moved(mesh, mesh, target, of_size(0))), ErrorKind::usage);
  EXPECT_EQ(kind(moved(mesh, mesh, {TextureRole::data, 5, {{&texture}}}, of_size(8))),
            ErrorKind::usage);
  EXPECT_EQ(kind(moved(mesh, mesh, {TextureRole::data, 3, {}}, of_size(8))), ErrorKind::usage);
  TransferOptions options = of_size(64);
  options.progress = [](double) { return false; };
  EXPECT_EQ(kind(moved(mesh, mesh, target, options)), ErrorKind::interrupted);
}

}  // namespace
}  // namespace wrapatlas
