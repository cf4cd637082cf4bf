// Textured pictures of models against what their textures hold.
#include "wrapatlas/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/solids.h"

namespace wrapatlas {
namespace {

constexpr int kSize = 100, kAcross = 94, kRim = 3;  // of a square that is seen from the front

Texture noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  Texture texture(width, height, 3);
  for (float& v : texture.values) v = value(random);
  return texture;
}

/// From (-1, -1) to (1, 1), seen from the front; u and v along the axes given, from `corner`.
Mesh square(Vec2 corner = {}, Vec2 u_along = {1, 0}, Vec2 v_along = {0, 1}) {
  Mesh mesh = test::bare_mesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}});
  for (const Vec3& p : mesh.positions) {
    const Vec2 at = 0.5 * Vec2{p.x, p.y};
    mesh.texcoords.push_back(corner + Vec2{0.5 + dot(u_along, at), 0.5 + dot(v_along, at)});
  }
  mesh.corner_texcoord = mesh.corner_position;
  return mesh;
}

RenderOptions from_the_front(Shading shading = Shading::none) {
  RenderOptions options;
  options.size = kSize;
  options.from = ViewDirection{};
  options.shading = shading;
  return options;
}

/// The mean of three times three bilinear samples a texel: a third of a texel to each side.
double spread(const Texture& texture, int x, int y, int channel, Wrap wrap) {
  constexpr double kWeights[] = {1.0 / 9, 7.0 / 9, 1.0 / 9};
  const auto place = [](int i, int count, bool repeats) {
    return repeats ? (i % count + count) % count : std::clamp(i, 0, count - 1);
  };
  double sum = 0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      sum += kWeights[j + 1] * kWeights[i + 1] *
             double(texture.at(place(x + i, texture.width, wraps_u(wrap)),
                               place(y + j, texture.height, wraps_v(wrap)))[channel]);
    }
  }
  return sum;
}

/// Does each pixel of the square show the texel at the same place, `left` texels further on?
void expect_shows(const Rendering& rendering, const Texture& texture, int left, Wrap wrap) {
  for (int y = 0; y < kAcross; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      for (int c = 0; c < 3; ++c) {
        const auto light = float(spread(texture, x + left, y, c, wrap));
        ASSERT_NEAR(rendering.image.at(x + kRim, y + kRim)[c], linear_to_srgb(light), 2e-4)
            << x << " " << y;
      }
    }
  }
}

double farthest_values(const Texture& a, const Texture& b) {
  double farthest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    farthest = std::max(farthest, std::abs(double(a.values[i]) - double(b.values[i])));
  }
  return farthest;
}

MipMaps constant(const Vec3& direction) {
  const Vec3 n = (1 / length(direction)) * direction;
  Texture texture(1, 1, 3);
  texture.values = {float(0.5 + 0.5 * n.x), float(0.5 + 0.5 * n.y), float(0.5 + 0.5 * n.z)};
  return make_mip_maps(std::move(texture), MipFilter::normals);
}

TEST(Render, ASquareShowsItsTexture) {
  const MipMaps color = make_mip_maps(noise(kAcross, kAcross, 1), MipFilter::mean);
  RenderOptions options = from_the_front();
  options.color = &color;
  for (const bool trilinear : {true, false}) {
    options.trilinear = trilinear;
    expect_shows(render(square(), options), color.levels[0], 0, Wrap::uv);
  }
  options.wrap = Wrap::none;
  expect_shows(render(square(), options), color.levels[0], 0, Wrap::none);
  options.v_points_down = true;
  expect_shows(render(square({}, {1, 0}, {0, -1}), options), color.levels[0], 0, Wrap::none);
}

TEST(Render, NoSeamWhereTheTextureRepeatsAndOneWhereItIsClamped) {
  const MipMaps color = make_mip_maps(noise(kAcross, kAcross, 2), MipFilter::mean);
  RenderOptions options = from_the_front();
  options.color = &color;
  for (const double tiles : {0.5, -3.5, 20.5}) {
    const Rendering rendering = render(square({tiles, 0}), options);
    expect_shows(rendering, color.levels[0], kAcross / 2, Wrap::uv);
  }
  options.wrap = Wrap::v;
  expect_shows(render(square({0.5, 7}), options), color.levels[0], kAcross / 2, Wrap::v);
}

TEST(Render, TakesTheLevelThatHasATexelForEachPixel) {
  const MipMaps color = make_mip_maps(noise(4 * kAcross, 4 * kAcross, 3), MipFilter::mean);
  RenderOptions options = from_the_front();
  options.color = &color;
  const Rendering plain = render(square(), options);
  expect_shows(plain, color.levels[2], 0, Wrap::uv);
  // A normal map of another size has a level of its own.
  const MipMaps normals = constant({0, 0, 1});
  options.shading = Shading::object_normals;
  options.normals = &normals;
  const Rendering lit = render(square(), options);
  const auto light_of = [](const Rendering& rendering, int x, int y) {
    return double(srgb_to_linear(rendering.image.at(x, y)[0]));
  };
  const double light = light_of(lit, 50, 50) / light_of(plain, 50, 50);
  for (int x = kRim; x < kRim + kAcross; ++x) {
    EXPECT_NEAR(light_of(lit, x, 40), light * light_of(plain, x, 40), 1e-4);
  }
  options = from_the_front();
  options.color = &color;
  options.level = 1;
  const Rendering fixed = render(square(), options);
  const Vec2 middle{(0.5 + 20) / kAcross, (0.5 + 30) / kAcross};
  double sum = 0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const Vec2 at = middle + 1.0 / (3 * kAcross) * Vec2{double(i), double(j)};
      sum += double(sample_bilinear(color.levels[1], at, Wrap::uv)[1]) / 9;
    }
  }
  EXPECT_NEAR(fixed.image.at(kRim + 20, kRim + 30)[1], linear_to_srgb(float(sum)), 2e-4);
}

TEST(Render, NormalMapsAreLitAsSurfacesAre) {
  const RenderOptions flat = from_the_front(Shading::flat);
  const Rendering surface = render(square(), flat);
  RenderOptions mapped = flat;
  const MipMaps front = constant({0, 0, 1});
  mapped.normals = &front;
  for (const Shading shading : {Shading::object_normals, Shading::tangent_normals}) {
    mapped.shading = shading;
    EXPECT_LT(farthest_values(render(square(), mapped).image, surface.image), 1e-6);
  }
  EXPECT_LT(farthest_values(render(square(), from_the_front(Shading::smooth)).image, surface.image),
            1e-6);
  // A tilted square beside a map that says it were tilted.
  const Vec3 normal{0.6, 0, 0.8};
  Mesh tilted = square();
  for (Vec3& p : tilted.positions) p = {0.8 * p.x, p.y, -0.6 * p.x};
  const MipMaps side = constant(normal);
  mapped.shading = Shading::object_normals;
  mapped.normals = &side;
  const Rendering of_map = render(square(), mapped), of_surface = render(tilted, flat);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(of_map.image.at(50, 50)[c], of_surface.image.at(50, 50)[c], 1e-6);
    EXPECT_GT(std::abs(of_map.image.at(50, 50)[c] - surface.image.at(50, 50)[c]), 0.02);
  }
}

TEST(Render, TangentSpaceFollowsTheUVs) {
  const Vec3 n{0.5, -0.3, 0.8};  // along u, v and out of the surface
  struct Case {
    Vec2 u_along, v_along;
    bool v_points_down;
    Vec3 expected;  ///< in space
  };
  const Case cases[] = {{{1, 0}, {0, 1}, false, {n.x, n.y, n.z}},
                        {{0, 1}, {-1, 0}, false, {-n.y, n.x, n.z}},  // turned
                        {{-1, 0}, {0, 1}, false, {-n.x, n.y, n.z}},  // mirrored
                        {{1, 0}, {0, -1}, true, {n.x, n.y, n.z}}};
  const MipMaps tangent_map = constant(n);
  for (const Case& one : cases) {
    const Mesh mesh = square({}, one.u_along, one.v_along);
    RenderOptions options = from_the_front(Shading::tangent_normals);
    options.v_points_down = one.v_points_down;
    options.normals = &tangent_map;
    const Rendering by_tangents = render(mesh, options);
    const MipMaps object_map = constant(one.expected);
    options.shading = Shading::object_normals;
    options.normals = &object_map;
    EXPECT_LT(farthest_values(by_tangents.image, render(mesh, options).image), 1e-5);
  }
}

TEST(Render, FacesFromBehindAreLitAsIfTurned) {
  for (const Shading shading : {Shading::flat, Shading::smooth}) {
    const RenderOptions options = from_the_front(shading);
    const Mesh turned = test::with_turned_faces(square(), 1);
    EXPECT_LT(farthest_values(render(turned, options).image, render(square(), options).image),
              1e-6);
  }
}

TEST(Render, SaysWhatEachPixelShows) {
  Mesh mesh = square({3, -2});
  const Rendering rendering = render(mesh, from_the_front());
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const std::size_t at = std::size_t(y) * kSize + std::size_t(x);
      const bool on = std::min(x, y) >= kRim && std::max(x, y) < kRim + kAcross;
      ASSERT_EQ(rendering.covered[at], on ? 1 : 0);
      ASSERT_EQ(rendering.face[at], on ? 0 : kNone);
      if (!on) continue;
      ASSERT_NEAR(rendering.uv[at].x, 3 + (x - kRim + 0.5) / kAcross, 1e-9);
      ASSERT_NEAR(rendering.uv[at].y, -1 - (y - kRim + 0.5) / kAcross, 1e-9);
    }
  }
  Mesh small = square();
  for (Vec3& p : small.positions) p = 0.5 * p;
  RenderOptions options = from_the_front();
  options.framed = &mesh;
  const Rendering framed = render(small, options);
  EXPECT_EQ(std::count(framed.covered.begin(), framed.covered.end(), 1), 46 * 46)
      << "its border runs through a pixel";
}

TEST(Render, UVsOfSliversLieOnThem) {
  // All corners on a line that runs through the middles of samples: what area they have, and on
  // which side of it a sample lies, is a matter of rounding.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto whole = [&](int most) { return double(random() % unsigned(most)); };
  std::vector<Vec3> positions;
  std::vector<test::Face> faces;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Vec3 from{whole(200) - 140, whole(200) - 140, place(random)};
    const double side = 2 * whole(10);
    const Vec3 along = i % 3 == 0 ? Vec3{1, 1, 0} : i % 3 == 1 ? Vec3{3, 1, 0} : Vec3{1, 3, 0};
    for (const double share : {0.0, 1.0, 0.5}) {
      positions.push_back(1.0 / 141 * (from + share * side * along));
    }
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Mesh mesh = test::bare_mesh(std::move(positions), faces);
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    mesh.texcoords.push_back({0.4 + 0.1 * place(random), 0.6 + 0.1 * place(random)});
    mesh.corner_texcoord[c] = std::uint32_t(c);
  }
  const Mesh framed = square();
  RenderOptions options = from_the_front();
  options.framed = &framed;  // a sample is 1 / 141
  const Rendering rendering = render(mesh, options);
  int seen = 0;
  for (std::size_t i = 0; i < rendering.face.size(); ++i) {
    if (rendering.face[i] == kNone) continue;
    ++seen;
    ASSERT_NEAR(rendering.uv[i].x, 0.4, 0.1 + 1e-9);
    ASSERT_NEAR(rendering.uv[i].y, 0.6, 0.1 + 1e-9);
  }
  EXPECT_GT(seen, 100);
}

TEST(Render, TakesAnything) {
  EXPECT_EQ(render(Mesh{}).image.width, 2 * 768);
  const MipMaps color = make_mip_maps(Texture(4, 4, 1), MipFilter::mean);
  const MipMaps normals = constant({0, 0, 1});
  RenderOptions options = from_the_front();
  options.color = &color;
  options.normals = &normals;
  const Mesh odd = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1e29, 0, 0}},
                                   {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}});
  for (const Mesh& mesh : {odd, test::ball(9)}) {
    for (const Shading shading : {Shading::none, Shading::flat, Shading::smooth,
                                  Shading::object_normals, Shading::tangent_normals}) {
      options.shading = shading;
      for (const float value : render(mesh, options).image.values) ASSERT_TRUE(value >= 0);
    }
  }
}

TEST(RenderParallel, TheSameForAnyNumberOfThreads) {
  const Mesh ball = test::ball(20);
  RenderOptions options;
  options.size = 64;
  options.views = 3;
  options.threads = 1;
  const Rendering one = render(ball, options);
  options.threads = 3;
  const Rendering three = render(ball, options);
  EXPECT_EQ(one.image.width, 3 * 64);
  EXPECT_EQ(one.image.values, three.image.values);
  EXPECT_EQ(one.face, three.face);
}

}  // namespace
}  // namespace wrapatlas
