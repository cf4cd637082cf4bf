// Simplification as a whole: topology, volume, borders, seams, broken meshes.
#include "wrapatlas/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simplify/collapse_mesh.h"
#include "simplify/patch_geometry.h"
#include "simplify_checks.h"
#include "wrapatlas/charts.h"

namespace wrapatlas {
namespace {

using test::bare_mesh;
using test::topology_of;
using test::triangles_of;
using test::volume_of;

Simplification simplified(const Mesh& mesh, std::uint32_t faces, bool keep_uv_seams = false) {
  EXPECT_TRUE(validate_mesh(mesh));
  SimplifyOptions options;
  options.target_faces = faces;
  options.keep_uv_seams = keep_uv_seams;
  Result<Simplification> result = simplify(mesh, options);
  EXPECT_TRUE(result);
  if (!result) return {};
  EXPECT_TRUE(validate_mesh(result->mesh));
  EXPECT_EQ(result->mesh.face_count(), result->report.faces_after);
  EXPECT_EQ(result->face_source.size(), result->report.faces_after);
  EXPECT_TRUE(std::is_sorted(result->face_source.begin(), result->face_source.end()));
  return *std::move(result);
}

TEST(Simplify, KeepsTopologyAndVolume) {
  const std::vector<Mesh> meshes{
      test::ball(24), test::torus(20), test::torus(20, 0.3, true), test::knot(10),
      test::both(test::ball(12), test::moved(test::torus(12), {5, 0, 0}))};
  for (const Mesh& mesh : meshes) {
    const Simplification whole = simplified(mesh, 1000000);
    const auto before = topology_of(triangles_of(whole.mesh));
    ASSERT_TRUE(before.is_manifold);
    ASSERT_EQ(before.borders, 0);
    for (const std::uint32_t share : {2U, 10U, 50U}) {
      const std::uint32_t target = whole.report.faces_before / share;
      const Simplification less = simplified(mesh, target);
      EXPECT_EQ(less.report.faces_after, target / 2 * 2);
      EXPECT_EQ(topology_of(triangles_of(less.mesh)), before);
      EXPECT_NEAR(volume_of(less.mesh), volume_of(whole.mesh), 1e-11 * volume_of(whole.mesh));
      EXPECT_NEAR(less.report.volume_before, volume_of(whole.mesh), 1e-12);
      EXPECT_NEAR(less.report.volume_after, volume_of(less.mesh), 1e-12);
    }
  }
}

TEST(Simplify, RandomBumpySpheres) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Mesh mesh =
        test::bumpy_ball(std::uint32_t(8 + seed % 12), 0.03 + 0.01 * double(seed % 5), seed);
    const double volume = volume_of(mesh);
    for (const std::uint32_t target : {200U, 60U, 20U}) {
      const Simplification less = simplified(mesh, target);
      EXPECT_LE(less.report.faces_after, target);
      const auto topology = topology_of(triangles_of(less.mesh));
      EXPECT_EQ(topology, (test::Topology{true, 2, 1, 0}));
      EXPECT_NEAR(volume_of(less.mesh), volume, 1e-11 * volume);
    }
  }
}

TEST(Simplify, StaysCloseToTheSphere) {
  const Simplification less = simplified(test::ball(60), 400);
  for (const Vec3& p : less.mesh.positions) {  // about what 400 flat triangles need
    EXPECT_NEAR(length(p), 1, 0.02);
  }
}

TEST(Simplify, EndsWhereTopologyEnds) {
  EXPECT_EQ(simplified(test::ball(8), 0).report.faces_after, 4U);
  const Mesh tetrahedron = bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const Simplification same = simplified(tetrahedron, 0);
  EXPECT_EQ(same.report.faces_after, 4U);
  EXPECT_TRUE(std::is_permutation(same.mesh.positions.begin(), same.mesh.positions.end(),
                                  tetrahedron.positions.begin()));
  const Mesh triangle = bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_EQ(simplified(triangle, 0).report.faces_after, 1U);
  const Simplification torus = simplified(test::torus(12), 0);
  EXPECT_GE(torus.report.faces_after, 14U) << "no torus has fewer triangles";
  EXPECT_LE(torus.report.faces_after, 40U);
  EXPECT_EQ(topology_of(triangles_of(torus.mesh)), (test::Topology{true, 0, 1, 0}));
}

TEST(Simplify, EnoughIsEnough) {
  const Mesh mesh = test::ball(6);
  const Simplification same = simplified(mesh, static_cast<std::uint32_t>(mesh.face_count()));
  EXPECT_EQ(same.mesh.corner_count(), mesh.corner_count());
  EXPECT_EQ(same.report.refused, 0U);
  const Simplification one_less =
      simplified(mesh, static_cast<std::uint32_t>(mesh.face_count()) - 1);
  EXPECT_EQ(one_less.report.faces_after, mesh.face_count() - 2);
}

double border_length(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : triangles_of(mesh)) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace(t[i], t[(i + 1) % 3]);
  }
  double sum = 0;
  for (const auto& [a, b] : edges) {
    if (edges.count({b, a}) == 0) sum += length(mesh.positions[a] - mesh.positions[b]);
  }
  return sum;
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles_of(mesh)) {
    const Vec3& o = mesh.positions[a];
    sum += length(cross(mesh.positions[b] - o, mesh.positions[c] - o)) / 2;
  }
  return sum;
}

TEST(Simplify, AFlatSheetKeepsItsBorder) {
  Mesh tilted = test::sheet(12);
  for (Vec3& p : tilted.positions) p = {p.x + 3, 0.6 * p.y - 0.8 * p.z, 0.8 * p.y + 0.6 * p.z};
  for (const Mesh& mesh : {test::sheet(12), test::sheet(9, true), tilted}) {
    const Simplification less = simplified(mesh, 2);
    EXPECT_EQ(less.report.faces_after, 2U);
    EXPECT_NEAR(area_of(less.mesh), 1, 1e-12);
    EXPECT_NEAR(border_length(less.mesh), 4, 1e-12);
    for (const Vec3& p : less.mesh.positions) {
      EXPECT_NEAR(0.8 * p.y - 0.6 * p.z, mesh.positions == tilted.positions ? 0 : 0.8 * p.y, 1e-12);
    }
  }
}

TEST(Simplify, OpenBordersStay) {
  const Mesh mesh = test::tube(24, 3);
  const Simplification less = simplified(mesh, 60);
  EXPECT_LE(less.report.faces_after, 60U);
  EXPECT_EQ(topology_of(triangles_of(less.mesh)), (test::Topology{true, 0, 1, 2}));
  // The ends are circles: they lose little, and stay in their planes.
  EXPECT_NEAR(border_length(less.mesh), 4 * std::numbers::pi, 0.4);
  for (const auto& t : triangles_of(less.mesh)) {
    for (const std::uint32_t p : t) {
      EXPECT_GT(less.mesh.positions[p].z, -1e-9);
      EXPECT_LT(less.mesh.positions[p].z, 3 + 1e-9);
    }
  }
}

TEST(Simplify, WhereItIsNoManifoldNothingMoves) {
  // Two balls that touch in a point, and three sheets along a line.
  const Mesh balls = test::both(test::ball(10), test::moved(test::ball(10), {0, 0, 2}));
  const Simplification less = simplified(balls, 60);
  EXPECT_EQ(less.report.fixed_vertices, 2U);
  EXPECT_EQ(less.report.surface.shared_points, 1U);
  EXPECT_LE(less.report.faces_after, 60U);
  EXPECT_NEAR(volume_of(less.mesh), volume_of(balls), 1e-11);
  EXPECT_EQ(std::count(less.mesh.positions.begin(), less.mesh.positions.end(), Vec3{0, 0, 1}), 1);

  Mesh sheets = test::sheet(8);
  for (const double angle : {2.0, 4.0}) {
    Mesh sheet = test::sheet(8);
    for (Vec3& p : sheet.positions) p = {p.x * std::cos(angle), p.y, p.x * std::sin(angle)};
    sheets = test::both(sheets, sheet);
  }
  const Simplification fins = simplified(sheets, 0);
  EXPECT_EQ(fins.report.surface.crowded_edges, 8U);
  EXPECT_LT(fins.report.faces_after, 100U);
  for (int i = 0; i <= 8; ++i) {
    EXPECT_EQ(
        std::count(fins.mesh.positions.begin(), fins.mesh.positions.end(), Vec3{0, i / 8.0, 0}), 1);
  }
}

TEST(Simplify, OneSidedSurfaces) {
  Mesh mesh = test::moebius(64);
  const Simplification less = simplified(mesh, 30);
  EXPECT_LE(less.report.faces_after, 30U);
  EXPECT_EQ(less.report.fixed_vertices, 4U);
}

TEST(Simplify, BrokenFaces) {
  Mesh mesh = test::ball(10);
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  // A face that is a line, a point, a quad that uses a point twice in place of a triangle.
  const std::uint32_t a = mesh.corner_position[0], b = mesh.corner_position[1];
  for (const std::uint32_t p : {a, b, b, a, a, a}) mesh.corner_position.push_back(p);
  mesh.face_begin.push_back(mesh.face_begin.back() + 3);
  mesh.face_begin.push_back(mesh.face_begin.back() + 3);
  mesh.corner_position.insert(mesh.corner_position.begin() + 3, mesh.corner_position[2]);
  for (std::size_t f = 1; f < mesh.face_begin.size(); ++f) ++mesh.face_begin[f];
  mesh.corner_texcoord.assign(mesh.corner_position.size(), kNone);
  const Simplification less = simplified(mesh, 50);
  EXPECT_EQ(less.report.dropped_faces, 3U);
  EXPECT_EQ(less.report.faces_before, faces);
  EXPECT_EQ(less.report.faces_after, 50U);
  EXPECT_EQ(topology_of(triangles_of(less.mesh)), (test::Topology{true, 2, 1, 0}));
}

TEST(Simplify, FacesWithoutArea) {
  // Each triangle of a ball has a point on one of its edges, which the neighbour has too: two
  // triangles there, and the third between them is flat.
  Mesh flat = test::ball(8);
  const std::size_t faces = flat.face_count();
  std::vector<test::Face> triangles;
  for (std::uint32_t f = 0; f < faces; ++f) {
    const std::uint32_t *c = &flat.corner_position[3 * f], p = c[0], q = c[1], r = c[2];
    const auto middle = static_cast<std::uint32_t>(flat.positions.size());
    flat.positions.push_back(0.5 * (flat.positions[p] + flat.positions[q]));
    triangles.insert(triangles.end(), {{p, q, middle}, {middle, q, r}, {p, middle, r}});
  }
  flat = bare_mesh(flat.positions, triangles);
  const Simplification less = simplified(flat, 60);
  EXPECT_LE(less.report.faces_after, 60U);
  EXPECT_EQ(topology_of(triangles_of(less.mesh)), (test::Topology{true, 2, 1, 0}));
  EXPECT_NEAR(volume_of(less.mesh), volume_of(flat), 1e-11);
}

TEST(Simplify, ObjectsStayApart) {
  Mesh mesh = test::both(test::ball(10), test::ball(10));  // at the same place
  mesh.face_object.assign(mesh.face_count(), 7);
  std::fill(mesh.face_object.begin(), mesh.face_object.begin() + 360, 3);
  const Simplification less = simplified(mesh, 80);
  EXPECT_EQ(less.report.fixed_vertices, 0U);
  EXPECT_EQ(topology_of(triangles_of(less.mesh)), (test::Topology{true, 4, 2, 0}));
  for (std::size_t f = 0; f < less.mesh.face_count(); ++f) {
    EXPECT_EQ(less.mesh.face_object[f], mesh.face_object[less.face_source[f]]);
  }
  EXPECT_GT(std::count(less.mesh.face_object.begin(), less.mesh.face_object.end(), 3), 30);
}

/// `count` triangles around each of two points.
Mesh two_hubs(std::uint32_t count, const Vec3& top, const Vec3& bottom) {
  std::vector<Vec3> positions{top, bottom};
  std::vector<test::Face> faces;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    positions.push_back({std::cos(angle), std::sin(angle), 0});
    const std::uint32_t here = 2 + i, next = 2 + (i + 1) % count;
    faces.push_back({0, here, next});
    faces.push_back({1, next, here});
  }
  return bare_mesh(positions, faces);
}

TEST(Simplify, ManyTrianglesAroundAPoint) {
  // Were the work at a hub that of all its triangles each time, this would take a minute.
  for (const Vec3& bottom : {Vec3{0, 0, -0.2}, {0.1, 0, 0}}) {
    const Mesh mesh = two_hubs(40000, {0, 0, 1}, bottom);
    const Simplification less = simplified(mesh, 400);
    EXPECT_EQ(less.report.faces_after, 400U);
    EXPECT_EQ(topology_of(triangles_of(less.mesh)), (test::Topology{true, 2, 1, 0}));
    EXPECT_NEAR(volume_of(less.mesh), volume_of(mesh), 1e-11);
  }
}

/// Collapses edges at random until so many faces are left, and compares all sums with fresh ones
/// each time.
void expect_no_drift(const Mesh& mesh, std::uint32_t faces, std::uint32_t first_vertex) {
  const Result<Surface> surface = build_surface(mesh);
  ASSERT_TRUE(surface);
  CollapseMesh collapsed(*surface);
  PatchGeometry geometry(collapsed, surface->points);
  std::mt19937_64 random(9);
  for (int tries = 0; tries < 20000 && collapsed.face_count() > faces; ++tries) {
    const auto c = static_cast<std::uint32_t>(random() % (3 * collapsed.face_numbers()));
    if (!collapsed.has_face(c / 3)) continue;
    const std::uint32_t v = collapsed.vertex(c), w = collapsed.vertex(CollapseMesh::next(c));
    if (std::min(v, w) < first_vertex || !collapsed.can_collapse(c)) continue;
    const Vec3 point = 0.5 * (geometry.position(v) + geometry.position(w)) +
                       Vec3{0, 0, test::uniform(random, -1e-3, 1e-3)};
    geometry.before_collapse(c);
    collapsed.collapse(c);
    geometry.move(v, point);
    for (std::uint32_t u = 0; u < collapsed.vertex_numbers(); ++u) {
      if (collapsed.corner_of_vertex(u) == kNone) continue;
      Star star;
      collapsed.each_corner(u, [&](std::uint32_t k) { star.add(geometry.normal(k / 3)); });
      const Symmetric3 off = geometry.star(u).squares - star.squares;
      const double most = 1e-12 * star.squares.trace();
      ASSERT_EQ(geometry.star(u).faces, star.faces);
      ASSERT_LT(length(geometry.star(u).normal - star.normal), 1e-13);
      for (const double entry : {off.xx, off.xy, off.xz, off.yy, off.yz, off.zz}) {
        ASSERT_LE(std::abs(entry), most);
      }
    }
  }
  EXPECT_LE(collapsed.face_count(), faces);
}

TEST(Simplify, SumsDoNotDrift) {
  expect_no_drift(two_hubs(600, {0, 0, 1}, {0, 0, -1e-3}), 700, 2);  // along the ring
  expect_no_drift(test::bumpy_ball(10, 0.05, 2), 40, 0);
  Mesh open = test::bumpy_ball(10, 0.05, 2);  // half of it
  open.face_begin.resize(open.face_count() / 2 + 1);
  open.corner_position.resize(open.face_begin.back());
  open.corner_texcoord.resize(open.face_begin.back());
  expect_no_drift(open, 30, 0);
}

TEST(Simplify, IsTheSameEveryTimeAndAtAnySize) {
  const Mesh mesh = test::bumpy_ball(16, 0.05, 5);
  Mesh large = mesh;
  for (Vec3& p : large.positions) p = 0x1.0p70 * p;
  const Simplification one = simplified(mesh, 100), two = simplified(mesh, 100);
  const Simplification three = simplified(large, 100);
  EXPECT_EQ(one.mesh.positions, two.mesh.positions);
  EXPECT_EQ(one.mesh.corner_position, two.mesh.corner_position);
  EXPECT_EQ(one.mesh.corner_position, three.mesh.corner_position);
  for (std::size_t i = 0; i < one.mesh.positions.size(); ++i) {
    EXPECT_EQ(0x1.0p70 * one.mesh.positions[i], three.mesh.positions[i]);
  }
}

TEST(Simplify, BoxesWhoseInverseIsInfinite) {
  Mesh small = test::bumpy_ball(16, 0.05, 5);
  for (Vec3& p : small.positions) p = 0x1.0p-1030 * p;  // subnormal: 44 bits are left
  Mesh large = small;
  for (Vec3& p : large.positions) p = 0x1.0p1000 * p;
  const Simplification less = simplified(small, 100), same = simplified(large, 100);
  EXPECT_EQ(less.report.faces_after, 100U);
  EXPECT_EQ(less.mesh.corner_position, same.mesh.corner_position);
  ASSERT_EQ(less.mesh.positions.size(), same.mesh.positions.size());
  for (std::size_t i = 0; i < less.mesh.positions.size(); ++i) {
    EXPECT_EQ(less.mesh.positions[i], 0x1.0p-1000 * same.mesh.positions[i]);
  }
}

/// The square of all UVs on a torus: a seam around and one across, which meet in a point.
Mesh mapped_torus(std::uint32_t n) {
  Mesh mesh = test::torus(n);
  const std::uint32_t columns = 2 * n;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      mesh.texcoords.push_back({double(i) / columns, double(j) / n});
    }
  }
  mesh.corner_texcoord.clear();
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (columns + 1) + i; };
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      for (const std::uint32_t c : {at(i, j), at(i + 1, j), at(i + 1, j + 1)}) {
        mesh.corner_texcoord.push_back(c);
      }
      for (const std::uint32_t c : {at(i, j), at(i + 1, j + 1), at(i, j + 1)}) {
        mesh.corner_texcoord.push_back(c);
      }
    }
  }
  return mesh;
}

TEST(Simplify, SeamsStaySeams) {
  const Mesh mesh = mapped_torus(20);
  const Simplification less = simplified(mesh, 120, true);
  EXPECT_LE(less.report.faces_after, 120U);
  EXPECT_EQ(less.report.fixed_vertices, 1U);
  EXPECT_EQ(topology_of(triangles_of(less.mesh)), (test::Topology{true, 0, 1, 0}));
  EXPECT_NEAR(volume_of(less.mesh), volume_of(mesh), 1e-11);
  double area = 0;
  std::map<std::uint32_t, std::set<std::pair<double, double>>> uvs_at;
  for (std::uint32_t f = 0; f < less.mesh.face_count(); ++f) {
    std::array<Vec2, 3> uv;
    for (std::uint32_t i = 0; i < 3; ++i) {
      ASSERT_NE(less.mesh.corner_texcoord[3 * f + i], kNone);
      uv[i] = less.mesh.texcoords[less.mesh.corner_texcoord[3 * f + i]];
      uvs_at[less.mesh.corner_position[3 * f + i]].emplace(uv[i].x, uv[i].y);
    }
    EXPECT_GT(signed_area2(uv[0], uv[1], uv[2]), 0);
    area += signed_area2(uv[0], uv[1], uv[2]) / 2;
  }
  EXPECT_NEAR(area, 1, 1e-12) << "the chart is the whole square, as before";
  std::size_t on_seams = 0;
  for (const auto& [position, uvs] : uvs_at) {
    if (uvs.size() == 1) continue;
    ++on_seams;
    EXPECT_EQ(uvs.size(), uvs.count({0, 0}) > 0 ? 4U : 2U);
    for (const auto& [u, v] : uvs) {  // the other side has the same place of the seam
      const bool across = u == 0 || u == 1, along = v == 0 || v == 1;
      EXPECT_TRUE(across || along);
      EXPECT_TRUE(uvs.count({across ? 1 - u : u, along ? 1 - v : v}) > 0);
    }
  }
  EXPECT_GT(on_seams, 5U);
  EXPECT_LT(on_seams, 40U) << "of 59 before";
  const auto charts = build_charts(less.mesh);
  ASSERT_TRUE(charts);
  EXPECT_EQ(charts->charts.size(), 1U);
}

TEST(Simplify, UvsFollowTheSurface) {
  // On a flat sheet whose UVs are its coordinates they stay so.
  Mesh mesh = test::sheet(12);
  for (const Vec3& p : mesh.positions) mesh.texcoords.push_back({p.x, p.y});
  mesh.corner_texcoord = mesh.corner_position;
  const Simplification less = simplified(mesh, 30, true);
  EXPECT_LE(less.report.faces_after, 30U);
  for (std::size_t c = 0; c < less.mesh.corner_count(); ++c) {
    const Vec3& p = less.mesh.positions[less.mesh.corner_position[c]];
    const Vec2& uv = less.mesh.texcoords[less.mesh.corner_texcoord[c]];
    EXPECT_NEAR(length(uv - Vec2{p.x, p.y}), 0, 1e-12);
  }
  EXPECT_TRUE(simplified(mesh, 30).mesh.texcoords.empty());
}

TEST(Simplify, FacesWithoutUvsStayWithout) {
  Mesh mesh = mapped_torus(12);
  std::fill(mesh.corner_texcoord.begin(), mesh.corner_texcoord.begin() + 6 * 24 * 3, kNone);
  mesh.corner_texcoord[6 * 24 * 3] = kNone;  // at one corner of three: counts as none
  const Simplification less = simplified(mesh, 150, true);
  EXPECT_LE(less.report.faces_after, 150U);
  EXPECT_EQ(topology_of(triangles_of(less.mesh)), (test::Topology{true, 0, 1, 0}));
  std::size_t without = 0;
  for (std::size_t f = 0; f < less.mesh.face_count(); ++f) {
    const std::uint32_t* uv = &less.mesh.corner_texcoord[3 * f];
    EXPECT_EQ(uv[0] == kNone, uv[1] == kNone);
    EXPECT_EQ(uv[0] == kNone, uv[2] == kNone);
    without += uv[0] == kNone ? 1 : 0;
  }
  EXPECT_GT(without, 5U);
  EXPECT_LT(without, less.mesh.face_count() - 5);
}

TEST(Simplify, StopsWhenAsked) {
  SimplifyOptions options;
  double last = -1;
  int calls = 0;
  options.progress = [&](const SimplifyProgress& progress) {
    EXPECT_GE(progress.fraction, last);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
    return ++calls < 3;
  };
  const auto stopped = simplify(test::ball(60), options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::interrupted);
  EXPECT_EQ(calls, 3);
}

TEST(Simplify, RefusesWhatIsNoSurface) {
  const auto none = simplify(bare_mesh({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}, {0, 0, 0}}));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::input);
}

}  // namespace
}  // namespace wrapatlas
