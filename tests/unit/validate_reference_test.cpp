// Atlases judged against the mesh that they were made from.
#include "unit/validate_helpers.h"

namespace wrapatlas {
namespace {

TEST(ValidateReference, SimilarCopyPasses) {
  const Similarity s = Similarity::from(1.3, 0.7, {15, 3});
  const Similarity t = Similarity::from(1.3, -2.1, {100, 100});
  const Mesh reference = two_charts();
  const Mesh atlas =
      moved(reference, [&](std::uint32_t f, Vec2 p) { return (f == 0 ? s : t).apply(p); });
  const CheckReport report = check(atlas, options_of(Wrap::uv), &reference);
  EXPECT_TRUE(report.ok()) << (report.findings.empty() ? "" : report.findings[0].text);
  EXPECT_NEAR(report.scale, 1.3 * 64, 1e-6);
}

TEST(ValidateReference, NotSimilarFromTheToleranceOn) {
  const Mesh reference = two_charts();
  for (const double off : {0.0005, 0.02}) {
    Mesh atlas = reference;
    atlas.texcoords[4].x += off / 64;
    const Kinds found = kinds(check(atlas, options_of(), &reference));
    EXPECT_EQ(found, off > 0.01 ? Kinds{Violation::not_similar} : Kinds{});
  }
}

TEST(ValidateReference, MirroredChart) {
  const Mesh reference = two_charts();
  const Mesh atlas = moved(reference, [](std::uint32_t f, Vec2 p) {
    return f == 1 ? Vec2{60 - p.y, 60 - p.x} : p;
  });
  const CheckReport report = check(atlas, options_of(), &reference);
  ASSERT_EQ(kinds(report), Kinds{Violation::mirrored});
  EXPECT_EQ(report.findings[0].chart_a, 1U);
}

TEST(ValidateReference, TipThatJustCrossesTheBorder) {
  const double e = 1e-4;  // texels: an area below the rounding of positions
  const auto in_space = [](const std::vector<Vec2>& points) {
    std::vector<Vec3> positions;
    for (const Vec2 p : points) positions.push_back({p.x / 64, p.y / 64, 0});
    return positions;
  };
  const std::vector<Vec2> flat_uvs{{30, 40}, {35, 40}, {40, 40}};
  const std::vector<Vec3> flat = in_space({{5, 0}, {10, 0}, {20, 0}});  // on an edge of the first
  const std::vector<Vec2> square{{30, 10}, {50, 10}, {50, 30}, {30, 30}};
  for (const int flat_faces : {0, 1, 2}) {
    Builder reference, atlas;
    reference.face({{0, 0}, {20, 0}, {5, 10}}, in_space({{0, 0}, {20, 0}, {5, 10}}));
    atlas.face({{0, 0}, {20 - e, 0}, {5 - e, 10}, {0, 2 * e}},
               in_space({{e, 0}, {20, 0}, {5, 10}, {e, 2 * e}}));
    atlas.face({{64 - e, 0}, {64, 0}, {64, 2 * e}}, in_space({{0, 0}, {e, 0}, {e, 2 * e}}));
    for (Builder* b : {&reference, &atlas}) {
      for (int i = 0; i < flat_faces; ++i) b->face(flat_uvs, flat);
      b->face(square, in_space(square));
    }
    const CheckReport report = check(atlas.mesh, options_of(Wrap::u), &reference.mesh);
    EXPECT_TRUE(report.ok()) << (report.findings.empty() ? "" : report.findings[0].text);
    EXPECT_EQ(report.faces, atlas.mesh.face_count());
  }
}

TEST(ValidateReference, TinyAndFlatChartsAreNoMirrors) {
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

TEST(ValidateReference, OneCommonScale) {
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

TEST(ValidateReference, MissingFaces) {
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

TEST(ValidateReference, AnotherMeshIsNoReference) {
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

TEST(ValidateReference, CutAtlasIsPutTogetherAgain) {
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

TEST(ValidateReference, PiecesOfACutChartMustNotOverlap) {
  Builder b;  // 70 texels wide: the second piece reaches over the first
  b.face({{0, 0}, {70, 0}, {70, 10}, {0, 10}}, {{0, 0, 0}, {7, 0, 0}, {7, 1, 0}, {0, 1, 0}});
  Builder cut;
  cut.face({{0, 0}, {64, 0}, {64, 10}, {0, 10}}, {{0, 0, 0}, {6.4, 0, 0}, {6.4, 1, 0}, {0, 1, 0}});
  cut.face({{0, 0}, {6, 0}, {6, 10}, {0, 10}}, {{6.4, 0, 0}, {7, 0, 0}, {7, 1, 0}, {6.4, 1, 0}});
  for (const Wrap wrap : {Wrap::none, Wrap::u, Wrap::uv}) {
    EXPECT_EQ(kinds(check(cut.mesh, options_of(wrap), &b.mesh)), Kinds{Violation::self_overlap});
  }
}

TEST(ValidateReference, TriangulatedFacesAndPointsOnEdges) {
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

TEST(ValidateReference, FaceWithoutAreaInSpaceIsCutByItsUvs) {
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

TEST(ValidateReference, StackedChartsMayStaySo) {
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

TEST(ValidateReference, PartsOfAStackMayGoTheirOwnWay) {
  // The second and third stay together, and across them the first one's way differs by a period.
  Builder b;
  b.box(0, 0, 4, 4);
  b.box(3, 3, 20, 4);
  b.box(20, 5, 12, 4);
  CheckOptions options = options_of(Wrap::uv, 1);
  options.stacked_ok = true;
  const auto parted = [&](double height) {
    return moved(b.mesh, [&](std::uint32_t f, Vec2 p) {
      return f == 0 ? Vec2{52 - p.y, 38 + p.x} : p + Vec2{0, height};
    });
  };
  for (int height = -64; height < 64; height += 4) {
    EXPECT_TRUE(check(parted(height), options, &b.mesh).ok()) << height;
  }
}

}  // namespace
}  // namespace wrapatlas
