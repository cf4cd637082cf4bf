// Pictures of a model.
#include "wrapatlas/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/solids.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {
namespace {

Color pixel(const Image& image, int x, int y) {
  const std::size_t at = 3 * (std::size_t(y) * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

std::vector<Color> all(const Mesh& mesh, Color color) {
  return std::vector<Color>(mesh.face_count(), color);
}

ViewOptions one_view(int size = 64) {
  ViewOptions options;
  options.size = size;
  options.views = 1;
  return options;
}

/// Squares that face the viewer of the first view, one behind the other.
Mesh cards(const std::vector<std::pair<double, double>>& size_and_depth) {
  std::vector<Vec3> positions;
  std::vector<test::Face> faces;
  const double azimuth = std::numbers::pi / 6, elevation = std::numbers::pi / 9;
  const Vec3 right{std::cos(azimuth), 0, -std::sin(azimuth)};
  const Vec3 back{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  std::cos(elevation) * std::cos(azimuth)};
  const Vec3 up = cross(back, right);
  for (const auto& [size, depth] : size_and_depth) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      positions.push_back(size * x * right + size * y * up + depth * back);
    }
    faces.push_back({first, first + 1, first + 2, first + 3});
  }
  return test::bare_mesh(positions, faces);
}

TEST(DrawMesh, NearerFacesHideFartherOnes) {
  const Mesh mesh = cards({{1, 0}, {0.5, 1}, {0.5, -1}});
  const Color red{200, 0, 0}, green{0, 200, 0}, blue{0, 0, 200};
  const Image image = draw_mesh(mesh, std::vector<Color>{red, green, blue}, one_view());
  ASSERT_EQ(image.width, 64);
  ASSERT_EQ(image.height, 64);
  EXPECT_EQ(pixel(image, 32, 32), green);
  EXPECT_EQ(pixel(image, 10, 32), red);
  EXPECT_NE(pixel(image, 0, 0), red) << "a rim stays free";
}

TEST(DrawMesh, FillsMostOfTheViewAndBothSidesShow) {
  const Mesh mesh = cards({{1, 0}});
  for (const Mesh& side : {mesh, test::with_turned_faces(mesh, 1)}) {
    const Image image = draw_mesh(side, all(side, {250, 250, 250}), one_view());
    std::size_t bright = 0;
    for (const std::uint8_t value : image.rgb) bright += value > 200 ? 1 : 0;
    EXPECT_NEAR(double(bright) / double(image.rgb.size()), 0.94 * 0.94, 0.04);
  }
}

TEST(DrawMesh, LinesAlongSeamsThatAreNotHidden) {
  Mesh mesh = test::sheet(2, true);
  const std::vector<Color> colors = all(mesh, {255, 255, 255});
  ViewOptions options = one_view(128);
  const Image plain = draw_mesh(mesh, colors, options);
  const std::vector<SeamEdge> across = seam_edges(mesh, std::vector<std::uint32_t>{1, 2, 1, 2});
  options.seams = across;
  const Image lined = draw_mesh(mesh, colors, options);
  std::size_t darker = 0;
  for (std::size_t i = 0; i < plain.rgb.size(); ++i) darker += lined.rgb[i] < plain.rgb[i] ? 1 : 0;
  EXPECT_GT(darker, 100U);
  EXPECT_LT(darker, plain.rgb.size() / 20) << "a line, no more";
  // One card before another: no line of the one behind.
  mesh = cards({{1, 0}, {0.5, 9}});
  const std::vector<Color> white = all(mesh, {255, 255, 255});
  const Vec3 back = 0.5 * (mesh.positions[4] + mesh.positions[6]);
  const double far = std::sqrt(dot(back, back));
  const auto line_at = [&](double depth) {
    const Vec3 middle = (depth / far) * back, reach = 0.2 * (mesh.positions[1] - mesh.positions[0]);
    return std::vector<SeamEdge>{{middle - reach, middle + reach}};
  };
  options.seams = {};
  const Image bare = draw_mesh(mesh, white, options);
  const std::vector<SeamEdge> behind = line_at(0), before = line_at(9);
  options.seams = behind;
  EXPECT_EQ(draw_mesh(mesh, white, options).rgb, bare.rgb);
  options.seams = before;
  EXPECT_NE(draw_mesh(mesh, white, options).rgb, bare.rgb);
}

TEST(SeamEdges, LieBetweenChartsAndWhereAChartIsCutOpen) {
  // Two squares side by side; the one edge that both have.
  Mesh mesh = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                              {{0, 1, 4, 3}, {1, 2, 5, 4}});
  const std::vector<std::uint32_t> one{7, 7}, two{7, 8};
  EXPECT_TRUE(seam_edges(mesh, one).empty());
  const auto between = seam_edges(mesh, two);
  ASSERT_EQ(between.size(), 1U);
  EXPECT_EQ(between[0].from + between[0].to, (Vec3{2, 1, 0}));
  for (const Vec3& p : mesh.positions) mesh.texcoords.push_back({p.x, p.y});
  mesh.corner_texcoord = mesh.corner_position;
  EXPECT_TRUE(seam_edges(mesh, one).empty());
  mesh.texcoords.push_back(mesh.texcoords[1]);  // the same value again is no cut
  mesh.corner_texcoord[4] = 6;
  EXPECT_TRUE(seam_edges(mesh, one).empty());
  mesh.texcoords[6] = {1.25, 0};
  EXPECT_EQ(seam_edges(mesh, one).size(), 1U);
  mesh.corner_texcoord[4] = kNone;
  EXPECT_EQ(seam_edges(mesh, one).size(), 1U) << "a face without UVs beside one with";
}

TEST(SeamEdges, OfAPolygonOfManyCornersTakeNoLongerThanOfManyFaces) {
  constexpr std::uint32_t kCount = 200'000;
  std::vector<Vec3> positions;
  test::Face cap;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCount;
    positions.push_back({std::cos(angle), std::sin(angle), 0});
    cap.push_back(i);
  }
  const test::Face back(cap.rbegin(), cap.rend());
  const Mesh disc = test::bare_mesh(positions, {cap, back});
  EXPECT_EQ(seam_edges(disc, std::vector<std::uint32_t>{0, 1}).size(), kCount);
  EXPECT_TRUE(seam_edges(disc, std::vector<std::uint32_t>{0, 0}).empty());
}

TEST(DrawMesh, ACubeShowsThreeSidesInTheirColours) {
  const Mesh cube = test::bare_mesh(
      {{-1, -1, -1},
       {1, -1, -1},
       {-1, 1, -1},
       {1, 1, -1},
       {-1, -1, 1},
       {1, -1, 1},
       {-1, 1, 1},
       {1, 1, 1}},
      {{4, 5, 7, 6}, {1, 3, 7, 5}, {2, 6, 7, 3}, {0, 2, 3, 1}, {0, 4, 6, 2}, {0, 1, 5, 4}});
  const std::vector<Color> colors{{255, 0, 0}, {0, 255, 0}, {0, 0, 255},
                                  {9, 9, 9},   {9, 9, 9},   {9, 9, 9}};
  const Image image = draw_mesh(cube, colors, one_view(200));
  // The light of a side is 0.35 + 0.65 times the cosine to the viewer, who is at azimuth 30
  // degrees, elevation 20 degrees.
  const double azimuth = std::numbers::pi / 6, elevation = std::numbers::pi / 9;
  const auto lit = [](double cosine) {
    return static_cast<std::uint8_t>(std::lround(255 * (0.35 + 0.65 * cosine)));
  };
  const Color front{lit(std::cos(elevation) * std::cos(azimuth)), 0, 0};
  const Color side{0, lit(std::cos(elevation) * std::sin(azimuth)), 0};
  const Color top{0, 0, lit(std::sin(elevation))};
  EXPECT_EQ(pixel(image, 70, 120), front);
  EXPECT_EQ(pixel(image, 165, 120), side);
  EXPECT_EQ(pixel(image, 120, 24), top);
  for (const int corner : {0, 199}) {
    EXPECT_EQ(pixel(image, corner, 0), pixel(image, 0, 199)) << "nothing but ground";
  }
}

TEST(DrawMesh, APolygonWithABayHasTheBay) {
  Mesh mesh = cards({{1, 0}});
  const Vec3 a = mesh.positions[0], b = mesh.positions[1], c = mesh.positions[2];
  const Vec3 bay = 0.5 * (a + c) + 0.1 * (b - a);  // right of the middle: the notch is on the left
  mesh = test::bare_mesh({a, b, c, mesh.positions[3], bay}, {{0, 1, 2, 3, 4}});
  const Image image = draw_mesh(mesh, all(mesh, {250, 250, 250}), one_view(100));
  EXPECT_EQ(pixel(image, 80, 50), (Color{250, 250, 250}));
  EXPECT_EQ(pixel(image, 40, 15), (Color{250, 250, 250}));
  EXPECT_EQ(pixel(image, 30, 50), pixel(image, 0, 0));
}

TEST(DrawMesh, ThinFacesInGreatNumberAreOneSurface) {
  constexpr std::uint32_t kCount = 100'000;
  const Mesh flat = cards({{1, 0}});
  const Vec3 middle = 0.5 * (flat.positions[0] + flat.positions[2]);
  const Vec3 right = 0.5 * (flat.positions[1] - flat.positions[0]);
  const Vec3 up = 0.5 * (flat.positions[3] - flat.positions[0]);
  std::vector<Vec3> positions{middle};
  std::vector<test::Face> faces;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCount;
    positions.push_back(middle + std::cos(angle) * right + std::sin(angle) * up);
    faces.push_back({0, i + 1, (i + 1) % kCount + 1});
  }
  const Mesh fan = test::bare_mesh(std::move(positions), faces);
  const Image image = draw_mesh(fan, all(fan, {250, 250, 250}), one_view(300));
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 300; ++x) {
      const double away = std::hypot(x - 149.5, y - 149.5);
      if (away > 138 && away < 144) continue;
      ASSERT_EQ(pixel(image, x, y)[0] >= 249, away <= 138) << x << " " << y;
    }
  }
}

TEST(DrawMesh, TheLineIsOnTheEdge) {
  Mesh mesh = cards({{1, 0}});
  const Vec3 low = 0.5 * (mesh.positions[0] + mesh.positions[1]);
  const Vec3 high = 0.5 * (mesh.positions[2] + mesh.positions[3]);
  const auto& p = mesh.positions;
  mesh = test::bare_mesh({p[0], low, high, p[3], p[1], p[2]}, {{0, 1, 2, 3}, {1, 4, 5, 2}});
  ViewOptions options = one_view(101);
  const std::vector<SeamEdge> seams = seam_edges(mesh, std::vector<std::uint32_t>{3, kNone});
  options.seams = seams;
  const Image image = draw_mesh(mesh, all(mesh, {250, 250, 250}), options);
  for (int x = 10; x < 91; ++x) {
    const bool dark = pixel(image, x, 50)[0] < 240;
    EXPECT_EQ(dark, x == 50) << x;
  }
}

TEST(DrawMesh, TakesAnything) {
  EXPECT_EQ(draw_mesh(Mesh{}, {}, one_view()).width, 64);
  const Mesh odd = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1e30, 0, 0}},
                                   {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}});
  draw_mesh(odd, all(odd, {9, 9, 9}), {});
  const Mesh ball = test::ball(9);
  ViewOptions options = one_view();
  options.views = 3;
  const Image image = draw_mesh(ball, all(ball, {9, 99, 9}), options);
  EXPECT_EQ(image.width, 3 * 64);
  EXPECT_EQ(image.rgb, draw_mesh(ball, all(ball, {9, 99, 9}), options).rgb);
}

}  // namespace
}  // namespace wrapatlas
