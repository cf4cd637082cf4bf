// From meshes to chart sets.
#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "charts/stacked.h"
#include "uv_mesh.h"
#include "wrapatlas/charts.h"

namespace wrapatlas {
namespace {

using test::MeshBuilder;

ChartSet charts_of(const Mesh& mesh, Stacked stacked = Stacked::separate) {
  EXPECT_TRUE(validate_mesh(mesh));
  Result<ChartSet> set = build_charts(mesh, stacked);
  EXPECT_TRUE(set);
  return set ? *std::move(set) : ChartSet{};
}

/// Every corner's chart point has the corner's UV, and points come in order of first use.
void expect_consistent(const Mesh& mesh, const ChartSet& set) {
  ASSERT_EQ(set.face_chart.size(), mesh.face_count());
  ASSERT_EQ(set.corner_point.size(), mesh.corner_count());
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      if (set.face_chart[face] == kNone) {
        EXPECT_EQ(set.corner_point[c], kNone);
        continue;
      }
      const Chart& chart = set.charts.at(set.face_chart[face]);
      EXPECT_EQ(chart.points.at(set.corner_point[c]), mesh.texcoords[mesh.corner_texcoord[c]]);
    }
  }
}

TEST(BuildCharts, JoinsAcrossRepeatedVertices) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {1, 0}, {1, 1}});
  b.flat_face({{0, -0.0}, {1, 1}, {0, 1}});
  b.flat_face({{5, 5}, {6, 5}, {5, 6}});
  const ChartSet set = charts_of(b.mesh);
  ASSERT_EQ(set.charts.size(), 2U);
  EXPECT_EQ(set.face_chart, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(set.corner_point, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2}));
  EXPECT_DOUBLE_EQ(set.total_area(), 1.5);
  expect_consistent(b.mesh, set);
}

TEST(BuildCharts, ObjectsStayApartAtOnePlace) {
  MeshBuilder b;
  for (int copy = 0; copy < 3; ++copy) {
    b.flat_face({{0, 0}, {1, 0}, {1, 1}});
    b.flat_face({{0, 0}, {1, 1}, {0, 1}});
  }
  EXPECT_EQ(charts_of(b.mesh).charts.size(), 1U) << "nothing tells the copies apart";
  b.mesh.face_object = {7, 7, 0, 0, 7, kNone};
  const ChartSet set = charts_of(b.mesh);
  EXPECT_EQ(set.face_chart, (std::vector<std::uint32_t>{0, 0, 1, 1, 0, 2}));
  EXPECT_EQ(set.stacked, 3U);
  expect_consistent(b.mesh, set);
  const ChartSet kept = charts_of(b.mesh, Stacked::keep);
  EXPECT_EQ(kept.face_chart, (std::vector<std::uint32_t>{0, 0, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(kept.total_area(), 1);
}

TEST(BuildCharts, FacesThatAreThereTwiceAreAllKept) {
  MeshBuilder b;
  for (int copy = 0; copy < 3; ++copy) b.flat_face({{0, 0}, {1, 0}, {1, 1}});
  const ChartSet set = charts_of(b.mesh);
  ASSERT_EQ(set.charts.size(), 1U);
  EXPECT_EQ(set.charts[0].triangles.size(), 3U);
  EXPECT_EQ(set.charts[0].points.size(), 3U);
  EXPECT_DOUBLE_EQ(set.charts[0].area, 0.5);
  EXPECT_DOUBLE_EQ(set.charts[0].overlap, 1);
  expect_consistent(b.mesh, set);
}

TEST(Mesh, ObjectsOfSomeFacesAlone) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {1, 0}, {1, 1}});
  b.flat_face({{0, 0}, {1, 1}, {0, 1}});
  b.mesh.face_object = {0};
  EXPECT_FALSE(validate_mesh(b.mesh));
  b.mesh.face_object = {0, 1};
  EXPECT_TRUE(validate_mesh(b.mesh));
}

TEST(Mesh, WeldedCornersAreOfOneObject) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {1, 0}, {1, 1}});
  b.flat_face({{-0.0, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(weld_corners(b.mesh).of_corner, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 5}));
  b.mesh.face_object = {3, 4};
  const WeldedCorners apart = weld_corners(b.mesh);
  EXPECT_EQ(apart.of_corner, (std::vector<std::uint32_t>{0, 1, 2, 6, 7, 5}));
  EXPECT_EQ(apart.count, 8U);
}

TEST(BuildCharts, SameUvAtOtherPositionsIsNoConnection) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {1, 0}, {1, 1}}, 0);
  b.flat_face({{0, 0}, {1, 1}, {0, 1}}, 7);
  const ChartSet set = charts_of(b.mesh);
  EXPECT_EQ(set.charts.size(), 2U);
  EXPECT_EQ(set.stacked, 0U);
}

TEST(BuildCharts, SamePositionsWithOtherUvsIsASeam) {
  MeshBuilder b;
  const auto p = b.position({0, 0, 0}), q = b.position({1, 0, 0}), r = b.position({0, 1, 0}),
             s = b.position({0, -1, 0});
  const auto pu = b.texcoord({0, 0}), qu = b.texcoord({1, 0}), ru = b.texcoord({0, 1});
  b.face({{p, pu}, {q, qu}, {r, ru}});
  b.face({{q, b.texcoord({3, 0})}, {p, pu}, {s, b.texcoord({0, -1})}});
  EXPECT_EQ(charts_of(b.mesh).charts.size(), 2U);
}

TEST(BuildCharts, OneCommonVertexDoesNotJoin) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {1, 0}, {1, 1}});
  b.flat_face({{0, 0}, {-1, 0}, {-1, -1}});
  EXPECT_EQ(charts_of(b.mesh).charts.size(), 2U);
}

TEST(BuildCharts, RepeatedCornerMakesNoEdge) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {0, 0}, {1, 1}});
  b.flat_face({{0, 0}, {0, 0}, {-1, 1}});
  const ChartSet set = charts_of(b.mesh);
  EXPECT_EQ(set.charts.size(), 2U);
  EXPECT_EQ(set.degenerate, 2U);
}

TEST(BuildCharts, NonConvexQuad) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {4, 0}, {1, 1}, {0, 4}});
  const ChartSet set = charts_of(b.mesh);
  EXPECT_DOUBLE_EQ(set.charts.at(0).area, 4);
  EXPECT_EQ(set.charts[0].triangles.size(), 2U);
  EXPECT_TRUE(set.charts[0].against_grain.empty());
}

TEST(BuildCharts, FacesWithoutUvs) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {1, 0}, {1, 1}});
  b.flat_face({{0, 0}, {1, 1}, {0, 1}});
  b.mesh.corner_texcoord[1] = kNone;
  const ChartSet set = charts_of(b.mesh);
  EXPECT_EQ(set.faces_without_uv, 1U);
  EXPECT_EQ(set.face_chart, (std::vector<std::uint32_t>{kNone, 0}));
  expect_consistent(b.mesh, set);

  for (auto& t : b.mesh.corner_texcoord) t = kNone;
  const auto none = build_charts(b.mesh);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::input);
}

TEST(BuildCharts, HundredsOfChartsInFaceOrder) {
  // Quads far apart, their two triangles in shuffled places of the face list.
  std::mt19937 random(3);
  const std::uint32_t count = 400;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < 2 * count; ++i) order.push_back(i);
  std::shuffle(order.begin(), order.end(), random);
  MeshBuilder b;
  for (const std::uint32_t i : order) {
    const std::uint32_t column = i / 2 % 20, row = i / 40;
    const double x = 3.0 * column, y = 3.0 * row;
    if (i % 2 == 0) b.flat_face({{x, y}, {x + 1, y}, {x + 1, y + 1}});
    if (i % 2 == 1) b.flat_face({{x, y}, {x + 1, y + 1}, {x, y + 1}});
  }
  const ChartSet set = charts_of(b.mesh);
  ASSERT_EQ(set.charts.size(), count);
  EXPECT_EQ(set.stacked, 0U);
  expect_consistent(b.mesh, set);
  std::uint32_t next = 0;
  for (std::size_t face = 0; face < order.size(); ++face) {
    ASSERT_LE(set.face_chart[face], next);
    if (set.face_chart[face] == next) ++next;
    for (std::size_t other = 0; other < face; ++other) {
      ASSERT_EQ(set.face_chart[face] == set.face_chart[other], order[face] / 2 == order[other] / 2);
    }
  }
}

TEST(Stacked, TouchingIsNotStacked) {
  MeshBuilder b;
  b.flat_face({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0);
  b.flat_face({{1, 0}, {2, 0}, {2, 1}, {1, 1}}, 1);
  b.flat_face({{0, 1 - 1e-9}, {1, 1 - 1e-9}, {0.5, 2}}, 2);
  EXPECT_EQ(charts_of(b.mesh).stacked, 0U);
  EXPECT_EQ(charts_of(b.mesh, Stacked::keep).charts.size(), 3U);
}

TEST(Stacked, SeamsThatRoundingMadeAreNotStacked) {
  // Thin strips, so that a seam is a large share of their area.
  const auto strips = [](double depth) {
    MeshBuilder b;
    b.flat_face({{0.5, 0.5}, {0.6, 0.5}, {0.6, 0.501}, {0.5, 0.501}}, 0);
    b.flat_face({{0.5, 0.501 - depth}, {0.6, 0.501 - depth}, {0.6, 0.502}, {0.5, 0.502}}, 1);
    return charts_of(b.mesh).stacked;
  };
  EXPECT_EQ(strips(1.2e-7), 0U);
  EXPECT_EQ(strips(1e-5), 2U);
}

TEST(Stacked, HolesAreNotCovered) {
  // A frame of four quads around a small square.
  MeshBuilder b;
  const std::vector<Vec2> o{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, i{{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  for (std::size_t k = 0; k < 4; ++k) b.flat_face({o[k], o[(k + 1) % 4], i[(k + 1) % 4], i[k]});
  b.flat_face({{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {1.5, 2.5}}, 1);
  EXPECT_EQ(charts_of(b.mesh).charts.size(), 2U);
  EXPECT_EQ(charts_of(b.mesh).stacked, 0U);
  b.flat_face({{0.25, 0.25}, {0.75, 0.25}, {0.5, 0.5}}, 2);
  EXPECT_EQ(charts_of(b.mesh).stacked, 2U);
}

TEST(Stacked, KeepMergesChains) {
  MeshBuilder b;
  b.flat_face({{9, 0}, {10, 0}, {9, 1}}, 0);
  b.flat_face({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 1);
  b.flat_face({{3, 2}, {3, 0}, {5, 0}, {5, 2}}, 2);
  b.flat_face({{1, 2}, {4, 2}, {4, 0}, {1, 0}}, 3);  // mirrored; lies on both of its neighbours
  const ChartSet apart = charts_of(b.mesh);
  EXPECT_EQ(apart.charts.size(), 4U);
  EXPECT_EQ(apart.stacked, 3U);
  const ChartSet set = charts_of(b.mesh, Stacked::keep);
  ASSERT_EQ(set.charts.size(), 2U);
  EXPECT_EQ(set.stacked, 3U);
  EXPECT_EQ(set.face_chart, (std::vector<std::uint32_t>{0, 1, 1, 1}));
  expect_consistent(b.mesh, set);
  EXPECT_DOUBLE_EQ(set.charts[1].area, 10);
  EXPECT_DOUBLE_EQ(set.charts[1].overlap, 4);
  EXPECT_EQ(set.charts[1].points.size(), 12U);
  std::mt19937 random(1);
  for (int k = 0; k < 500; ++k) {
    const Vec2 p = test::random_point(random, set.charts[1].box);
    EXPECT_EQ(test::triangles_over(set.charts[1], p) > 0, test::winding_at(set.charts[1], p) != 0);
  }
}

/// Area of the common part of two triangles, by cutting one along the sides of the other.
double common_area(std::vector<Vec2> polygon, std::vector<Vec2> cutter) {
  if (signed_area2(cutter[0], cutter[1], cutter[2]) < 0) std::swap(cutter[1], cutter[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = cutter[k], b = cutter[(k + 1) % 3];
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double dp = signed_area2(a, b, p), dq = signed_area2(a, b, q);
      if (dp >= 0) kept.push_back(p);
      if ((dp >= 0) != (dq >= 0)) kept.push_back(p + (dp / (dp - dq)) * (q - p));
    }
    polygon = kept;
  }
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    area += 0.5 * std::abs(signed_area2(polygon[0], polygon[i - 1], polygon[i]));
  }
  return area;
}

TEST(Stacked, SaysWhetherTheSearchCameToItsEnd) {
  MeshBuilder b;
  for (int i = 0; i < 4; ++i) {  // slanted strips: boxes overlap, charts do not
    const double y = 0.2 * i;
    b.flat_face({{0, y}, {9, y + 9}, {9, y + 9.1}, {0, y + 0.1}}, i);
  }
  const ChartSet set = charts_of(b.mesh);
  EXPECT_TRUE(set.all_stacks_found);
  EXPECT_EQ(set.stacked, 0U);
  EXPECT_TRUE(group_stacked(set.charts, 1e6).complete);
  EXPECT_FALSE(group_stacked(set.charts, 1).complete);
  EXPECT_TRUE(group_stacked(std::span(set.charts).first(1), 0).complete);
}

Box2 box_of(const std::vector<Vec2>& points) {
  Box2 box;
  for (const Vec2 p : points) box.add(p);
  return box;
}

TEST(Stacked, AgreesWithAllPairs) {
  std::mt19937 random(12);
  for (int round = 0; round < 40; ++round) {
    MeshBuilder b;
    const std::size_t count = 5 + static_cast<std::size_t>(round);
    std::vector<std::vector<Vec2>> triangles;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 at = test::random_point(random, {{0, 0}, {7, 7}});
      triangles.emplace_back();
      for (int k = 0; k < 3; ++k) {
        triangles[i].push_back(at + test::random_point(random, {{-1, -1}, {1, 1}}));
      }
      b.flat_face(triangles[i], static_cast<double>(i));
    }
    const ChartSet set = charts_of(b.mesh);
    ASSERT_EQ(set.charts.size(), count);
    std::vector<std::size_t> group(count);
    for (std::size_t i = 0; i < count; ++i) group[i] = i;
    std::vector<bool> stacked(count, false);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double smaller = std::min(set.charts[i].area, set.charts[j].area);
        const Box2 a = box_of(triangles[i]), c = box_of(triangles[j]);
        const Vec2 low{std::max(a.min.x, c.min.x), std::max(a.min.y, c.min.y)};
        const Vec2 high{std::min(a.max.x, c.max.x), std::min(a.max.y, c.max.y)};
        const double far = std::max({-low.x, -low.y, high.x, high.y, low.x, low.y});
        const double seam = 1e-6 * far * (high.x - low.x + high.y - low.y);
        if (common_area(triangles[i], triangles[j]) <= std::max(1e-6 * smaller, seam)) continue;
        stacked[i] = stacked[j] = true;
        const std::size_t from = group[i], to = group[j];
        for (std::size_t& g : group) g = g == from ? to : g;
      }
    }
    EXPECT_EQ(set.stacked, std::count(stacked.begin(), stacked.end(), true)) << round;
    const ChartSet kept = charts_of(b.mesh, Stacked::keep);
    expect_consistent(b.mesh, kept);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_EQ(kept.face_chart[i] == kept.face_chart[j], group[i] == group[j]) << round;
      }
    }
  }
}

TEST(BuildCharts, FacesThatCrossThemselvesTakeUpTheirHull) {
  const std::vector<Vec2> bow_tie{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  const std::vector<Vec2> star{{0, 3}, {2, -3}, {-3, 1}, {3, 1}, {-2, -3}};
  const std::vector<Vec2> eight{{0, 0}, {2, 0}, {1, 1}, {0, 2}, {2, 2}, {1, 1}};  // at a corner
  for (const auto& [polygon, hull, place] :
       {std::tuple(bow_tie, 4.0, Vec2{1, 1.9}), std::tuple(star, 26.0, Vec2{0, -2.9}),
        std::tuple(eight, 4.0, Vec2{0.1, 1})}) {
    test::MeshBuilder b;
    b.flat_face({{10, 0}, {12, 0}, {12, 3}, {11, 1}});
    b.flat_face(polygon);
    const auto set = build_charts(b.mesh);
    ASSERT_TRUE(set);
    EXPECT_EQ(set->crossing_faces, 1U);
    EXPECT_EQ(set->first_crossing_face, 1U);
    EXPECT_DOUBLE_EQ(set->charts[1].area, hull);
    EXPECT_NE(test::winding_at(set->charts[1], place), 0);
  }
}

TEST(BuildCharts, SidesThatTouchDoNotCross) {
  test::MeshBuilder b;
  b.flat_face({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}});  // a corner on a side
  b.flat_face({{5, 0}, {9, 0}, {9, 4}, {5, 4}, {5, 0}, {6, 1}, {6, 3}, {8, 3}, {8, 1}, {6, 1}});
  b.flat_face({{0, 5}, {1, 5}, {2, 5}, {2, 6}, {2, 7}, {1, 6}});  // corners on straight sides
  const auto set = build_charts(b.mesh);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->crossing_faces, 0U);
  EXPECT_DOUBLE_EQ(set->charts[0].area, 4);
  EXPECT_DOUBLE_EQ(set->charts[1].area, 12);  // a hole, by way of a slit
  EXPECT_DOUBLE_EQ(set->charts[2].area, 2);
}

}  // namespace
}  // namespace wrapatlas
