#include "wrapatlas/validate.h"

#include <gtest/gtest.h>

#include <random>

namespace wrapatlas {
namespace {

/// A mesh in the making, in texels of a 64 x 64 atlas unless said otherwise.
struct Builder {
  Mesh mesh;
  double width = 64, height = 64;

  /// A face of its own in space, so that it is a chart of its own.
  void face(const std::vector<Vec2>& texels) {
    const auto depth = static_cast<double>(mesh.face_count());
    std::vector<Vec3> positions;
    for (const Vec2 p : texels) positions.push_back({p.x / 64, p.y / 64, depth});
    face(texels, positions);
  }
  void face(const std::vector<Vec2>& texels, const std::vector<Vec3>& positions) {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      mesh.corner_position.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.corner_texcoord.push_back(static_cast<std::uint32_t>(mesh.texcoords.size()));
      mesh.positions.push_back(positions[i]);
      mesh.texcoords.push_back({texels[i].x / width, texels[i].y / height});
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  void box(double x, double y, double w, double h) {
    face({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}});
  }
};

CheckOptions options_of(Wrap wrap = Wrap::none, double padding = 0) {
  CheckOptions options;
  options.width = options.height = 64;
  options.wrap = wrap;
  options.padding = padding;
  options.threads = 2;
  return options;
}

CheckReport check(const Mesh& atlas, const CheckOptions& options, const Mesh* reference = nullptr) {
  auto report = check_atlas(atlas, reference, options);
  EXPECT_TRUE(report) << (report ? "" : report.error().message());
  return report ? std::move(*report) : CheckReport{};
}

std::vector<Violation> kinds(const CheckReport& report) {
  std::vector<Violation> found;
  for (const Finding& finding : report.findings) found.push_back(finding.kind);
  EXPECT_EQ(found.size(), report.violations);
  return found;
}

using Kinds = std::vector<Violation>;

/// Moves the UVs of all corners by a function of texels.
template <typename Map>
Mesh moved(Mesh mesh, const Map& map) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      Vec2& uv = mesh.texcoords[mesh.corner_texcoord[c]];
      const Vec2 texel = map(f, Vec2{uv.x * 64, uv.y * 64});
      uv = {texel.x / 64, texel.y / 64};
    }
  }
  return mesh;
}

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
  for (Vec2& uv : b.mesh.texcoords) uv = {static_cast<float>(uv.x), static_cast<float>(uv.y)};
  b.mesh.texcoords[4].y = static_cast<float>(b.mesh.texcoords[4].y);
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

Mesh two_charts() {
  Builder b;
  b.face({{0, 0}, {20, 0}, {5, 10}});
  b.face({{30, 0}, {50, 5}, {35, 20}, {30, 20}});
  return b.mesh;
}

TEST(Validate, SimilarCopyPasses) {
  const Similarity s = Similarity::from(1.3, 0.7, {15, 3});
  const Similarity t = Similarity::from(1.3, -2.1, {100, 100});
  const Mesh reference = two_charts();
  const Mesh atlas =
      moved(reference, [&](std::uint32_t f, Vec2 p) { return (f == 0 ? s : t).apply(p); });
  const CheckReport report = check(atlas, options_of(Wrap::uv), &reference);
  EXPECT_TRUE(report.ok()) << (report.findings.empty() ? "" : report.findings[0].text);
  EXPECT_NEAR(report.scale, 1.3 * 64, 1e-6);
}

TEST(Validate, NotSimilarFromTheToleranceOn) {
  const Mesh reference = two_charts();
  for (const double off : {0.0005, 0.02}) {
    Mesh atlas = reference;
    atlas.texcoords[4].x += off / 64;
    const Kinds found = kinds(check(atlas, options_of(), &reference));
    EXPECT_EQ(found, off > 0.01 ? Kinds{Violation::not_similar} : Kinds{});
  }
}

TEST(Validate, MirroredChart) {
  const Mesh reference = two_charts();
  const Mesh atlas = moved(reference, [](std::uint32_t f, Vec2 p) {
    return f == 1 ? Vec2{60 - p.y, 60 - p.x} : p;
  });
  const CheckReport report = check(atlas, options_of(), &reference);
  ASSERT_EQ(kinds(report), Kinds{Violation::mirrored});
  EXPECT_EQ(report.findings[0].chart_a, 1U);
}

TEST(Validate, TinyAndFlatChartsAreNoMirrors) {
  Builder b;
  b.box(0, 0, 30, 30);
  b.face({{40, 0}, {45, 5}, {50, 10}});              // flat: its mirror image is itself
  b.face({{40, 20}, {40.0001, 20}, {40, 20.0001}});  // too small to tell
  b.face({{50, 50}, {50, 50}, {50, 50}});
  const Mesh atlas = moved(b.mesh, [](std::uint32_t f, Vec2 p) {
    return f == 2 ? Vec2{100 - p.x, p.y} : p;
  });
  const CheckReport report = check(atlas, options_of(), &b.mesh);
  EXPECT_TRUE(report.ok()) << report.findings[0].text;
}

TEST(Validate, OneCommonScale) {
  const Mesh reference = two_charts();
  for (const double factor : {1 + 2e-6, 1.0002}) {
    const Mesh atlas =
        moved(reference, [&](std::uint32_t f, Vec2 p) { return f == 0 ? factor * p : p; });
    const CheckReport report = check(atlas, options_of(), &reference);
    ASSERT_EQ(kinds(report), factor > 1.0001 ? Kinds{Violation::scale} : Kinds{});
    if (report.ok()) continue;
    EXPECT_NEAR(report.findings[0].amount, factor, 1e-6);
    EXPECT_EQ(report.findings[0].chart_a, 0U);
  }
}

TEST(Validate, MissingFaces) {
  const Mesh reference = two_charts();
  Mesh without_uv = reference;
  without_uv.corner_texcoord[1] = kNone;
  EXPECT_EQ(kinds(check(without_uv, options_of(), &reference)), Kinds{Violation::missing_face});
  Mesh shorter = reference;
  shorter.face_begin.pop_back();
  shorter.corner_position.resize(3);
  shorter.corner_texcoord.resize(3);
  EXPECT_EQ(kinds(check(shorter, options_of(), &reference)), Kinds{Violation::missing_face});
  EXPECT_EQ(kinds(check({}, options_of(), &reference)),
            (Kinds{Violation::missing_face, Violation::missing_face}));
  const auto longer = check_atlas(reference, &shorter, options_of());
  ASSERT_FALSE(longer);
  EXPECT_EQ(longer.error().kind, ErrorKind::input);
}

TEST(Validate, AnotherMeshIsNoReference) {
  const Mesh atlas = two_charts();
  Mesh reference = atlas;
  for (Vec3& p : reference.positions) p = p + Vec3{0.5, 0, 0};
  EXPECT_FALSE(check_atlas(atlas, &reference, options_of()));
}

/// Two rectangles of one chart beside each other; the first crosses u = 64 when moved by 40.
Mesh cut_reference() {
  Builder b;
  b.face({{0, 0}, {40, 0}, {40, 10}, {0, 10}}, {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}});
  b.face({{0, 10}, {40, 10}, {40, 20}, {0, 20}}, {{0, 1, 0}, {4, 1, 0}, {4, 2, 0}, {0, 2, 0}});
  return b.mesh;
}

/// The chart at x = 40, cut at x = 64 (24 texels in: 2.4 units of 4).
Mesh cut_atlas(double tear = 0) {
  Builder b;
  b.face({{40, 0}, {64, 0}, {64, 10}, {40, 10}}, {{0, 0, 0}, {2.4, 0, 0}, {2.4, 1, 0}, {0, 1, 0}});
  b.face({{0, 0}, {16, 0}, {16, 10}, {0, 10}}, {{2.4, 0, 0}, {4, 0, 0}, {4, 1, 0}, {2.4, 1, 0}});
  b.face({{40, 10}, {64, 10}, {64, 20}, {40, 20}},
         {{0, 1, 0}, {2.4, 1, 0}, {2.4, 2, 0}, {0, 2, 0}});
  b.face({{tear, 10}, {16, 10}, {16, 20}, {0, 20}},
         {{2.4, 1, 0}, {4, 1, 0}, {4, 2, 0}, {2.4, 2, 0}});
  return b.mesh;
}

TEST(Validate, CutAtlasIsPutTogetherAgain) {
  const Mesh reference = cut_reference();
  for (const Wrap wrap : {Wrap::none, Wrap::u, Wrap::uv}) {
    const CheckReport report = check(cut_atlas(), options_of(wrap, 20), &reference);
    EXPECT_TRUE(report.ok()) << report.findings[0].text;
    EXPECT_EQ(report.charts, 1U);
    EXPECT_NEAR(report.scale, 64, 1e-5);
  }
  // 64 - 40 = 24 texels lie between the chart and its own image.
  EXPECT_EQ(kinds(check(cut_atlas(), options_of(Wrap::u, 24.01), &reference)),
            Kinds{Violation::gap});
  EXPECT_EQ(kinds(check(cut_atlas(3), options_of(Wrap::u, 1), &reference)),
            Kinds{Violation::not_similar});
}

TEST(Validate, PiecesOfACutChartMustNotOverlap) {
  Builder b;  // 70 texels wide: the second piece reaches over the first
  b.face({{0, 0}, {70, 0}, {70, 10}, {0, 10}}, {{0, 0, 0}, {7, 0, 0}, {7, 1, 0}, {0, 1, 0}});
  Builder cut;
  cut.face({{0, 0}, {64, 0}, {64, 10}, {0, 10}}, {{0, 0, 0}, {6.4, 0, 0}, {6.4, 1, 0}, {0, 1, 0}});
  cut.face({{0, 0}, {6, 0}, {6, 10}, {0, 10}}, {{6.4, 0, 0}, {7, 0, 0}, {7, 1, 0}, {6.4, 1, 0}});
  for (const Wrap wrap : {Wrap::none, Wrap::u, Wrap::uv}) {
    EXPECT_EQ(kinds(check(cut.mesh, options_of(wrap), &b.mesh)), Kinds{Violation::self_overlap});
  }
}

TEST(Validate, TriangulatedFacesAndPointsOnEdges) {
  const Mesh reference = cut_reference();
  Builder b;  // the first face with one more corner on its edge, the second as two triangles
  b.face({{0, 0}, {40, 0}, {40, 10}, {30, 10}, {0, 10}},
         {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3, 1, 0}, {0, 1, 0}});
  b.face({{0, 10}, {40, 10}, {40, 20}}, {{0, 1, 0}, {4, 1, 0}, {4, 2, 0}});
  b.face({{0, 10}, {40, 20}, {0, 20}}, {{0, 1, 0}, {4, 2, 0}, {0, 2, 0}});
  EXPECT_TRUE(check(b.mesh, options_of(Wrap::none, 1), &reference).ok());
  Mesh half = b.mesh;  // without the last triangle its face is not whole
  half.face_begin.pop_back();
  half.corner_position.resize(8);
  half.corner_texcoord.resize(8);
  EXPECT_FALSE(check_atlas(half, &reference, options_of()));
}

TEST(Validate, FaceWithoutAreaInSpaceIsCutByItsUvs) {
  Builder b;
  b.face({{0, 0}, {40, 0}, {0, 20}}, {{0, 0, 0}, {4, 0, 0}, {2, 0, 0}});
  b.box(0, 30, 10, 10);
  Builder cut;
  cut.face({{0, 0}, {20, 0}, {0, 20}}, {{0, 0, 0}, {2, 0, 0}, {2, 0, 0}});
  cut.face({{20, 0}, {40, 0}, {0, 20}}, {{2, 0, 0}, {4, 0, 0}, {2, 0, 0}});
  const auto depth = Vec3{0, 0, 1};
  cut.face({{0, 30}, {10, 30}, {10, 40}, {0, 40}},
           {Vec3{0, 30.0 / 64, 0} + depth, Vec3{10.0 / 64, 30.0 / 64, 0} + depth,
            Vec3{10.0 / 64, 40.0 / 64, 0} + depth, Vec3{0, 40.0 / 64, 0} + depth});
  const CheckReport report = check(cut.mesh, options_of(Wrap::none, 1), &b.mesh);
  EXPECT_TRUE(report.ok()) << report.findings[0].text;
}

TEST(Validate, StackedChartsMayStaySo) {
  Builder b;
  b.box(0, 0, 10, 10);
  b.box(5, 5, 10, 10);
  b.box(15.5, 0, 5, 5);  // near the stack, but no part of it
  CheckOptions options = options_of(Wrap::uv);
  EXPECT_EQ(kinds(check(b.mesh, options, &b.mesh)), Kinds{Violation::overlap});
  options.stacked_ok = true;
  EXPECT_TRUE(check(b.mesh, options, &b.mesh).ok());
  options.padding = 1;
  EXPECT_EQ(kinds(check(b.mesh, options, &b.mesh)), Kinds{Violation::gap});
  options.padding = 0;
  const Mesh onto = moved(b.mesh, [](std::uint32_t f, Vec2 p) {
    return f == 2 ? p + Vec2{-2, 2} : p;
  });
  EXPECT_EQ(kinds(check(onto, options, &b.mesh)), Kinds{Violation::overlap});
  const Mesh far = moved(b.mesh, [](std::uint32_t f, Vec2 p) {
    return f == 1 ? p + Vec2{-64, 128} : p;  // the same place on the torus
  });
  EXPECT_TRUE(check(far, options, &b.mesh).ok());
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
