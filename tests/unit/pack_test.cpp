#include "wrapatlas/pack.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <new>
#include <thread>

#include "pack/frame.h"
#include "pack/scale_search.h"
#include "support/same_packing.h"
#include "support/shapes.h"
#include "support/soup_check.h"
#include "threads/parallel.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {
namespace {

PackOptions options_for(Method method, Wrap wrap) {
  PackOptions options;
  options.method = method;
  options.wrap = wrap;
  options.width = options.height = 256;
  options.grid = 128;
  options.threads = 1;
  options.time = 0;
  return options;
}

struct Setting {
  Method method;
  Wrap wrap;
};

class EveryMethod : public ::testing::TestWithParam<Setting> {};

TEST_P(EveryMethod, KeepsItsPromisesOnRandomCharts) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const std::vector<Chart> charts = test::mixed_charts(seed, 3 + static_cast<int>(seed) * 3);
    PackOptions options = options_for(GetParam().method, GetParam().wrap);
    options.padding = static_cast<double>(seed % 4) * 1.5;
    if (seed % 3 == 0) options.margin = 5;
    if (seed % 2 == 0) options.rotation_base = RotationBase::box;
    if (seed == 5) options.height = 100;
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    ASSERT_EQ(packing->placements.size(), charts.size());
    EXPECT_EQ(test::check_packing(charts, *packing, options), "") << "seed " << seed;
    EXPECT_GT(packing->efficiency, 0.15);
    EXPECT_LT(packing->efficiency, 1);
    EXPECT_LE(packing->efficiency, packing->raster_efficiency * 1.0 + 1e-9);
  }
}

TEST_P(EveryMethod, SameBitsForAnyNumberOfThreads) {
  const std::vector<Chart> charts = test::mixed_charts(20, 12);
  PackOptions options = options_for(GetParam().method, GetParam().wrap);
  // guided goes through the shapes one by one: the thread sanitizer takes minutes for all 31.
  options.aspect = options.method == Method::guided ? Aspect::pow2 : Aspect::search;
  options.grid = 64;
  const auto one = pack(charts, options);
  options.threads = 3;
  const auto three = pack(charts, options);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->packings, three->packings);
  test::expect_same(*one, *three);
}

TEST_P(EveryMethod, CentreCoverageIsNoLooser) {
  // Thin charts have rows and columns without a cell centre; they must not be in the way.
  const std::vector<Chart> charts = test::mixed_charts(9, 14);
  PackOptions options = options_for(GetParam().method, GetParam().wrap);
  options.padding = 0;
  const auto safe = pack(charts, options);
  options.coverage = Coverage::center;
  const auto loose = pack(charts, options);
  ASSERT_TRUE(safe && loose);
  EXPECT_GT(loose->efficiency, 0.97 * safe->efficiency);
}

TEST_P(EveryMethod, OneChartAndManyTiny) {
  PackOptions options = options_for(GetParam().method, GetParam().wrap);
  const std::vector<Chart> one{test::rectangle(3, 2)};
  const auto single = pack(one, options);
  ASSERT_TRUE(single) << single.error().message();
  EXPECT_EQ(test::check_packing(one, *single, options), "");

  const std::vector<Chart> many(600, test::rectangle(1, 1));
  const auto crowd = pack(many, options);
  ASSERT_TRUE(crowd) << crowd.error().message();
  EXPECT_EQ(test::check_packing(many, *crowd, options), "");
}

INSTANTIATE_TEST_SUITE_P(
    Methods, EveryMethod,
    ::testing::Values(Setting{Method::modulo, Wrap::uv}, Setting{Method::modulo, Wrap::u},
                      Setting{Method::modulo, Wrap::v}, Setting{Method::modulo, Wrap::none},
                      Setting{Method::guided, Wrap::uv}, Setting{Method::guided, Wrap::u},
                      Setting{Method::guided, Wrap::v}, Setting{Method::guided, Wrap::none},
                      Setting{Method::lprm02, Wrap::none}, Setting{Method::swg03, Wrap::none},
                      Setting{Method::zsgs04, Wrap::none}));

TEST(Pack, WrapLetsALongChartLieAcrossTheBorder) {
  // A diagonal strip longer than the texture can only reach a high share by winding around.
  const std::vector<Chart> charts{test::rectangle(8, 1)};
  PackOptions options = options_for(Method::modulo, Wrap::uv);
  options.padding = 0;
  options.rotations = 64;
  const auto torus = pack(charts, options);
  options.wrap = Wrap::none;
  const auto plain = pack(charts, options);
  ASSERT_TRUE(torus && plain);
  EXPECT_EQ(test::check_packing(charts, *torus, options_for(Method::modulo, Wrap::uv)), "");
  EXPECT_GT(torus->efficiency, 2 * plain->efficiency);
}

TEST(Pack, BlocksAreNotShared) {
  const std::vector<Chart> charts = test::mixed_charts(3, 10);
  PackOptions options = options_for(Method::modulo, Wrap::uv);
  options.block = 4;
  options.padding = 0;
  const auto packing = pack(charts, options);
  ASSERT_TRUE(packing);
  EXPECT_EQ(test::check_blocks(charts, *packing, 4), "");
  options.width = 258;
  EXPECT_FALSE(pack(charts, options));
}

TEST(Pack, StopsWithTheBestSoFar) {
  const std::vector<Chart> charts = test::mixed_charts(5, 150);
  PackOptions options = options_for(Method::modulo, Wrap::uv);
  options.aspect = Aspect::search;
  options.progress = [](const Progress& progress) { return progress.best_efficiency == 0; };
  const auto packing = pack(charts, options);
  ASSERT_TRUE(packing) << packing.error().message();
  EXPECT_TRUE(packing->interrupted);
  EXPECT_EQ(test::check_packing(charts, *packing, options), "");

  options.progress = [](const Progress&) { return false; };
  const auto nothing = pack(charts, options);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().kind, ErrorKind::interrupted);
}

TEST(Pack, BadOptionsAreUsageErrors) {
  const std::vector<Chart> charts{test::rectangle(1, 1)};
  const auto kind_with = [&](auto change) {
    PackOptions options = options_for(Method::modulo, Wrap::uv);
    change(options);
    const auto packing = pack(charts, options);
    return packing ? ErrorKind::check : packing.error().kind;
  };
  EXPECT_EQ(kind_with([](PackOptions& o) { o.width = 0; }), ErrorKind::usage);
  EXPECT_EQ(kind_with([](PackOptions& o) { o.padding = -1; }), ErrorKind::usage);
  EXPECT_EQ(kind_with([](PackOptions& o) { o.padding = std::nan(""); }), ErrorKind::usage);
  EXPECT_EQ(kind_with([](PackOptions& o) { o.rotations = 0; }), ErrorKind::usage);
  EXPECT_EQ(kind_with([](PackOptions& o) { o.grid = 100000; }), ErrorKind::usage);
  EXPECT_EQ(kind_with([](PackOptions& o) { o.method = Method::swg03; }), ErrorKind::usage);
  EXPECT_EQ(kind_with([](PackOptions& o) { o.wrap = Wrap::none, o.margin = 200; }),
            ErrorKind::usage);
  EXPECT_EQ(kind_with([](PackOptions& o) { o.padding = 300; }), ErrorKind::no_packing);
  EXPECT_FALSE(pack({}, options_for(Method::modulo, Wrap::uv)));
}

TEST(Pack, ChartsWithoutAreaAreAnInputError) {
  const auto triangle = [](double height) {
    return chart_from_triangles({{0, 0}, {1, 0}, {0.5, height}}, {{0, 1, 2}});
  };
  const auto kind = [](const std::vector<Chart>& charts) {
    const auto packing = pack(charts, options_for(Method::modulo, Wrap::uv));
    return packing ? ErrorKind::check : packing.error().kind;
  };
  EXPECT_EQ(kind({triangle(0)}), ErrorKind::input);
  EXPECT_EQ(kind({triangle(1e-17)}), ErrorKind::input);
  EXPECT_EQ(kind({triangle(1e-10), triangle(0)}), ErrorKind::input);
  EXPECT_EQ(kind({chart_from_triangles({{0.1, 0.2}, {0.3, 0.4}, {0.4, 0.5}}, {{0, 1, 2}})}),
            ErrorKind::input)
      << "collinear but for rounding";
  EXPECT_EQ(kind({triangle(1e-17), triangle(1)}), ErrorKind::check) << "a good one is packed";
  EXPECT_EQ(kind({triangle(1e-6)}), ErrorKind::check) << "thin, and packed";
}

TEST(Pack, LimitsOfTheGridHold) {
  const std::vector<Chart> charts{test::rectangle(1, 1)};
  PackOptions options = options_for(Method::modulo, Wrap::uv);
  options.width = options.height = 8192;
  options.grid = 8192;
  options.aspect = Aspect::search;
  EXPECT_EQ(pack(charts, options).error().kind, ErrorKind::usage);

  options = options_for(Method::modulo, Wrap::none);
  options.width = options.height = 1;
  options.padding = 4096;
  options.margin = 0;
  EXPECT_FALSE(pack(charts, options));
}

TEST(Pack, AspectSearchKeepsToBlocksLargerThanCells) {
  PackOptions options = options_for(Method::modulo, Wrap::uv);
  options.aspect = Aspect::search;
  options.block = 16;
  options.padding = 0;
  const std::vector<Chart> charts = test::mixed_charts(4, 6);
  const auto packing = pack(charts, options);
  ASSERT_TRUE(packing) << packing.error().message();
  EXPECT_EQ(packing->width % 16, 0);
  EXPECT_EQ(packing->height % 16, 0);
  EXPECT_EQ(test::check_blocks(charts, *packing, 16), "");
}

TEST(ScaleSearch, FollowsThePaper) {
  // Everything up to 0.5 succeeds: the factors tried are those of section 2.2.3 by hand.
  std::vector<double> tried;
  ScaleSearchOptions options;
  options.upper = 0.9;
  const auto best = search_scale(
      options, [&](double f) { return tried.push_back(f), f <= 0.5; }, [] { return false; });
  ASSERT_GE(tried.size(), 4U);
  EXPECT_DOUBLE_EQ(tried[0], 0.5);  // l = 0.5
  EXPECT_DOUBLE_EQ(tried[1], 0.7);  // u = 0.7 + 0.2 / 3
  EXPECT_DOUBLE_EQ(tried[2], (0.5 + 0.7 + 0.2 / 3) / 2);
  EXPECT_DOUBLE_EQ(best.value(), 0.5);
}

TEST(ScaleSearch, KeepsTheBestWhenSuccessIsNotMonotone) {
  const auto best = search_scale(
      {}, [](double f) { return f < 0.4 || (f > 0.54 && f < 0.56); }, [] { return false; });
  EXPECT_GT(best.value(), 0.54);
}

TEST(ScaleSearch, GoesBelowTheFirstLowerBoundAndGivesUp) {
  const auto small = search_scale(
      {}, [](double f) { return f < 0.013; }, [] { return false; });
  ASSERT_TRUE(small.has_value());
  EXPECT_GT(*small, 0.009);
  EXPECT_FALSE(search_scale(
                   {}, [](double) { return false; }, [] { return false; })
                   .has_value());
}

TEST(ParallelFor, RunsEachJobOnce) {
  for (const int threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> runs(1000);
    parallel_for(runs.size(), threads, [&](std::size_t i) { ++runs[i]; });
    for (const auto& count : runs) ASSERT_EQ(count, 1);
  }
  parallel_for(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, PassesOnWhatAJobThrows) {
  for (const int threads : {1, 3}) {
    std::atomic<int> runs{0};
    EXPECT_THROW(parallel_for(1000, threads,
                              [&](std::size_t i) {
                                ++runs;
                                if (i == 10) throw std::bad_alloc();
                                // All others take half a second: time for one to be thrown.
                                if (i > 10)
                                  std::this_thread::sleep_for(std::chrono::milliseconds(1));
                              }),
                 std::bad_alloc);
    EXPECT_LT(runs, 1000);
  }
}

/// What is promised holds in the floats that are written, whatever the size of the texture.
TEST(Padding, HoldsToTheLastBitOfTheLargestTexture) {
  for (const int side : {1024, 16384, 65536}) {
    const std::vector<Chart> charts = test::mixed_charts(31, 24);
    PackOptions options = options_for(Method::modulo, Wrap::uv);
    options.width = options.height = side;
    options.padding = side / 256.0;
    const auto packing = pack(charts, options);
    ASSERT_TRUE(packing) << packing.error().message();
    Mesh mesh;
    for (std::size_t i = 0; i < charts.size(); ++i) {
      const Similarity place = packing->transform(i);
      for (const auto& triangle : charts[i].triangles) {
        for (const std::uint32_t p : triangle) {
          const Vec2 texel = place.apply(charts[i].points[p]);
          const volatile float u = static_cast<float>(texel.x / side);
          const volatile float v = static_cast<float>(texel.y / side);
          mesh.corner_position.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
          mesh.corner_texcoord.push_back(static_cast<std::uint32_t>(mesh.texcoords.size()));
          mesh.positions.push_back({charts[i].points[p].x, charts[i].points[p].y, double(i)});
          mesh.texcoords.push_back({u, v});
        }
        mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
      }
    }
    CheckOptions check;
    check.width = check.height = side;
    check.wrap = Wrap::uv;
    check.padding = options.padding;
    const auto report = check_atlas(mesh, nullptr, check);
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_TRUE(report->ok());
    EXPECT_GE(report->smallest_gap, options.padding);
    EXPECT_LT(report->smallest_gap, report->gap_reach);
  }
}

}  // namespace
}  // namespace wrapatlas
