// Charts that no one means to make: the same triangle many times, sizes far apart.
#include <gtest/gtest.h>

#include "support/soup_check.h"
#include "uv_mesh.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/model.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
const std::vector<Vec2> kPoints{{0, 0}, {2, 0}, {0, 1}, {2, 2}};

TEST(RepeatedTriangles, CountOnceInTheArea) {
  for (const std::uint32_t copies : {1U, 2U, 7U}) {
    Triangles triangles;
    for (std::uint32_t i = 0; i < copies; ++i) {
      triangles.push_back({i % 3, (i + 1) % 3, (i + 2) % 3});  // wherever it begins
    }
    triangles.push_back({1, 3, 2});
    const Chart chart = chart_from_triangles(kPoints, triangles);
    EXPECT_EQ(chart.triangles.size(), copies + 1) << "none is lost";
    EXPECT_DOUBLE_EQ(chart.area, 3);
    EXPECT_NEAR(chart.overlap, copies - 1.0, 1e-12);
    EXPECT_TRUE(chart.against_grain.empty());
    EXPECT_EQ(test::winding_at(chart, {0.5, 0.25}), static_cast<int>(copies));
    EXPECT_EQ(test::winding_at(chart, {1.75, 1.5}), 1);
    EXPECT_EQ(test::winding_at(chart, {0.1, 1.5}), 0);
  }
}

TEST(RepeatedTriangles, CoverWhicheverWayTheyWind) {
  for (const Triangles& triangles :
       {Triangles{{0, 1, 2}, {0, 2, 1}}, Triangles{{0, 2, 1}, {0, 1, 2}, {2, 1, 0}}}) {
    const Chart chart = chart_from_triangles(kPoints, triangles);
    EXPECT_DOUBLE_EQ(chart.area, 1);
    EXPECT_NEAR(chart.overlap, static_cast<double>(triangles.size()) - 1, 1e-12);
    EXPECT_EQ(chart.against_grain.size(), 1U);
    EXPECT_NE(test::winding_at(chart, {0.5, 0.25}), 0);
  }
}

TEST(RepeatedTriangles, WithoutArea) {
  const Chart chart = chart_from_triangles(kPoints, {{0, 1, 1}, {0, 1, 1}, {2, 2, 2}});
  EXPECT_EQ(chart.area, 0);
  EXPECT_EQ(chart.overlap, 0);
  EXPECT_EQ(chart.against_grain.size(), 3U);
}

TEST(RepeatedTriangles, ArePackedLikeOne) {
  PackOptions options;
  options.width = options.height = 128;
  options.threads = 1;
  options.time = 0;  // so that both searches are the same
  const std::vector<Chart> once(3, chart_from_triangles(kPoints, {{0, 1, 2}})),
      often(3, chart_from_triangles(kPoints, {{0, 1, 2}, {1, 2, 0}, {0, 1, 2}}));
  const auto a = pack(once, options), b = pack(often, options);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->scale, b->scale);
  EXPECT_EQ(test::check_packing(often, *b, options), "");
}

/// One right-angled triangle of each size, at the origin of the UVs, each on its own in space.
Mesh triangles_of(const std::vector<Vec2>& sizes) {
  test::MeshBuilder b;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto z = static_cast<double>(i);
    b.face({{b.position({0, 0, z}), b.texcoord({0, 0})},
            {b.position({1, 0, z}), b.texcoord({sizes[i].x, 0})},
            {b.position({0, 1, z}), b.texcoord({0, sizes[i].y})}});
  }
  return b.mesh;
}

class ExtremeSizes : public ::testing::TestWithParam<std::pair<Method, RotationBase>> {
 protected:
  static PackOptions options() {
    PackOptions options;
    options.method = GetParam().first;
    options.rotation_base = GetParam().second;
    const bool can_wrap = options.method == Method::modulo || options.method == Method::guided;
    options.wrap = can_wrap ? Wrap::uv : Wrap::none;
    options.time = 0;
    options.width = options.height = 256;
    options.grid = 64;
    options.threads = 1;
    return options;
  }
};

TEST_P(ExtremeSizes, TinyBesideHugePassesTheCheck) {
  for (const std::vector<Vec2>& sizes :
       {std::vector<Vec2>{{1e29, 1e29}, {1e-15, 1e-15}},
        {{1e-22, 1e-22}, {1e22, 2e22}, {1e-22, 3e-22}, {1e22, 1e22}},
        {{1e-50, 1e-50}, {1e-60, 2e-60}},
        {{9e29, 9e29}, {9e29, 9e29}, {0, 0}}}) {
    const Mesh mesh = triangles_of(sizes);
    const auto charts = build_charts(mesh);
    ASSERT_TRUE(charts) << charts.error().message();
    const auto packing = pack(charts->charts, options());
    ASSERT_TRUE(packing) << packing.error().message();
    CheckOptions check;
    check.width = check.height = 256;
    check.wrap = packing->wrap;
    check.padding = options().padding;
    const Mesh atlas = apply_atlas(mesh, export_continuous(mesh, *charts, *packing));
    const auto report = check_atlas(atlas, &mesh, check);
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_TRUE(report->ok()) << report->findings[0].text;
    EXPECT_EQ(report->charts, sizes.size());
  }
}

TEST_P(ExtremeSizes, WhatCannotFitIsAnError) {
  struct Case {
    std::vector<Vec2> sizes;
    ErrorKind kind;
  };
  // A needle or a line so long that at any scale at which it fits nothing else is seen; and areas
  // that no number holds.
  for (const Case& c : {Case{{{1e22, 1e-22}, {1e-22, 1e-22}}, ErrorKind::no_packing},
                        Case{{{1e22, 0}, {1e-22, 1e-22}}, ErrorKind::no_packing},
                        Case{{{1e-180, 1e-180}}, ErrorKind::input}}) {
    const auto charts = build_charts(triangles_of(c.sizes));
    ASSERT_TRUE(charts);
    const auto packing = pack(charts->charts, options());
    ASSERT_FALSE(packing);
    EXPECT_EQ(packing.error().kind, c.kind) << packing.error().message();
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, ExtremeSizes,
                         ::testing::Values(std::pair{Method::guided, RotationBase::input},
                                           std::pair{Method::modulo, RotationBase::input},
                                           std::pair{Method::modulo, RotationBase::box},
                                           std::pair{Method::swg03, RotationBase::input},
                                           std::pair{Method::zsgs04, RotationBase::box},
                                           std::pair{Method::lprm02, RotationBase::input}));

}  // namespace
}  // namespace wrapatlas
