// Pictures of a model, and of values of its faces.
#include "wrapatlas/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

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
  const double azimuth = M_PI / 6, elevation = M_PI / 9;
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

TEST(DrawMesh, LinesWhereLabelsChangeAndNowhereElse) {
  Mesh mesh = test::sheet(2, true);
  const std::vector<Color> colors = all(mesh, {255, 255, 255});
  ViewOptions options = one_view(128);
  const Image plain = draw_mesh(mesh, colors, options);
  const std::vector<std::uint32_t> same{4, 4, 4, 4}, halves{1, 2, 1, 2};
  options.face_labels = same;
  EXPECT_EQ(draw_mesh(mesh, colors, options).rgb, plain.rgb);
  options.face_labels = halves;
  const Image lined = draw_mesh(mesh, colors, options);
  std::size_t darker = 0;
  for (std::size_t i = 0; i < plain.rgb.size(); ++i) darker += lined.rgb[i] < plain.rgb[i] ? 1 : 0;
  EXPECT_GT(darker, 100U);
  EXPECT_LT(darker, plain.rgb.size() / 20) << "a line, no more";
  // One card before another: no line where the one hides the other.
  mesh = cards({{1, 0}, {0.5, 9}});
  const std::vector<std::uint32_t> two{1, 2};
  options.face_labels = two;
  const std::vector<Color> white = all(mesh, {255, 255, 255});
  const Image hidden = draw_mesh(mesh, white, options);
  options.face_labels = {};
  EXPECT_EQ(hidden.rgb, draw_mesh(mesh, white, options).rgb);
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

TEST(DrawFacesOnAtlas, WrapsAsTexturesDo) {
  Mesh mesh = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  mesh.texcoords = {{0.75, 0.25}, {1.25, 0.25}, {1.25, 0.75}, {0.75, 0.75}};
  mesh.corner_texcoord = {0, 1, 2, 3};
  const Color red{200, 0, 0};
  const Image image = draw_faces_on_atlas(mesh, std::vector<Color>{red}, 64, 32, 64);
  ASSERT_EQ(image.width, 64);
  ASSERT_EQ(image.height, 32);
  EXPECT_EQ(pixel(image, 60, 16), red);
  EXPECT_EQ(pixel(image, 3, 16), red) << "beyond the border";
  EXPECT_NE(pixel(image, 32, 16), red);
  EXPECT_NE(pixel(image, 60, 3), red);
  mesh.corner_texcoord[2] = kNone;
  const Image none = draw_faces_on_atlas(mesh, std::vector<Color>{red}, 64, 32, 64);
  EXPECT_EQ(pixel(none, 60, 16), pixel(none, 32, 16)) << "without all UVs it is nowhere";
}

TEST(DrawFacesOnAtlas, UpIsUpUnlessVPointsDown) {
  Mesh mesh = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  mesh.texcoords = {{0, 0}, {1, 0}, {0, 0.2}};
  mesh.corner_texcoord = {0, 1, 2};
  const Color red{200, 0, 0};
  EXPECT_EQ(pixel(draw_faces_on_atlas(mesh, std::vector<Color>{red}, 64, 64, 64), 1, 62), red);
  EXPECT_EQ(pixel(draw_faces_on_atlas(mesh, std::vector<Color>{red}, 64, 64, 64, true), 1, 1), red);
}

TEST(FaceColors, ValuesGetLighter) {
  std::vector<double> values;
  for (int i = -10; i <= 110; ++i) values.push_back(i / 100.0);
  const std::vector<Color> colors = colors_of_values(values, 0, 1);
  const auto luma = [](const Color& c) {  // about the lightness that the eye sees, 0 to 100
    const auto linear = [](std::uint8_t value) { return std::pow(value / 255.0, 2.2); };
    return 100 * std::cbrt(0.21 * linear(c[0]) + 0.72 * linear(c[1]) + 0.07 * linear(c[2]));
  };
  for (std::size_t i = 1; i < colors.size(); ++i) {
    EXPECT_GE(luma(colors[i]), luma(colors[i - 1]) - 0.5) << values[i];
  }
  EXPECT_EQ(colors[0], colors[10]) << "below low as at low";
  EXPECT_EQ(colors.back(), colors[110]);
  EXPECT_GT(luma(colors[110]), luma(colors[10]) + 40);
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};
  EXPECT_EQ(colors_of_values(bad, 0, 1)[0], (Color{128, 128, 128}));
  EXPECT_EQ(colors_of_values(bad, 0, 1)[1], (Color{128, 128, 128}));
}

TEST(FaceColors, ChartsDiffer) {
  const std::uint32_t charts[] = {0, 1, 2, 3, kNone};
  const std::vector<Color> colors = colors_of_charts(charts);
  EXPECT_EQ(std::set<Color>(colors.begin(), colors.end()).size(), 5U);
}

}  // namespace
}  // namespace wrapatlas
