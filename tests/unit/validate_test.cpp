#include "unit/validate_helpers.h"

namespace wrapatlas {
namespace {

TEST(Validate, NothingIsFine) {
  const CheckReport report = check({}, options_of());
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.charts, 0U);
  EXPECT_EQ(report.efficiency, 0);
  const Mesh empty;
  EXPECT_TRUE(check(empty, options_of(Wrap::uv, 2), &empty).ok());
}

TEST(Validate, CountsAndMeasures) {
  Builder b;
  b.box(0, 0, 32, 32);
  b.box(40, 0, 8, 16);
  b.box(0, 0, 1, 1);
  for (std::uint32_t c = 8; c < 12; ++c) b.mesh.corner_texcoord[c] = kNone;
  const CheckReport report = check(b.mesh, options_of());
  EXPECT_EQ(report.charts, 2U);
  EXPECT_EQ(report.faces, 3U);
  EXPECT_EQ(report.faces_without_uv, 1U);
  EXPECT_DOUBLE_EQ(report.efficiency, (1024.0 + 128.0) / 4096.0);
  EXPECT_EQ(report.scale, 0);
}

TEST(Validate, TouchingIsNoOverlap) {
  Builder b;
  b.box(0, 0, 10, 10);
  b.box(10, 0, 10, 10);
  b.box(5, 10, 10, 10);
  const CheckReport report = check(b.mesh, options_of());
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.smallest_gap, 0);
}

TEST(Validate, OverlapIsFoundFromATinyDepthOn) {
  for (const double depth : {1e-7, 0.01}) {
    Builder b;
    b.box(0, 0, 10, 10);
    b.box(10 - depth, 3, 10, 2);
    const CheckReport report = check(b.mesh, options_of());
    ASSERT_EQ(report.violations, depth > 1e-3 ? 1U : 0U);
    if (report.ok()) continue;
    const Finding& finding = report.findings[0];
    EXPECT_EQ(finding.kind, Violation::overlap);
    EXPECT_EQ(finding.chart_a, 0U);
    EXPECT_EQ(finding.chart_b, 1U);
    EXPECT_NEAR(finding.amount, depth, 1e-9);
    EXPECT_NE(finding.text.find("charts 0 and 1"), std::string::npos) << finding.text;
    EXPECT_NE(finding.text.find("(9.99"), std::string::npos) << finding.text;
  }
}

TEST(Validate, ChartInsideAnotherOverlaps) {
  Builder b;
  b.box(0, 0, 60, 60);
  b.box(30, 20, 1, 1);
  EXPECT_EQ(kinds(check(b.mesh, options_of())), Kinds{Violation::overlap});
}

TEST(Validate, OnePairIsOneViolation) {
  Builder b;
  b.face({{0, 0}, {20, 0}, {30, 10}, {20, 20}, {0, 20}});
  b.face({{10, 5}, {40, 5}, {50, 10}, {40, 15}, {10, 15}});
  const CheckReport report = check(b.mesh, options_of(Wrap::none, 2));
  EXPECT_EQ(kinds(report), Kinds{Violation::overlap});  // and not a gap besides
}

TEST(Validate, FloatRoundingOfATouchPasses) {
  Builder b;
  b.width = b.height = 8192;
  const double third = 8192.0 / 3;
  b.face({{0, 0}, {third, 7}, {1000, 5000}});
  b.face({{third, 7}, {5000, 5000}, {1000, 5000}});
  for (Vec2& uv : b.mesh.texcoords) {
    const volatile float u = static_cast<float>(uv.x), v = static_cast<float>(uv.y);
    uv = {u, v};
  }
  // The neighbour is off by the last bit of a float.
  b.mesh.texcoords[3].x = std::nextafter(static_cast<float>(b.mesh.texcoords[3].x), 0.0F);
  CheckOptions options = options_of();
  options.width = options.height = 8192;
  EXPECT_TRUE(check(b.mesh, options).ok());
  b.mesh.texcoords[3].x = static_cast<float>(b.mesh.texcoords[3].x - 0.05 / 8192);
  EXPECT_EQ(kinds(check(b.mesh, options)), Kinds{Violation::overlap});
}

TEST(Validate, LargeUvsDoNotBuyTolerance) {
  Builder b;
  b.box(64 * 1000, 0, 10, 10);
  b.box(64 * 1000 + 9.75, 0, 10, 10);
  EXPECT_EQ(kinds(check(b.mesh, options_of(Wrap::uv))), Kinds{Violation::overlap});
}

TEST(Validate, GapIsEuclidean) {
  Builder b;
  b.box(0, 0, 10, 10);
  b.face({{13, 14}, {20, 14}, {20, 20}});  // 3, 4, 5
  EXPECT_TRUE(check(b.mesh, options_of(Wrap::none, 5)).ok());
  const CheckReport report = check(b.mesh, options_of(Wrap::none, 5.001));
  ASSERT_EQ(kinds(report), Kinds{Violation::gap});
  EXPECT_DOUBLE_EQ(report.findings[0].amount, 5);
  EXPECT_DOUBLE_EQ(report.smallest_gap, 5);
}

TEST(Validate, DegenerateTrianglesAreSegmentsAndPoints) {
  Builder b;
  b.box(0, 0, 10, 10);
  b.face({{2, 2}, {5, 5}, {8, 8}});        // a segment inside: no interior, but no distance either
  b.face({{12, 3}, {12, 3}, {12, 3}});     // a point
  b.face({{20, 0}, {30, 10}, {25, 5}});    // a segment ...
  b.face({{20, 10}, {30, 0}, {25, 5}});    // ... and one across it
  b.face({{32, 12}, {40, 20}, {36, 16}});  // ... and one in line with the first
  EXPECT_TRUE(check(b.mesh, options_of(Wrap::none, 0)).ok());
  const CheckReport report = check(b.mesh, options_of(Wrap::none, 1.9));
  ASSERT_EQ(kinds(report), (Kinds{Violation::gap, Violation::gap}));
  EXPECT_EQ(report.findings[0].chart_b, 1U);
  EXPECT_EQ(report.findings[1].chart_a, 3U);
  EXPECT_EQ(report.findings[1].chart_b, 4U);
  EXPECT_EQ(check(b.mesh, options_of(Wrap::none, 2.1)).violations, 3U);
  EXPECT_EQ(check(b.mesh, options_of(Wrap::none, 2.9)).violations, 4U);
}

TEST(Validate, OverlapAcrossTheBorder) {
  Builder b;
  b.box(60, 10, 10, 10);  // reaches 6 texels in from the left
  b.box(5, 12, 10, 2);
  const CheckReport on_torus = check(b.mesh, options_of(Wrap::u));
  ASSERT_EQ(kinds(on_torus), Kinds{Violation::overlap});
  EXPECT_NEAR(on_torus.findings[0].amount, 1, 1e-9);
  EXPECT_NE(on_torus.findings[0].text.find("across the border"), std::string::npos);
  EXPECT_EQ(kinds(check(b.mesh, options_of(Wrap::v))), Kinds{Violation::bounds});
  const Mesh apart = moved(b.mesh, [](std::uint32_t f, Vec2 p) {
    return f == 1 ? p + Vec2{1, 0} : p;
  });
  EXPECT_TRUE(check(apart, options_of(Wrap::u)).ok());
  EXPECT_EQ(kinds(check(apart, options_of(Wrap::u, 0.5))), Kinds{Violation::gap});
}

TEST(Validate, OverlapAcrossTheCornerOfTheTorus) {
  Builder b;
  b.box(60, 60, 6, 6);
  b.box(1, 1, 3, 3);
  EXPECT_EQ(kinds(check(b.mesh, options_of(Wrap::uv))), Kinds{Violation::overlap});
}

TEST(Validate, ChartAndItsOwnImage) {
  Builder b;
  b.face({{10, 10}, {75, 30}, {10, 14}});
  const CheckReport report = check(b.mesh, options_of(Wrap::uv));
  EXPECT_TRUE(report.ok());  // longer than the domain, but past itself
  Builder wide;
  wide.box(0, 0, 65, 10);
  const CheckReport own = check(wide.mesh, options_of(Wrap::uv));
  ASSERT_EQ(kinds(own), Kinds{Violation::self_overlap});
  EXPECT_NEAR(own.findings[0].amount, 1, 1e-9);
  Builder full;
  full.box(0, 0, 64, 10);
  EXPECT_TRUE(check(full.mesh, options_of(Wrap::u)).ok());
  EXPECT_EQ(kinds(check(full.mesh, options_of(Wrap::u, 0.1))), Kinds{Violation::gap});
  Builder nearly;
  nearly.box(0, 0, 62, 10);
  EXPECT_TRUE(check(nearly.mesh, options_of(Wrap::uv, 2)).ok());
  EXPECT_EQ(kinds(check(nearly.mesh, options_of(Wrap::uv, 2.01))), Kinds{Violation::gap});
}

TEST(Validate, ChartThatWindsAroundSeveralTimes) {
  const auto strip = [](double rise) {
    Builder b;  // a band that climbs `rise` texels a turn, 5 texels high, in 4 turns
    for (int i = 0; i < 16; ++i) {
      const double x = 16.0 * i, y = rise * i / 4, x1 = x + 16, y1 = rise * (i + 1) / 4;
      b.face({{x, y}, {x1, y1}, {x1, y1 + 5}, {x, y + 5}},
             {{x, y, 0}, {x1, y1, 0}, {x1, y1 + 5, 0}, {x, y + 5, 0}});
    }
    return b.mesh;
  };
  EXPECT_EQ(check(strip(5.5), options_of(Wrap::uv)).charts, 1U);
  EXPECT_TRUE(check(strip(5.5), options_of(Wrap::uv)).ok());
  EXPECT_EQ(kinds(check(strip(4.5), options_of(Wrap::uv))), Kinds{Violation::self_overlap});
  EXPECT_EQ(kinds(check(strip(5.5), options_of(Wrap::uv, 1))), Kinds{Violation::gap});
}

TEST(Validate, BoundsAndMargin) {
  for (const double x : {-0.001, 0.0, 1.9, 2.0}) {
    Builder b;
    b.box(x, 20, 10, 10);
    CheckOptions options = options_of();
    options.margin = 2;
    const Kinds expected = x < 0      ? Kinds{Violation::bounds}
                           : x < 1.95 ? Kinds{Violation::margin}
                                      : Kinds{};
    EXPECT_EQ(kinds(check(b.mesh, options)), expected);
    EXPECT_TRUE(check(b.mesh, options_of(Wrap::u)).ok());
    options.wrap = Wrap::v;
    EXPECT_EQ(kinds(check(b.mesh, options)), expected);
  }
  Builder far;
  far.box(1e25, 20, 1e24, 10);
  EXPECT_EQ(kinds(check(far.mesh, options_of())), Kinds{Violation::bounds});
}

TEST(Validate, FoldIsARemark) {
  Builder b;
  b.face({{0, 0}, {10, 0}, {10, 10}}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  b.face({{0, 0}, {10, 10}, {8, 1}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const CheckReport report = check(b.mesh, options_of(Wrap::uv, 1));
  EXPECT_EQ(report.charts, 1U);
  EXPECT_TRUE(report.ok());
  ASSERT_EQ(report.remarks.size(), 1U);
  EXPECT_NE(report.remarks[0].find("chart 0 overlaps itself"), std::string::npos);
  b.mesh.texcoords[5] = {1.0 / 64, 8.0 / 64};
  EXPECT_TRUE(check(b.mesh, options_of(Wrap::uv, 1)).remarks.empty());
}

TEST(Validate, CrowdsOfOneGroupBesideOthers) {
  // A fan of long slivers that no box can part, its rim near two other charts.
  Builder b;
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.01 * i, u = 0.01 * (i + 1);
    b.face({{0, 0}, {50, t}, {50, u}}, {{0, 0, 0}, {1, t, 0}, {1, u, 0}});
  }
  b.box(51, 5, 2, 2);
  b.box(51.5, 20, 2, 2);
  const CheckReport report = check(b.mesh, options_of(Wrap::uv, 1.2));
  EXPECT_EQ(report.charts, 3U);
  ASSERT_EQ(kinds(report), Kinds{Violation::gap});
  EXPECT_EQ(report.findings[0].chart_b, 1U);
  EXPECT_NEAR(report.smallest_gap, 1, 1e-9);
  EXPECT_TRUE(check(b.mesh, options_of(Wrap::uv, 1)).ok());
}

TEST(Validate, BadInputIsAnError) {
  Mesh mesh = two_charts();
  mesh.texcoords[2].x = std::nan("");
  const auto report = check_atlas(mesh, nullptr, options_of());
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, ErrorKind::input);
  EXPECT_EQ(report.error().where.substr(0, 5), "atlas");
  const Mesh good = two_charts();
  const auto bad_reference = check_atlas(good, &mesh, options_of());
  ASSERT_FALSE(bad_reference);
  EXPECT_EQ(bad_reference.error().where.substr(0, 9), "reference");
  mesh.texcoords[2].x = 1e29;  // spans more repeats than can be listed
  EXPECT_FALSE(check_atlas(mesh, nullptr, options_of(Wrap::uv)));
  for (const double padding : {-1.0, 64.0, std::nan("")}) {
    const auto refused = check_atlas(good, nullptr, options_of(Wrap::uv, padding));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
  }
  CheckOptions flat = options_of();
  flat.width = 0;
  EXPECT_FALSE(check_atlas(good, nullptr, flat));
}

TEST(Validate, FindingsAreLimitedNotCounted) {
  Builder b;
  for (int i = 0; i < 8; ++i) b.box(1.0 * i, 0, 20, 20);
  CheckOptions options = options_of();
  options.max_findings = 3;
  const CheckReport report = check(b.mesh, options);
  EXPECT_EQ(report.violations, 28U);
  EXPECT_EQ(report.findings.size(), 3U);
}

}  // namespace
}  // namespace wrapatlas
