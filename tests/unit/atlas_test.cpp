// Export of packings that are made by hand or by chance, continuous and cut.
#include "wrapatlas/atlas.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bumpy_cube.h"
#include "uv_mesh.h"

namespace wrapatlas {
namespace {

using test::applied;
using test::cube;
using test::MeshBuilder;

constexpr double kTurn = 6.283185307179586;

ChartSet charts_of(const Mesh& mesh) {
  Result<ChartSet> set = build_charts(mesh);
  EXPECT_TRUE(set);
  return *std::move(set);
}

Packing random_packing(std::size_t charts, double scale, Wrap wrap, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Packing packing;
  packing.width = 64;
  packing.height = 48;
  packing.wrap = wrap;
  packing.scale = scale;
  for (std::size_t i = 0; i < charts; ++i) {
    const double angle = kTurn * unit(random), x = 300 * unit(random), y = 300 * unit(random);
    packing.placements.push_back({angle, {x - 150, y - 150}});
  }
  return packing;
}

double area_of_face(const Mesh& mesh, std::size_t face) {
  std::vector<Vec2> uvs;
  for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
    uvs.push_back(mesh.texcoords[mesh.corner_texcoord[c]]);
  }
  double area = 0;
  for (std::size_t i = 0; i < uvs.size(); ++i) {
    area += 0.5 * cross(uvs[i] - uvs[0], uvs[(i + 1) % uvs.size()] - uvs[0]);
  }
  return area;
}

/// What a texture look-up at `at` (modulo 1) finds: source face and point in space, of every
/// triangle over the place that does not have it near its border.
struct Hit {
  std::uint32_t face;
  Vec3 position;
};
std::vector<Hit> look_up(const Mesh& mesh, const std::vector<std::uint32_t>& source, Vec2 at,
                         bool& near_border) {
  std::vector<Hit> hits;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face];
    std::vector<Vec2> uvs;
    Box2 box;
    for (std::uint32_t c = begin; c < mesh.face_begin[face + 1]; ++c) {
      uvs.push_back(mesh.texcoords[mesh.corner_texcoord[c]]);
      box.add(uvs.back());
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (double i = std::ceil(box.min.x - at.x); at.x + i <= box.max.x; ++i) {
      for (double j = std::ceil(box.min.y - at.y); at.y + j <= box.max.y; ++j) {
        if (triangles.empty()) triangulate_polygon(uvs, triangles);
        for (const auto& t : triangles) {
          const Vec2 a = uvs[t[0]], b = uvs[t[1]], c = uvs[t[2]], p = at + Vec2{i, j};
          const double area = signed_area2(a, b, c);
          if (std::abs(area) < 1e-12) continue;  // three corners on one side of a piece
          const double u = signed_area2(b, c, p) / area, v = signed_area2(c, a, p) / area;
          const double least = std::min({u, v, 1 - u - v});
          near_border = near_border || std::abs(least) < 1e-9;
          if (!(least > 0)) continue;
          const auto space = [&](std::size_t k) {
            return mesh.positions[mesh.corner_position[begin + t[k]]];
          };
          hits.push_back({source[face], u * space(0) + v * space(1) + (1 - u - v) * space(2)});
        }
      }
    }
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return std::tie(a.face, a.position.x) < std::tie(b.face, b.position.x);
  });
  return hits;
}

struct Exported {
  AtlasMesh continuous, cut;
  Mesh continuous_mesh, cut_mesh;
};
Exported export_both(const Mesh& mesh, const ChartSet& charts, const Packing& packing) {
  Exported e;
  e.continuous = export_continuous(mesh, charts, packing);
  e.cut = export_cut(mesh, charts, packing);
  e.continuous_mesh = applied(mesh, e.continuous);
  e.cut_mesh = applied(mesh, e.cut);
  EXPECT_TRUE(validate_mesh(e.continuous_mesh));
  EXPECT_TRUE(validate_mesh(e.cut_mesh));
  return e;
}

void expect_inside_and_of_same_area(const Exported& e) {
  for (const Vec2 uv : e.cut.texcoords) {
    ASSERT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << uv.x << ' ' << uv.y;
  }
  EXPECT_EQ(e.cut.wrap, Wrap::none);
  ASSERT_TRUE(std::is_sorted(e.cut.face_source.begin(), e.cut.face_source.end()));
  std::vector<double> sum(e.continuous_mesh.face_count(), 0), absolute = sum;
  for (std::size_t piece = 0; piece < e.cut_mesh.face_count(); ++piece) {
    const double area = area_of_face(e.cut_mesh, piece);
    sum[e.cut.face_source[piece]] += area;
    absolute[e.cut.face_source[piece]] += std::abs(area);
  }
  for (std::size_t face = 0; face < sum.size(); ++face) {
    const double area = area_of_face(e.continuous_mesh, face);
    ASSERT_NEAR(sum[face], area, 1e-12) << face;
    ASSERT_NEAR(absolute[face], std::abs(area), 1e-12) << face;
  }
}

void expect_cut_points_on_their_faces(const Mesh& mesh, const Exported& e) {
  for (std::size_t c = 0; c < e.cut.corner_cut.size(); ++c) {
    ASSERT_NE(e.cut.corner_cut[c] == kNone, e.cut.corner_source[c] == kNone);
  }
  for (std::size_t piece = 0; piece < e.cut.face_count(); ++piece) {
    const std::uint32_t face = e.cut.face_source[piece];
    for (std::uint32_t c = e.cut.face_begin[piece]; c < e.cut.face_begin[piece + 1]; ++c) {
      if (e.cut.corner_cut[c] == kNone) continue;
      const AtlasMesh::CutPoint& cut = e.cut.cut_points[e.cut.corner_cut[c]];
      ASSERT_LT(cut.position, e.cut.cut_position_count);
      double sum = 0;
      Vec2 uv;
      for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_GE(cut.corners[i], mesh.face_begin[face]);
        ASSERT_LT(cut.corners[i], mesh.face_begin[face + 1]);
        ASSERT_GE(cut.weights[i], 0);
        sum += cut.weights[i];
        const std::uint32_t t = e.continuous.corner_texcoord[cut.corners[i]];
        if (t != kNone) uv = uv + cut.weights[i] * e.continuous.texcoords[t];
      }
      ASSERT_NEAR(sum, 1, 1e-15);
      if (e.cut.corner_texcoord[c] == kNone) continue;
      const Vec2 d = uv - e.cut.texcoords[e.cut.corner_texcoord[c]];
      ASSERT_NEAR(d.x, std::round(d.x), 1e-11);
      ASSERT_NEAR(d.y, std::round(d.y), 1e-11);
    }
  }
}

/// On a closed surface every directed edge occurs once, and so does its opposite.
void expect_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face], size = mesh.face_size(face);
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = mesh.corner_position[begin + i];
      const std::uint32_t b = mesh.corner_position[begin + (i + 1) % size];
      ASSERT_NE(a, b) << "face " << face;
      ++edges[{a, b}];
    }
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << edge.first << '-' << edge.second;
    ASSERT_TRUE(edges.count({edge.second, edge.first})) << edge.first << '-' << edge.second;
  }
}

void expect_same_picture(const Exported& e, const Packing& packing, int step) {
  int compared = 0;
  for (int y = 0; y < packing.height; y += step) {
    for (int x = 0; x < packing.width; x += step) {
      const Vec2 at{(x + 0.5) / packing.width, (y + 0.5) / packing.height};
      bool near_border = false;
      const auto expected = look_up(e.continuous_mesh, e.continuous.face_source, at, near_border);
      const auto found = look_up(e.cut_mesh, e.cut.face_source, at, near_border);
      if (near_border) continue;
      ASSERT_EQ(found.size(), expected.size()) << at.x << ' ' << at.y;
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].face, expected[i].face);
        ASSERT_LT(length(found[i].position + -1.0 * expected[i].position), 1e-9);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 0);
}

struct Case {
  int kind;
  Wrap wrap;
  double scale;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << "kind " << c.kind << " wrap " << static_cast<int>(c.wrap) << " scale " << c.scale;
}

class RandomAtlas : public ::testing::TestWithParam<Case> {};

TEST_P(RandomAtlas, CutShowsWhatContinuousShows) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = cube(4, GetParam().kind, seed);
    const ChartSet charts = charts_of(mesh);
    ASSERT_EQ(charts.charts.size(), 6U);
    const Packing packing = random_packing(6, GetParam().scale, GetParam().wrap, seed);
    const Exported e = export_both(mesh, charts, packing);
    if (packing.wrap == Wrap::uv) expect_inside_and_of_same_area(e);
    expect_cut_points_on_their_faces(mesh, e);
    expect_closed(e.cut_mesh);
    if (packing.wrap == Wrap::uv) expect_same_picture(e, packing, 5);
  }
}

INSTANTIATE_TEST_SUITE_P(Cubes, RandomAtlas,
                         ::testing::Values(Case{0, Wrap::uv, 6}, Case{1, Wrap::uv, 6},
                                           Case{2, Wrap::uv, 6}, Case{3, Wrap::uv, 6},
                                           Case{0, Wrap::uv, 40}, Case{3, Wrap::uv, 40},
                                           Case{2, Wrap::uv, 150}, Case{2, Wrap::uv, 0.5},
                                           Case{2, Wrap::u, 30}, Case{2, Wrap::v, 30},
                                           Case{2, Wrap::none, 30}));

/// A square chart of n x n quads with corner (x, y), in texels of a 16 x 16 atlas that wraps.
struct Square {
  Square(std::uint32_t n, double side, Vec2 at, double angle = 0, Wrap wrap = Wrap::uv) {
    MeshBuilder b;
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const double x = i, y = j;
        b.flat_face({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
      }
    }
    mesh = b.mesh;
    charts = charts_of(mesh);
    packing.width = packing.height = 16;
    packing.wrap = wrap;
    packing.scale = side / n;
    packing.placements = {{angle, at}};
  }
  Mesh mesh;
  ChartSet charts;
  Packing packing;
};

TEST(ExportContinuous, ShiftsIntoFirstPeriod) {
  const Square s(1, 8, {-35, 100});
  const AtlasMesh atlas = export_continuous(s.mesh, s.charts, s.packing);
  EXPECT_EQ(atlas.texcoords[0], (Vec2{13.0 / 16, 4.0 / 16}));
  EXPECT_EQ(atlas.texcoords[2], (Vec2{21.0 / 16, 12.0 / 16}));
  EXPECT_EQ(atlas.wrap, Wrap::u);
  EXPECT_FALSE(atlas.is_cut());
  EXPECT_EQ(atlas.face_begin, s.mesh.face_begin);
}

TEST(ExportContinuous, WrapsOnlyWhereAChartLeaves) {
  EXPECT_EQ(Square(1, 8, {8, 8}).packing.wrap, Wrap::uv);
  const auto wrap_of = [](Vec2 at, Wrap wrap) {
    const Square s(1, 8, at, 0, wrap);
    return export_continuous(s.mesh, s.charts, s.packing).wrap;
  };
  EXPECT_EQ(wrap_of({8, 8}, Wrap::uv), Wrap::none);
  EXPECT_EQ(wrap_of({9, 8}, Wrap::uv), Wrap::u);
  EXPECT_EQ(wrap_of({8, 9}, Wrap::uv), Wrap::v);
  EXPECT_EQ(wrap_of({9, 9}, Wrap::uv), Wrap::uv);
  EXPECT_EQ(wrap_of({9, 8}, Wrap::v), Wrap::none);
}

TEST(ExportContinuous, RoundingDoesNotReachOne) {
  for (const double x : {-1e-17, -1e-300, -0.0, 16 - 1e-15, 32.0}) {
    const Square s(1, 4, {x, 3});
    const AtlasMesh atlas = export_continuous(s.mesh, s.charts, s.packing);
    EXPECT_GE(atlas.texcoords[0].x, 0) << x;
    EXPECT_LT(atlas.texcoords[0].x, 1) << x;
  }
}

TEST(ExportContinuous, DoesNotShiftAxesThatDoNotWrap) {
  const Square s(1, 4, {-35, 3}, 0, Wrap::v);
  EXPECT_EQ(export_continuous(s.mesh, s.charts, s.packing).texcoords[0].x, -35.0 / 16);
}

TEST(RoundTexcoords, EveryOneOfAnyNumber) {
  for (std::size_t count = 0; count < 9; ++count) {
    AtlasMesh atlas;
    atlas.texcoords.assign(count, {1.0 / 3, 2.0 / 3});
    round_texcoords_to_float(atlas);
    for (const Vec2 uv : atlas.texcoords) {
      EXPECT_EQ(uv.x, 11184811.0 / (1 << 25));
      EXPECT_EQ(uv.y, 11184811.0 / (1 << 24));
    }
  }
}

TEST(ExportCut, NothingToCut) {
  const Square s(3, 8, {4, 20});
  const AtlasMesh cut = export_cut(s.mesh, s.charts, s.packing);
  const AtlasMesh whole = export_continuous(s.mesh, s.charts, s.packing);
  EXPECT_FALSE(cut.is_cut());
  EXPECT_EQ(cut.face_begin, whole.face_begin);
  EXPECT_EQ(cut.corner_source, whole.corner_source);
  ASSERT_EQ(cut.texcoords.size(), whole.texcoords.size());
  for (std::size_t c = 0; c < cut.corner_texcoord.size(); ++c) {
    EXPECT_EQ(cut.texcoords[cut.corner_texcoord[c]], whole.texcoords[whole.corner_texcoord[c]]);
  }
}

TEST(ExportCut, FourQuarters) {
  for (const double angle : {0.0, 0.3}) {
    const Square s(5, 10, {11, 10}, angle);
    const Exported e = export_both(s.mesh, s.charts, s.packing);
    expect_inside_and_of_same_area(e);
    expect_same_picture(e, s.packing, 1);
    EXPECT_EQ(charts_of(e.cut_mesh).charts.size(), 4U);  // pieces stay connected
  }
}

TEST(ExportCut, BorderThroughVerticesCutsNothing) {
  // The line u = 1 runs along edges of the mesh; with rounding it misses them by a hair.
  for (const double off : {0.0, 1e-14, -1e-14, 5e-13, -5e-13}) {
    const Square s(4, 8, {12 + off, 4 + off});
    const Exported e = export_both(s.mesh, s.charts, s.packing);
    EXPECT_FALSE(e.cut.is_cut()) << off;
    EXPECT_EQ(e.cut.face_count(), 16U);
    expect_inside_and_of_same_area(e);
    std::set<double> us;
    for (const Vec2 uv : e.cut.texcoords) us.insert(uv.x);
    EXPECT_TRUE(us.count(0.0) && us.count(1.0)) << off;
  }
}

TEST(ExportCut, DiagonalsThroughTheCornerOfTheAtlas) {
  // Lines u = 1 and v = 1 meet on edges and vertices of the mesh: no sliver may come of it.
  for (const double angle : {kTurn / 8, 3 * kTurn / 8, 0.0}) {
    const Square s(4, 8, {16, 16 - 3 * std::sqrt(0.5)}, angle);
    const Exported e = export_both(s.mesh, s.charts, s.packing);
    expect_inside_and_of_same_area(e);
    expect_same_picture(e, s.packing, 1);
    for (std::size_t piece = 0; piece < e.cut_mesh.face_count(); ++piece) {
      EXPECT_GT(area_of_face(e.cut_mesh, piece), 1e-9) << angle;
    }
  }
}

TEST(ExportCut, FacesWithoutUvsGetTheNewPointsToo) {
  Mesh mesh = cube(2, 1, 5);
  for (std::uint32_t c = 0; c < mesh.face_begin[4]; ++c) mesh.corner_texcoord[c] = kNone;
  const ChartSet charts = charts_of(mesh);
  const Packing packing = random_packing(charts.charts.size(), 25, Wrap::uv, 2);
  const AtlasMesh cut = export_cut(mesh, charts, packing);
  const Mesh result = applied(mesh, cut);
  expect_closed(result);
  std::size_t bare = 0, inserted = 0;
  for (std::size_t face = 0; face < cut.face_count() && cut.face_source[face] < 4; ++face) {
    ++bare;
    for (std::uint32_t c = cut.face_begin[face]; c < cut.face_begin[face + 1]; ++c) {
      EXPECT_EQ(cut.corner_texcoord[c], kNone);
      inserted += cut.corner_cut[c] != kNone;
    }
  }
  EXPECT_EQ(bare, 4U);
  EXPECT_GT(inserted, 0U);
}

TEST(ExportCut, OtherObjectsGetNoNewPoints) {
  const Square s(1, 4, {14, 6});
  Mesh mesh = s.mesh;  // and the square once more, without UVs
  for (std::uint32_t c = 0; c < 4; ++c) {
    mesh.corner_position.push_back(mesh.corner_position[c]);
    mesh.corner_texcoord.push_back(kNone);
  }
  mesh.face_begin.push_back(8);
  for (const bool apart : {false, true}) {
    if (apart) mesh.face_object = {0, 1};
    const AtlasMesh cut = export_cut(mesh, charts_of(mesh), s.packing);
    ASSERT_EQ(cut.face_source.back(), 1U);
    const std::size_t corners = cut.face_begin.back() - cut.face_begin[cut.face_count() - 1];
    EXPECT_EQ(corners, apart ? 4U : 6U);
  }
}

TEST(ExportCut, FaceOfNoUvAreaIsCutAsWell) {
  // A triangle whose UVs lie on one line hangs between two others; the surface stays closed.
  MeshBuilder b;
  const auto p = b.position({0, 0, 0}), q = b.position({1, 0, 0}), r = b.position({0, 1, 0}),
             s = b.position({0, 0, 1});
  const auto a = b.texcoord({0, 0}), m = b.texcoord({5, 0}), c = b.texcoord({10, 0}),
             d = b.texcoord({5, 6});
  b.face({{p, a}, {q, m}, {r, c}});
  b.face({{q, m}, {p, a}, {s, d}});
  b.face({{r, c}, {q, m}, {s, d}});
  b.face({{p, a}, {r, c}, {s, d}});
  const ChartSet charts = charts_of(b.mesh);
  Packing packing;
  packing.width = packing.height = 16;
  packing.wrap = Wrap::uv;
  packing.scale = 1;
  packing.placements = {{0.2, {9.3, 12.1}}};
  const Exported e = export_both(b.mesh, charts, packing);
  expect_closed(e.cut_mesh);
  expect_inside_and_of_same_area(e);
}

TEST(ExportCut, SameBytesTwice) {
  const Mesh mesh = cube(5, 2, 9);
  const ChartSet charts = charts_of(mesh);
  const Packing packing = random_packing(6, 20, Wrap::uv, 9);
  const AtlasMesh one = export_cut(mesh, charts, packing), two = export_cut(mesh, charts, packing);
  EXPECT_EQ(one.texcoords, two.texcoords);
  EXPECT_EQ(one.corner_cut, two.corner_cut);
  EXPECT_EQ(one.corner_texcoord, two.corner_texcoord);
}

TEST(Rounding, EveryTexcoordIsAFloatAfterwards) {
  for (int count = 1; count < 20; ++count) {
    AtlasMesh atlas;
    for (int i = 0; i < count; ++i) atlas.texcoords.push_back({i + 0.1, i + 0.3});
    round_texcoords_to_float(atlas);
    for (int i = 0; i < count; ++i) {
      // Through memory: what the compiler knows of a rounding it may leave out.
      const volatile float u = static_cast<float>(i + 0.1), v = static_cast<float>(i + 0.3);
      EXPECT_EQ(atlas.texcoords[static_cast<std::size_t>(i)].x, double{u}) << count;
      EXPECT_EQ(atlas.texcoords[static_cast<std::size_t>(i)].y, double{v}) << count;
    }
  }
}

}  // namespace
}  // namespace wrapatlas
