// Values of faces as colours, and faces in their colours on the atlas.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "support/solids.h"
#include "wrapatlas/picture.h"
#include "wrapatlas/view.h"

namespace wrapatlas {
namespace {

Color pixel(const Image& image, int x, int y) {
  const std::size_t at = 3 * (std::size_t(y) * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

TEST(DrawFacesOnAtlas, WrapsAsTexturesDo) {
  Mesh mesh = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  mesh.texcoords = {{0.75, 0.25}, {1.25, 0.25}, {1.25, 0.75}, {0.75, 0.75}};
  mesh.corner_texcoord = {0, 1, 2, 3};
  const Color red{200, 0, 0};
  const Image image = draw_faces_on_atlas(mesh, std::vector<Color>{red}, 64, 32, 64);
  ASSERT_EQ(image.width, 64);
  ASSERT_EQ(image.height, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool inside = (x >= 48 || x < 16) && y >= 8 && y < 24;  // on both sides of the border
      EXPECT_EQ(pixel(image, x, y) == red, inside) << x << " " << y;
    }
  }
  mesh.corner_texcoord[2] = kNone;
  const Image none = draw_faces_on_atlas(mesh, std::vector<Color>{red}, 64, 32, 64);
  EXPECT_EQ(pixel(none, 60, 16), pixel(none, 32, 16)) << "without all UVs it is nowhere";
}

TEST(DrawFacesOnAtlas, AFaceMayWindAroundOrBeFarAway) {
  const Color red{200, 0, 0};
  for (const double side : {5.0, 300.0, 1e9, 1e29}) {
    Mesh mesh = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
    mesh.texcoords = {{-side, 0.25}, {side, 0.25}, {side, 0.75}, {-side, 0.75}};
    mesh.corner_texcoord = {0, 1, 2, 3};
    const Image image = draw_faces_on_atlas(mesh, std::vector<Color>{red}, 64, 64, 64);
    for (int x = 0; x < 64; ++x) {
      EXPECT_EQ(pixel(image, x, 32) == red, side < 1e10) << side << " " << x;
      EXPECT_EQ(pixel(image, x, 4), pixel(image, 0, 0));
    }
  }
  Mesh huge = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  huge.texcoords = {{0, 0}, {4000, 0}, {0, 4000}};
  huge.corner_texcoord = {0, 1, 2};
  const Image covered = draw_faces_on_atlas(huge, std::vector<Color>{red}, 64, 64, 64);
  EXPECT_EQ(pixel(covered, 0, 0), red);
  EXPECT_EQ(pixel(covered, 63, 63), red);
  const Image least = draw_faces_on_atlas(huge, std::vector<Color>{red}, 64, 32, -5);
  EXPECT_EQ(least.width, 16);
  EXPECT_EQ(least.height, 8);
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
