// Several pages, and packing at a given density.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "guided/page_fill.h"
#include "support/same_packing.h"
#include "support/shapes.h"
#include "support/soup_check.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/model.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {
namespace {

using test::mixed_charts;
using test::rectangle;

/// None longer than 1.3 in any direction.
std::vector<Chart> small_charts(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  std::vector<Chart> charts;
  for (int i = 0; i < count; ++i) {
    const double size = std::exp(test::uniform(random, -2.5, -0.5));
    charts.push_back(i % 3 == 0 ? rectangle(1.5 * size, test::uniform(random, 0.2, 1) * size)
                                : test::star(random, 6 + i % 9, 0.4 * size, size));
  }
  return charts;
}

PackOptions paged(int pages, double density, Wrap wrap = Wrap::uv) {
  PackOptions options;
  options.method = Method::guided;
  options.wrap = wrap;
  options.width = options.height = 192;
  options.padding = 2;
  options.time = 0;
  options.threads = 2;
  options.pages = pages;
  options.density = density;
  return options;
}

Packing packed(const std::vector<Chart>& charts, const PackOptions& options) {
  auto packing = pack(charts, options);
  EXPECT_TRUE(packing) << (packing ? "" : packing.error().message());
  return packing ? std::move(*packing) : Packing{};
}

double area_of(const std::vector<Chart>& charts) {
  double area = 0;
  for (const Chart& chart : charts) area += chart.area;
  return area;
}

/// Every chart on a page that is there, no page empty, nothing too close on any.
void expect_sound(const std::vector<Chart>& charts, const Packing& packing,
                  const PackOptions& options) {
  ASSERT_EQ(packing.placements.size(), charts.size());
  std::size_t placed = 0;
  for (int page = 0; page < packing.pages; ++page) {
    std::vector<Chart> here;
    Packing alone = packing;
    alone.placements.clear();
    for (std::size_t i = 0; i < charts.size(); ++i) {
      if (packing.placements[i].page != page) continue;
      here.push_back(charts[i]);
      alone.placements.push_back(packing.placements[i]);
    }
    EXPECT_FALSE(here.empty()) << "page " << page;
    EXPECT_EQ(test::check_packing(here, alone, options), "") << "page " << page;
    placed += here.size();
  }
  EXPECT_EQ(placed, charts.size());
  const double texels = double(packing.pages) * packing.width * packing.height;
  EXPECT_NEAR(packing.efficiency, packing.scale * packing.scale * area_of(charts) / texels, 1e-12);
}

TEST(Pages, AGivenDensityIsKeptExactlyOnAsManyPagesAsNeeded) {
  for (const Wrap wrap : {Wrap::uv, Wrap::u, Wrap::none}) {
    const auto charts = small_charts(1, 60);
    for (const double density : {10.0, 95.5, 140.0}) {
      const PackOptions options = paged(0, density, wrap);
      const Packing packing = packed(charts, options);
      EXPECT_EQ(packing.scale, density);
      expect_sound(charts, packing, options);
      const double full = density * density * area_of(charts) / (192.0 * 192.0);
      EXPECT_GE(packing.pages, full);
      EXPECT_LE(packing.pages, std::ceil(2.2 * full));
    }
  }
}

TEST(Pages, AGivenNumberOfPagesHasALargerScaleThanOne) {
  const auto charts = mixed_charts(2, 80);
  const double one = packed(charts, paged(1, 0)).scale;
  for (const int pages : {2, 3, 5}) {
    const PackOptions options = paged(pages, 0);
    const Packing packing = packed(charts, options);
    EXPECT_LE(packing.pages, pages);
    EXPECT_GT(packing.scale, one);
    expect_sound(charts, packing, options);
  }
}

/// Naive: the charts dealt out to pages by decreasing area, each page packed by modulo, the
/// smallest scale taken for all.
TEST(Pages, AreAtLeastAsDenseAsChartsDealtOut) {
  const auto charts = mixed_charts(3, 90);
  std::vector<const Chart*> by_area;
  for (const Chart& chart : charts) by_area.push_back(&chart);
  std::stable_sort(by_area.begin(), by_area.end(),
                   [](const Chart* a, const Chart* b) { return a->area > b->area; });
  constexpr std::size_t kPages = 3;
  double naive = std::numeric_limits<double>::infinity();
  for (std::size_t page = 0; page < kPages; ++page) {
    std::vector<Chart> dealt;
    for (std::size_t i = page; i < by_area.size(); i += kPages) dealt.push_back(*by_area[i]);
    PackOptions options = paged(1, 0);
    options.method = Method::modulo;
    naive = std::min(naive, packed(dealt, options).scale);
  }
  EXPECT_GE(packed(charts, paged(kPages, 0)).scale, naive);
}

TEST(Pages, OneSquareAPageFillsIt) {
  const std::vector<Chart> charts(4, rectangle(1, 1));
  const PackOptions options = paged(4, 0, Wrap::none);
  const Packing packing = packed(charts, options);
  EXPECT_EQ(packing.pages, 4);
  EXPECT_GT(packing.scale, 187);  // of 192 less a texel of margin on each side
  expect_sound(charts, packing, options);
}

TEST(Pages, ThatNoChartIsOnAreNotCounted) {
  std::vector<Chart> charts{rectangle(1, 1), rectangle(0.2, 0.1), rectangle(0.1, 0.1)};
  const Packing packing = packed(charts, paged(7, 0));
  EXPECT_EQ(packing.pages, 2);
}

TEST(Pages, AChartTooLargeForAPageIsNamedWithTheDensityThatFits) {
  auto charts = small_charts(4, 20);
  charts.insert(charts.begin() + 7, rectangle(6, 1));
  charts.insert(charts.begin() + 12, rectangle(4, 2.5));
  PackOptions options = paged(0, 90, Wrap::none);
  const auto refused = pack(charts, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::no_packing);
  EXPECT_EQ(refused.error().where, "chart 7");
  const double fits = refused.error().density_that_fits;
  EXPECT_GT(fits, 30);
  EXPECT_LT(fits, 90);
  options.density = fits;
  expect_sound(charts, packed(charts, options), options);
  options.density = 1.01 * fits;
  EXPECT_FALSE(pack(charts, options));
}

TEST(Pages, MoreThanAllowedAreAnError) {
  const auto charts = small_charts(5, 60);
  PackOptions options = paged(0, 130);
  const int needed = packed(charts, options).pages;
  ASSERT_GT(needed, 2);
  options.pages = needed;
  EXPECT_EQ(packed(charts, options).pages, needed);
  options.pages = needed - 1;
  const auto refused = pack(charts, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::no_packing);
  EXPECT_NE(refused.error().remedy.find(std::to_string(needed)), std::string::npos);
}

TEST(Pages, OptionsThatMakeNoSenseAreRefused) {
  const auto charts = mixed_charts(6, 3);
  const auto refused = [&](auto change) {
    PackOptions options = paged(1, 0);
    change(options);
    const auto packing = pack(charts, options);
    return !packing && packing.error().kind == ErrorKind::usage;
  };
  EXPECT_TRUE(refused([](PackOptions& o) { o.pages = -1; }));
  EXPECT_TRUE(refused([](PackOptions& o) { o.pages = kMostPages + 1; }));
  EXPECT_TRUE(refused([](PackOptions& o) { o.pages = 0; }));
  EXPECT_TRUE(refused([](PackOptions& o) { o.density = -1; }));
  EXPECT_TRUE(refused([](PackOptions& o) { o.density = std::nan(""); }));
  EXPECT_TRUE(refused([](PackOptions& o) {
    o.method = Method::modulo;
    o.pages = 2;
  }));
  EXPECT_TRUE(refused([](PackOptions& o) {
    o.method = Method::modulo;
    o.density = 3;
  }));
}

TEST(PagesParallel, ThreadsDoNotChangeTheResult) {
  const auto charts = small_charts(7, 70);
  for (const auto& [pages, density] : {std::pair{3, 0.0}, std::pair{0, 120.0}}) {
    PackOptions options = paged(pages, density);
    options.threads = 1;
    const Packing one = packed(charts, options);
    for (const int threads : {2, 5}) {
      options.threads = threads;
      const Packing other = packed(charts, options);
      EXPECT_EQ(one.pages, other.pages);
      test::expect_same(one, other);
    }
  }
}

TEST(Pages, AFillingIsFirstFit) {
  // Four to a page: they go onto pages in their order, and the small one into the first gap.
  std::vector<Chart> charts;
  for (const double side : {0.4, 0.4, 0.4, 0.4, 0.4, 0.4, 0.08}) {
    charts.push_back(rectangle(side, side));
  }
  const std::vector<ChartShape> shapes = make_shapes(charts);
  const std::vector<std::vector<double>> angles(charts.size(), {0.0});
  const std::vector<std::uint32_t> order{0, 1, 2, 3, 4, 5, 6};
  const auto frame = make_frame(100, 100, 1, paged(1, 0));
  ASSERT_TRUE(frame);
  const PageTask task{
      shapes, angles, *frame, Wrap::none, Coverage::conservative, care_for(shapes.size(), false)};
  const auto filling = fill_pages(task, 100, order, 0, [] { return false; });
  ASSERT_TRUE(filling);
  EXPECT_EQ(filling->pages(), 2);
  const int expected[] = {0, 0, 0, 0, 1, 1, 0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(filling->placements[i].page, expected[i]) << i;
  }
  EXPECT_TRUE(fill_pages(task, 100, order, 2, [] { return false; }));
  HowFar how_far;
  EXPECT_FALSE(fill_pages(
      task, 100, order, 1, [] { return false; }, &how_far));
  EXPECT_EQ(how_far.left_out, 4U);
  EXPECT_NEAR(how_far.placed, 0.64, 1e-9);
  EXPECT_FALSE(fill_pages(task, 100, order, 0, [] { return true; }));
}

TEST(Pages, AChartLargerThanAPageFillsNone) {
  const std::vector<ChartShape> shapes =
      make_shapes(std::vector<Chart>{rectangle(1, 1), rectangle(0.1, 0.1)});
  const std::vector<std::vector<double>> angles(2, {0.0});
  const auto frame = make_frame(60, 60, 1, paged(1, 0));
  ASSERT_TRUE(frame);
  const PageTask task{
      shapes, angles, *frame, Wrap::none, Coverage::conservative, care_for(shapes.size(), false)};
  const std::vector<std::uint32_t> order{0, 1};
  for (const int most : {0, 2, 5}) {
    EXPECT_TRUE(fill_pages(task, 40, order, most, [] { return false; })) << most;
    EXPECT_FALSE(fill_pages(task, 62, order, most, [] { return false; })) << most;
  }
}

/// Some of these are first fit with a page hardly filled, which is then emptied.
TEST(Pages, EmptyingAPageLeavesASoundPacking) {
  const auto charts = small_charts(9, 60);
  const std::vector<ChartShape> shapes = make_shapes(charts);
  std::vector<std::vector<double>> angles;
  for (const ChartShape& shape : shapes) angles.push_back(best_fit_angles(shape.base_angle, 16));
  std::vector<std::uint32_t> order(charts.size());
  std::iota(order.begin(), order.end(), 0U);
  order = order_by_extent(shapes, std::move(order), 0);
  int before = 1, saved = 0;
  for (int step = 0; step < 70; ++step) {
    const PackOptions options = paged(0, 80 * std::pow(1.01, step));
    const Packing packing = packed(charts, options);
    expect_sound(charts, packing, options);
    EXPECT_LE(packing.pages, before + 1);
    before = packing.pages;
    const auto frame = make_frame(options.width, options.height, 1, options);
    ASSERT_TRUE(frame);
    const PageTask task{shapes,       angles,           *frame,
                        options.wrap, options.coverage, care_for(shapes.size(), false)};
    const auto filling = fill_pages(task, options.density, order, 0, [] { return false; });
    ASSERT_TRUE(filling);
    EXPECT_LE(packing.pages, filling->pages());
    saved += filling->pages() - packing.pages;
  }
  EXPECT_GT(saved, 0);
}

TEST(Pages, RoundingIsThatOfFloats) {
  for (const int pages : {1, 2, 10, 11, 60, 70, 71, 160, 999, 1000}) {
    const int last_row = (pages - 1) / 10, last_column = pages > 1 ? 9 : 0;
    const auto most = static_cast<float>(std::max(last_row, last_column) + 2);
    const float below = std::nextafter(most, 0.0F);
    EXPECT_EQ(page_rounding(pages), double{most - below} / 2) << pages;
  }
}

/// A mesh of the charts, each lying apart in space.
Mesh mesh_of(const std::vector<Chart>& charts) {
  Mesh mesh;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec2 p : charts[i].points) {
      mesh.positions.push_back({p.x, p.y, double(i)});
      mesh.texcoords.push_back(p);
    }
    for (const auto& triangle : charts[i].triangles) {
      for (const std::uint32_t corner : triangle) {
        mesh.corner_position.push_back(first + corner);
        mesh.corner_texcoord.push_back(first + corner);
      }
      mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
    }
  }
  return mesh;
}

class PagesOnTiles : public testing::TestWithParam<bool> {};

/// The floor of a chart's smallest corner tells its page, whatever wraps.
TEST_P(PagesOnTiles, ChartsBeginOnTheTileOfTheirPage) {
  const bool down = GetParam();
  const Mesh mesh = mesh_of(small_charts(8, 150));
  const auto charts = build_charts(mesh);
  ASSERT_TRUE(charts);
  for (const Wrap wrap : {Wrap::uv, Wrap::v, Wrap::none}) {
    const PackOptions options = paged(0, 140, wrap);
    const Packing packing = packed(charts->charts, options);
    ASSERT_GT(packing.pages, 10);
    AtlasMesh whole = export_continuous(mesh, *charts, packing, down);
    AtlasMesh cut = export_cut(mesh, *charts, packing, down);
    for (AtlasMesh* atlas : {&whole, &cut}) {
      EXPECT_EQ(atlas->pages, packing.pages);
      round_texcoords_to_float(*atlas);
      std::vector<Box2> boxes(charts->charts.size());
      for (std::size_t f = 0; f < atlas->face_count(); ++f) {
        const std::uint32_t chart = charts->face_chart[atlas->face_source[f]];
        for (std::uint32_t c = atlas->face_begin[f]; c < atlas->face_begin[f + 1]; ++c) {
          const Vec2 uv = atlas->texcoords[atlas->corner_texcoord[c]];
          boxes[chart].add({uv.x, down ? 1 - uv.y : uv.y});
        }
      }
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const int page = packing.placements[i].page;
        EXPECT_EQ(std::floor(boxes[i].min.x), page % 10) << i;
        EXPECT_EQ(std::floor(boxes[i].min.y), page / 10) << i;
        if (atlas == &cut || wrap == Wrap::none) {
          EXPECT_LE(boxes[i].max.x, page % 10 + 1);
          EXPECT_LE(boxes[i].max.y, page / 10 + 1);
        }
      }
      CheckOptions promise;
      promise.width = promise.height = 192;
      promise.wrap = atlas == &cut ? Wrap::none : wrap;
      promise.cut = atlas == &cut ? wrap : Wrap::none;
      promise.padding = 2;
      promise.margin = 1;
      promise.pages = packing.pages;
      promise.v_points_down = down;
      const auto report = check_atlas(apply_atlas(mesh, *atlas), &mesh, promise);
      ASSERT_TRUE(report);
      EXPECT_TRUE(report->ok()) << report->findings.front().text;
      EXPECT_EQ(report->pages, static_cast<std::size_t>(packing.pages));
      EXPECT_NEAR(report->efficiency, packing.efficiency, 1e-5);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(VDirection, PagesOnTiles, testing::Bool());

TEST(Pages, TexelDensityIsTheMeanOfTheSurface) {
  Mesh mesh = mesh_of({rectangle(2, 2), rectangle(3, 4)});
  EXPECT_DOUBLE_EQ(uv_density(mesh), 1);
  for (Vec3& p : mesh.positions) p = {6 * p.x, 0, 6 * p.y};
  EXPECT_DOUBLE_EQ(uv_density(mesh), 1.0 / 6);
  for (std::size_t i = 4; i < 8; ++i) mesh.texcoords[i] = {0, 0};
  EXPECT_DOUBLE_EQ(uv_density(mesh), std::sqrt(4.0 / (36 * 16)));
  for (Vec3& p : mesh.positions) p = {};
  EXPECT_EQ(uv_density(mesh), 0);
}

/// A corner that a float would round up to the next tile, and one a hair below its own.
TEST(Pages, ChartsOnTheEdgeOfATileStayOnTheirPage) {
  const Mesh mesh = mesh_of({rectangle(4, 4), rectangle(4, 4)});
  const auto charts = build_charts(mesh);
  ASSERT_TRUE(charts);
  Packing packing;
  packing.width = packing.height = 64;
  packing.wrap = Wrap::uv;
  packing.scale = 1;
  packing.pages = 14;
  for (const double edge : {-1e-17, -1e-9, -1e-7, -1e-6, 0.0, 64 - 1e-9, 64 - 1e-7}) {
    packing.placements = {{0, {edge, edge}, 13}, {0, {30, 30}, 0}};
    AtlasMesh atlas = export_continuous(mesh, *charts, packing);
    round_texcoords_to_float(atlas);
    const Vec2 corner = atlas.texcoords[atlas.corner_texcoord[0]];
    EXPECT_EQ(std::floor(corner.x), 3) << edge;
    EXPECT_EQ(std::floor(corner.y), 1) << edge;
  }
}

}  // namespace
}  // namespace wrapatlas
