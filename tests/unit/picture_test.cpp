#include "wrapatlas/picture.h"

#include <gtest/gtest.h>
#include <spng.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <random>

#include "io/file.h"
#include "render/colors.h"
#include "render/coverage.h"
#include "render/outline_path.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;

Chart outline_chart(const std::vector<std::vector<Vec2>>& loops) {
  Chart chart;
  for (const auto& loop : loops) {
    const auto first = static_cast<std::uint32_t>(chart.points.size());
    const auto count = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      chart.points.push_back(loop[i]);
      chart.box.add(loop[i]);
      chart.outline.push_back({first + i, first + (i + 1) % count, 1});
    }
  }
  return chart;
}

Chart rectangle(double width, double height) {
  return outline_chart({{{0, 0}, {width, 0}, {width, height}, {0, height}}});
}

Packing packing_at(int width, int height, Wrap wrap, const std::vector<Vec2>& places) {
  Packing packing;
  packing.width = width;
  packing.height = height;
  packing.wrap = wrap;
  packing.scale = 1;
  for (const Vec2 place : places) packing.placements.push_back({0, place});
  return packing;
}

PictureOptions plain(int size) {
  PictureOptions options;
  options.size = size;
  options.ids = false;
  options.outlines = false;
  return options;
}

Rgb at(const Image& image, int x, int y) {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * image.width + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

bool is_hatch(Rgb color, std::size_t number) {
  const ChartColors colors = chart_colors(number);
  for (int i = 0; i <= 100; ++i) {
    if (mix(colors.hatch_dark, colors.hatch_light, i / 100.0) == color) return true;
  }
  return false;
}

TEST(Picture, SquareChartAtItsPlace) {
  const std::vector<Chart> charts{rectangle(20, 10)};
  const Packing packing = packing_at(100, 100, Wrap::none, {{30, 15}});
  const Image image = draw_atlas(charts, packing, plain(100));
  ASSERT_EQ(image.width, 100);
  ASSERT_EQ(image.height, 100);
  for (int y = 1; y < 99; ++y) {
    for (int x = 1; x < 99; ++x) {
      const bool inside = x >= 30 && x < 50 && y >= 75 && y < 85;  // v = 15 .. 25 from the bottom
      EXPECT_EQ(at(image, x, y), inside ? chart_colors(0).fill : kGround) << x << " " << y;
    }
  }
}

TEST(Picture, VPointsDown) {
  const std::vector<Chart> charts{rectangle(20, 10)};
  PictureOptions options = plain(100);
  options.v_points_down = true;
  const Image image = draw_atlas(charts, packing_at(100, 100, Wrap::none, {{30, 15}}), options);
  EXPECT_EQ(at(image, 40, 20), chart_colors(0).fill);
  EXPECT_EQ(at(image, 40, 80), kGround);
}

TEST(Picture, PartPixelsAreBlended) {
  const std::vector<Chart> charts{rectangle(10.5, 10)};
  const Image image = draw_atlas(charts, packing_at(64, 64, Wrap::none, {{20, 20}}), plain(64));
  EXPECT_EQ(at(image, 30, 38), mix(kGround, chart_colors(0).fill, 0.5));
}

TEST(Picture, RotationAndScale) {
  const std::vector<Chart> charts{rectangle(3, 1)};
  Packing packing = packing_at(64, 32, Wrap::none, {{20, 4}});
  packing.scale = 8;
  packing.placements[0].angle = std::numbers::pi / 2;
  const Image image = draw_atlas(charts, packing, plain(128));
  ASSERT_EQ(image.width, 128);
  ASSERT_EQ(image.height, 64);
  // u 12 .. 20, v 4 .. 28 in texels; two pixels a texel.
  EXPECT_EQ(at(image, 26, 10), chart_colors(0).fill);
  EXPECT_EQ(at(image, 38, 54), chart_colors(0).fill);
  EXPECT_EQ(at(image, 22, 30), kGround);
  EXPECT_EQ(at(image, 42, 30), kGround);
  EXPECT_EQ(at(image, 30, 4), kGround);
}

TEST(Picture, WrappedChartShowsAtBothSides) {
  const std::vector<Chart> charts{rectangle(30, 20)};
  const Image image = draw_atlas(charts, packing_at(100, 60, Wrap::uv, {{85, 50}}), plain(100));
  EXPECT_EQ(at(image, 90, 5), chart_colors(0).fill);  // v = 50 .. 60
  EXPECT_TRUE(is_hatch(at(image, 8, 5), 0));
  EXPECT_TRUE(is_hatch(at(image, 90, 55), 0));
  EXPECT_TRUE(is_hatch(at(image, 8, 55), 0));
  EXPECT_EQ(at(image, 20, 5), kGround);
  EXPECT_EQ(at(image, 50, 30), kGround);
}

TEST(Picture, WholeTilesOfTranslationChangeNothing) {
  const std::vector<Chart> charts{rectangle(30, 20)};
  const Image here = draw_atlas(charts, packing_at(128, 128, Wrap::uv, {{110, 50}}), plain(128));
  const Image there =
      draw_atlas(charts, packing_at(128, 128, Wrap::uv, {{110 - 256, 50 + 384}}), plain(128));
  EXPECT_EQ(here.rgb, there.rgb);
}

TEST(Picture, NothingIsRepeatedAlongAnAxisThatDoesNotWrap) {
  const std::vector<Chart> charts{rectangle(30, 20)};
  for (const Wrap wrap : {Wrap::none, Wrap::u, Wrap::v}) {
    const Image image = draw_atlas(charts, packing_at(100, 100, wrap, {{85, 90}}), plain(100));
    EXPECT_EQ(at(image, 90, 5), chart_colors(0).fill);
    EXPECT_EQ(at(image, 8, 5) != kGround, wraps_u(wrap));
    EXPECT_EQ(at(image, 90, 95) != kGround, wraps_v(wrap));
    EXPECT_EQ(at(image, 8, 95), kGround);
  }
}

TEST(Picture, FourTilesRepeatTheTile) {
  const std::vector<Chart> charts{rectangle(30, 20), rectangle(11, 40)};
  const Packing packing = packing_at(100, 60, Wrap::uv, {{85, 50}, {40, 12}});
  PictureOptions options = plain(200);
  options.outlines = true;
  const Image once = draw_atlas(charts, packing, options);
  options.tile2x2 = true;
  const Image four = draw_atlas(charts, packing, options);
  ASSERT_EQ(four.width, 2 * once.width);
  ASSERT_EQ(four.height, 2 * once.height);
  const int frame = 4;
  for (int y = frame; y < once.height - frame; ++y) {
    for (int x = frame; x < once.width - frame; ++x) {
      for (const int dx : {0, once.width}) {
        for (const int dy : {0, once.height}) ASSERT_EQ(at(four, x + dx, y + dy), at(once, x, y));
      }
    }
  }
  // The tile that holds [0,1) is the lower left one.
  EXPECT_EQ(at(four, 50, four.height - 1), kFrame);
  EXPECT_NE(at(four, 50, 0), kFrame);
}

TEST(Picture, FourTilesOnlyAlongAxesThatWrap) {
  const std::vector<Chart> charts{rectangle(10, 10)};
  PictureOptions options = plain(64);
  options.tile2x2 = true;
  const Image image = draw_atlas(charts, packing_at(64, 64, Wrap::v, {{10, 10}}), options);
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 128);
}

/// Distance of p from the nearest side of a counter-clockwise triangle, positive inside.
double depth_in(const std::array<Vec2, 3>& triangle, Vec2 p) {
  double depth = 1e9;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 a = triangle[i], b = triangle[(i + 1) % 3];
    depth = std::min(depth, signed_area2(a, b, p) / length(b - a));
  }
  return depth;
}

TEST(Picture, LongChartsWindAroundAsTheDefinitionSays) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi), place(-300, 300);
  for (const Wrap wrap : {Wrap::none, Wrap::u, Wrap::v, Wrap::uv}) {
    for (int round = 0; round < 6; ++round) {
      const std::vector<Chart> charts{outline_chart({{{0, 0}, {210, 0}, {190, 14}}})};
      Packing packing = packing_at(80, 64, wrap, {{place(random), place(random)}});
      packing.placements[0].angle = angle(random);
      const Image image = draw_atlas(charts, packing, plain(80));
      std::array<Vec2, 3> triangle;
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i] = packing.transform(0).apply(charts[0].points[i]);
      }
      const int columns = wraps_u(wrap) ? 12 : 0, rows = wraps_v(wrap) ? 12 : 0;
      for (int y = 1; y < 63; ++y) {
        for (int x = 1; x < 79; ++x) {
          double depth = -1e9;
          for (int i = -columns; i <= columns; ++i) {
            for (int j = -rows; j <= rows; ++j) {
              depth = std::max(depth,
                               depth_in(triangle, {x + 0.5 + 80.0 * i, 64 - y - 0.5 + 64.0 * j}));
            }
          }
          if (std::abs(depth) < 1) continue;
          ASSERT_EQ(at(image, x, y) != kGround, depth > 0) << x << " " << y;
        }
      }
    }
  }
}

TEST(Picture, HolesStayOpenAndDoubleCoverStaysCovered) {
  const std::vector<Chart> charts{
      outline_chart(
          {{{0, 0}, {40, 0}, {40, 40}, {0, 40}}, {{10, 10}, {10, 30}, {30, 30}, {30, 10}}}),
      outline_chart({{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{5, 5}, {15, 5}, {15, 15}, {5, 15}}})};
  const Image image =
      draw_atlas(charts, packing_at(100, 100, Wrap::none, {{5, 5}, {60, 60}}), plain(100));
  EXPECT_EQ(at(image, 25, 74), kGround);
  EXPECT_EQ(at(image, 10, 74), chart_colors(0).fill);
  EXPECT_EQ(at(image, 70, 30), chart_colors(1).fill);
}

TEST(Picture, TrianglesAgainstTheGrainAreDrawn) {
  // A square whose second triangle folds back over ground that the outline's winding cancels.
  Chart chart;
  chart.points = {{0, 0}, {20, 0}, {0, 20}, {40, 30}};
  chart.triangles = {{0, 1, 2}, {1, 2, 3}, {1, 3, 2}};
  chart.outline = {{0, 1, 1}, {1, 2, 1}, {2, 0, 1}};
  chart.against_grain = {1};
  const Image image =
      draw_atlas(std::vector<Chart>{chart}, packing_at(64, 64, Wrap::none, {{10, 10}}), plain(64));
  EXPECT_EQ(at(image, 14, 50), chart_colors(0).fill);
  EXPECT_EQ(at(image, 33, 34), chart_colors(0).fill);
}

TEST(Picture, NumbersAreDrawnInsideAndOnlyWhereTheyFit) {
  const std::vector<Chart> charts{rectangle(60, 60), rectangle(4, 4)};
  const Packing packing = packing_at(256, 256, Wrap::uv, {{20, 20}, {150, 150}});
  const Image without = draw_atlas(charts, packing, plain(256));
  PictureOptions options = plain(256);
  options.ids = true;
  const Image with = draw_atlas(charts, packing, options);
  int changed = 0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      if (at(with, x, y) == at(without, x, y)) continue;
      ++changed;
      EXPECT_TRUE(x >= 20 && x < 80 && y >= 176 && y < 236) << x << " " << y;
    }
  }
  EXPECT_GT(changed, 10);
}

TEST(Picture, UnusablePlacesAndEmptyInputsAreSurvived) {
  const std::vector<Chart> charts{rectangle(1, 1), Chart{}, rectangle(1e30, 1e30)};
  Packing packing = packing_at(64, 64, Wrap::uv, {{1e300, NAN}, {0, 0}, {0, 0}});
  for (const bool svg : {false, true}) {
    if (svg) {
      EXPECT_EQ(draw_atlas_svg(charts, packing, plain(64)).find("<path"), std::string::npos);
    } else {
      EXPECT_EQ(at(draw_atlas(charts, packing, plain(64)), 30, 30), kGround);
    }
  }
  packing.width = 0;
  EXPECT_TRUE(draw_atlas(charts, packing, plain(64)).rgb.empty());
}

TEST(Picture, SideBySide) {
  const std::vector<Image> images{{2, 2, std::vector<std::uint8_t>(12, 200)},
                                  {3, 4, std::vector<std::uint8_t>(36, 90)}};
  const Image row = side_by_side(images, 5);
  EXPECT_EQ(row.width, 5 + 2 + 5 + 3 + 5);
  EXPECT_EQ(row.height, 14);
  EXPECT_EQ(at(row, 5, 6), (Rgb{200, 200, 200}));
  EXPECT_EQ(at(row, 5, 5), kGround);
  EXPECT_EQ(at(row, 14, 8), (Rgb{90, 90, 90}));
}

/// Winding number of the point by its definition: turns of the loops seen from it.
int winding_of(const std::vector<Segment>& segments, Vec2 p) {
  double angle = 0;
  for (const Segment& s : segments) {
    const Vec2 a = s.from - p, b = s.to - p;
    angle += s.winding * std::atan2(cross(a, b), dot(a, b));
  }
  return static_cast<int>(std::lround(angle / (2 * std::numbers::pi)));
}

TEST(Coverage, AgreesWithTheWindingNumberOfEachSample) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-3, 13);
  for (int round = 0; round < 40; ++round) {
    std::vector<Segment> segments;
    for (int loop = 0; loop < 2; ++loop) {
      std::vector<Vec2> points(5);
      for (Vec2& p : points) p = {place(random), place(random)};
      for (std::size_t i = 0; i < 5; ++i) segments.push_back({points[i], points[(i + 1) % 5], 1});
    }
    CoverageMask mask;
    mask.reset({1, 2, 9, 11});
    mask.fill(segments);
    for (int y = 2; y < 11; ++y) {
      for (int x = 1; x < 9; ++x) {
        for (int bit = 0; bit < 64; ++bit) {
          const int column = bit % 8, row = bit / 8;
          const Vec2 sample{x + (column + 0.5) / 8, y + (row + 0.5) / 8};
          ASSERT_EQ((mask.bits(x, y) >> bit & 1) != 0, winding_of(segments, sample) != 0);
        }
      }
    }
  }
}

TEST(OutlinePath, ChainsLooseEdges) {
  const std::vector<Segment> square{
      {{1, 1}, {1, 0}}, {{0, 0}, {0, 1}}, {{1, 0}, {0, 0}}, {{0, 1}, {1, 1}}};
  EXPECT_EQ(outline_path(square), "M0 0l0 1 1 0 0-1z");
  const std::vector<Segment> twice{
      {{0, 0}, {0.25, 0}, 2}, {{0.25, 0}, {0, -1.5}, 2}, {{0, -1.5}, {0, 0}, 2}};
  EXPECT_EQ(outline_path(twice), "M0-1.5l0 1.5 .25 0zM0-1.5l0 1.5 .25 0z");
}

/// Enough of an XML check: tags nest and close, attribute quotes pair.
bool well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return false;
    if (tag.find('<') != std::string::npos || tag.find('&') != std::string::npos) return false;
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  return open.empty();
}

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Svg, OnePathAChartAndAUseForEachPart) {
  const std::vector<Chart> charts{rectangle(30, 20), rectangle(10, 40)};
  const Packing packing = packing_at(100, 60, Wrap::uv, {{85, 50}, {40, 12}});
  PictureOptions options;
  options.size = 400;
  const std::string svg = draw_atlas_svg(charts, packing, options);
  EXPECT_TRUE(well_formed(svg));
  EXPECT_EQ(occurrences(svg, "<path"), 2);
  EXPECT_EQ(occurrences(svg, "href=\"#c0\""), 7);  // one inside, three beyond with their hatching
  EXPECT_EQ(occurrences(svg, "href=\"#c1\""), 1);
  EXPECT_EQ(occurrences(svg, "<text"), 2);
  EXPECT_NE(svg.find("href=\"#c0\" x=\"-400\" y=\"240\""), std::string::npos);
  EXPECT_NE(svg.find("viewBox=\"0 0 400 240\""), std::string::npos);
  options.tile2x2 = true;
  const std::string four = draw_atlas_svg(charts, packing, options);
  EXPECT_TRUE(well_formed(four));
  EXPECT_EQ(occurrences(four, "href=\"#atlas\""), 3);
}

class PictureFile : public ::testing::Test {
 protected:
  PictureFile() : folder_(fs::path(::testing::TempDir()) / "wrapatlas_picture_test") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~PictureFile() override { fs::remove_all(folder_); }
  fs::path folder_;
  std::vector<Chart> charts_{rectangle(30, 20)};
  Packing packing_ = packing_at(100, 70, Wrap::uv, {{85, 50}});
};

TEST_F(PictureFile, PngDecodesToTheImage) {
  const Image image = draw_atlas(charts_, packing_, plain(150));
  ASSERT_TRUE(save_atlas_picture(folder_ / "a.PNG", charts_, packing_, plain(150)));
  const auto bytes = read_file(folder_ / "a.PNG");
  ASSERT_TRUE(bytes);
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(0),
                                                                    &spng_ctx_free);
  ASSERT_EQ(spng_set_png_buffer(context.get(), bytes->data(), bytes->size()), 0);
  spng_ihdr header{};
  ASSERT_EQ(spng_get_ihdr(context.get(), &header), 0);
  EXPECT_EQ(header.width, 150U);
  EXPECT_EQ(header.height, 105U);
  std::size_t size = 0;
  ASSERT_EQ(spng_decoded_image_size(context.get(), SPNG_FMT_RGB8, &size), 0);
  std::vector<std::uint8_t> rgb(size);
  ASSERT_EQ(spng_decode_image(context.get(), rgb.data(), rgb.size(), SPNG_FMT_RGB8, 0), 0);
  EXPECT_EQ(rgb, image.rgb);
}

TEST_F(PictureFile, SvgByItsEnding) {
  ASSERT_TRUE(save_atlas_picture(folder_ / "a.svg", charts_, packing_, plain(150)));
  const auto bytes = read_file(folder_ / "a.svg");
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, draw_atlas_svg(charts_, packing_, plain(150)));
}

TEST_F(PictureFile, ErrorsLeaveNothing) {
  const Status unknown = save_atlas_picture(folder_ / "a.gif", charts_, packing_, plain(64));
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::usage);
  const Status empty = save_png(folder_ / "a.png", Image{});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().kind, ErrorKind::output);
  const Status torn = save_png(folder_ / "a.png", Image{2, 2, {1, 2, 3}});
  ASSERT_FALSE(torn);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST(Picture, PagesLieAsInUvSpace) {
  const std::vector<Chart> charts(12, rectangle(4, 4));
  Packing packing = packing_at(4, 4, Wrap::none, std::vector<Vec2>(12));
  packing.pages = 12;
  for (int i = 0; i < 12; ++i) packing.placements[static_cast<std::size_t>(i)].page = i;
  const PictureOptions options = plain(32);
  const Image image = draw_atlas(charts, packing, options);
  constexpr int kGap = 4, kStep = 32 + kGap;
  ASSERT_EQ(image.width, 10 * kStep + kGap);
  ASSERT_EQ(image.height, 2 * kStep + kGap);
  for (int page = 0; page < 20; ++page) {
    const int x = kGap + page % 10 * kStep + 16, y = kGap + (1 - page / 10) * kStep + 16;
    const Rgb expected = page < 12 ? chart_colors(static_cast<std::size_t>(page)).fill : kGround;
    EXPECT_EQ(at(image, x, y), expected) << page;
  }
  const std::string svg = draw_atlas_svg(charts, packing, options);
  EXPECT_NE(svg.find("x=\"4\" y=\"40\""), std::string::npos);
  EXPECT_NE(svg.find("id=\"tile-11\""), std::string::npos);
}

TEST(Picture, VeryManyPagesAreDrawnSmaller) {
  Packing packing = packing_at(4, 4, Wrap::none, {{0, 0}});
  packing.pages = 1000;
  const std::vector<Chart> charts{rectangle(4, 4)};
  const Image image = draw_atlas(charts, packing, plain(8192));
  EXPECT_LE(image.height, 16384);
  EXPECT_GT(image.height, 15000);
}

}  // namespace
}  // namespace wrapatlas
