// From polygons to a manifold surface, whole meshes and broken ones.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/solids.h"
#include "wrapatlas/surface.h"

namespace wrapatlas {
namespace {

using test::bare_mesh;

Surface surface_of(const Mesh& mesh, const SurfaceOptions& options = {}) {
  EXPECT_TRUE(validate_mesh(mesh));
  Result<Surface> surface = build_surface(mesh, options);
  EXPECT_TRUE(surface);
  return surface ? *std::move(surface) : Surface{};
}

/// What the header promises of any surface.
void expect_manifold(const Mesh& mesh, const Surface& s) {
  ASSERT_EQ(s.face_count() + s.folded_faces.size(), mesh.face_count());
  ASSERT_EQ(s.face_begin.size(), s.face_count() + 1);
  std::map<std::uint32_t, std::size_t> corners_at, fan_at;
  for (std::uint32_t f = 0; f < s.face_count(); ++f) {
    ASSERT_EQ(s.face_begin[f + 1] - s.face_begin[f], mesh.face_size(s.face_source[f]));
    std::set<std::uint32_t> sources;
    for (std::uint32_t c = s.face_begin[f]; c < s.face_begin[f + 1]; ++c) {
      ASSERT_EQ(s.corner_face[c], f);
      sources.insert(s.corner_source[c]);
      EXPECT_EQ(s.points[s.corner_vertex[c]],
                mesh.positions[mesh.corner_position[s.corner_source[c]]]);
      ++corners_at[s.corner_vertex[c]];
      const std::uint32_t t = s.corner_twin[c];
      if (t == kNone) continue;
      EXPECT_EQ(s.corner_twin[t], c);
      EXPECT_NE(s.corner_face[t], f);
      EXPECT_EQ(s.corner_vertex[c], s.corner_vertex[s.next(t)]) << "opposite directions";
      EXPECT_EQ(s.corner_vertex[s.next(c)], s.corner_vertex[t]);
    }
    EXPECT_EQ(*sources.begin(), mesh.face_begin[s.face_source[f]]);
    EXPECT_EQ(sources.size(), mesh.face_size(s.face_source[f]));
    EXPECT_EQ(s.triangle_begin[f + 1] - s.triangle_begin[f], sources.size() - 2);
  }
  // Round each vertex: one walk from twin to twin meets all of its corners.
  for (std::uint32_t c = 0; c < s.corner_vertex.size(); ++c) {
    const std::uint32_t v = s.corner_vertex[c];
    if (fan_at.count(v) > 0) continue;
    std::uint32_t at = c;
    std::set<std::uint32_t> seen;
    const auto before = [&](std::uint32_t corner) {
      std::uint32_t p = corner;
      while (s.next(p) != corner) p = s.next(p);
      return p;
    };
    while (at != kNone && seen.insert(at).second) at = s.corner_twin[before(at)];
    at = c;
    while (s.corner_twin[at] != kNone) {
      at = s.next(s.corner_twin[at]);
      if (!seen.insert(at).second) break;
    }
    fan_at[v] = seen.size();
    EXPECT_EQ(seen.size(), corners_at[v]) << "vertex " << v;
  }
}

TEST(Surface, OfWholeMeshes) {
  for (const bool quads : {false, true}) {
    const Mesh torus = test::torus(6, 0.3, quads);
    const Surface s = surface_of(torus);
    expect_manifold(torus, s);
    EXPECT_EQ(s.points.size(), torus.positions.size());
    EXPECT_EQ(s.report.components, 1U);
    EXPECT_EQ(s.report.border_edges, 0U);
    EXPECT_EQ(s.report.turned_faces, 0U);
  }
  const Surface tube = surface_of(test::tube(5, 2));
  EXPECT_EQ(tube.report.border_edges, 20U);
}

TEST(Surface, TurnsTheFewerFaces) {
  for (const std::size_t step : {2U, 3U, 7U}) {
    const Mesh mesh = test::with_turned_faces(test::ball(5), step);
    const Surface s = surface_of(mesh);
    expect_manifold(mesh, s);
    const std::size_t turned = (mesh.face_count() + step - 1) / step;
    EXPECT_EQ(s.report.turned_faces, std::min(turned, mesh.face_count() - turned));
  }
  const Mesh inside_out = test::with_turned_faces(test::ball(5), 1);
  EXPECT_EQ(surface_of(inside_out).report.turned_faces, 0U) << "all alike are left as they are";
}

TEST(Surface, IsCutWhereItHasOneSide) {
  const Mesh mesh = test::moebius(12);
  const Surface s = surface_of(mesh);
  expect_manifold(mesh, s);
  EXPECT_EQ(s.report.one_sided_edges, 1U);
  EXPECT_EQ(s.report.border_edges, 26U);
}

TEST(Surface, CrowdedEdgesGoOnInPairs) {
  // Two cubes' worth of walls: four faces at one edge, two sheets that cross.
  const Mesh cross = bare_mesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}},
                               {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}});
  const Surface s = surface_of(cross);
  expect_manifold(cross, s);
  EXPECT_EQ(s.report.crowded_edges, 1U);
  EXPECT_EQ(s.report.components, 2U);
  EXPECT_EQ(s.corner_face[s.corner_twin[0]], 1U) << "straight on";
  EXPECT_EQ(s.corner_face[s.corner_twin[6]], 3U);

  const Mesh fin = bare_mesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}},
                             {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const Surface three = surface_of(fin);
  expect_manifold(fin, three);
  EXPECT_EQ(three.corner_twin[6], kNone) << "the third has no partner";
}

TEST(Surface, SheetsThatTouchHaveVerticesOfTheirOwn) {
  const Mesh bow =
      bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  const Surface s = surface_of(bow);
  expect_manifold(bow, s);
  EXPECT_EQ(s.report.shared_points, 1U);
  EXPECT_EQ(s.points.size(), 6U);
}

TEST(Surface, DuplicatesMakeSheetsOfTheirOwn) {
  for (const bool reversed : {false, true}) {
    const Mesh one = test::sheet(4);
    const Mesh mesh = test::both(one, reversed ? test::with_turned_faces(one, 1) : one);
    const Surface s = surface_of(mesh);
    expect_manifold(mesh, s);
    EXPECT_EQ(s.report.duplicate_faces, one.face_count());
    for (std::uint32_t c = 0; c < s.corner_twin.size(); ++c) {
      if (s.corner_twin[c] == kNone) continue;
      EXPECT_EQ(s.corner_face[c] < one.face_count(),
                s.corner_face[s.corner_twin[c]] < one.face_count())
          << "front and back are not mixed";
    }
  }
  const Mesh pair = bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  EXPECT_EQ(surface_of(pair).report.duplicate_faces, 1U);
}

TEST(Surface, LeavesOutFoldedFacesAndKeepsFlatOnes) {
  const Mesh mesh = bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {1, 1, 0}},
                              {{0, 3, 1}, {0, 0, 1}, {0, 1, 2}, {1, 4, 1, 2}, {2, 1, 4}});
  const Surface s = surface_of(mesh);
  expect_manifold(mesh, s);
  EXPECT_EQ(s.folded_faces, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(s.report.flat_faces, 1U);
  EXPECT_EQ(s.report.components, 1U);
}

TEST(Surface, ObjectsAndLabelsAndSeamsPartIt) {
  Mesh mesh = test::sheet(2, true);
  mesh.face_object = {0, 0, 1, 1};
  EXPECT_EQ(surface_of(mesh).report.components, 2U);
  mesh.face_object.clear();

  SurfaceOptions options;
  const std::vector<std::uint32_t> labels{5, 6, 5, 6};
  options.face_labels = labels;
  EXPECT_EQ(surface_of(mesh, options).report.border_edges, 12U);
  const std::vector<std::uint32_t> few{1};
  options.face_labels = few;
  EXPECT_FALSE(build_surface(mesh, options));

  SurfaceOptions seams;
  seams.uv_seams = true;
  mesh.texcoords = {{0, 0}, {1, 1}};
  for (std::size_t c = 0; c < 4; ++c) mesh.corner_texcoord[c] = 0;
  for (std::size_t c = 4; c < 16; ++c) mesh.corner_texcoord[c] = 1;
  EXPECT_EQ(surface_of(mesh, seams).report.border_edges, 12U);
}

TEST(Surface, PolygonsAreCutAsAFanFromTheFirstCornerInTheFile) {
  const std::vector<Vec3> ring{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  const std::vector<test::Face> faces{{1, 2, 3, 4, 0}};
  const Surface s = surface_of(bare_mesh(ring, faces));
  ASSERT_EQ(s.triangles.size(), 3U);
  for (std::uint32_t k = 0; k < 3; ++k) {
    EXPECT_EQ(s.triangles[k], (std::array<std::uint32_t, 3>{0, k + 1, k + 2}));
  }
  // Turned over beside two that are not: still from its first corner in the file, point 1.
  const std::vector<Vec3> more{{0, 0, 0}, {2, 0, 0},  {3, 1, 0}, {2, 2, 0},
                               {0, 2, 0}, {1, -1, 0}, {-1, 1, 0}};
  const Surface turned = surface_of(bare_mesh(more, {{1, 0, 4, 3, 2}, {1, 0, 5}, {0, 4, 6}}));
  ASSERT_EQ(turned.report.turned_faces, 1U);
  std::uint32_t of_turned = 0;
  for (const auto& triangle : turned.triangles) {
    const std::uint32_t face = turned.face_source[turned.corner_face[triangle[0]]];
    if (face != 0) continue;
    ++of_turned;
    EXPECT_EQ(turned.points[turned.corner_vertex[triangle[0]]], more[1]);
  }
  EXPECT_EQ(of_turned, 3U);
}

TEST(Surface, PolygonsWithABayAreNotCutThroughIt) {
  // From corner 0 the bay at corner 2 lies across the fan.
  const std::vector<Vec3> bay{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  const Surface fine = surface_of(bare_mesh(bay, {{0, 1, 2, 3}}));
  EXPECT_EQ(fine.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2})) << "the fan stays inside";
  const Surface bent = surface_of(bare_mesh(bay, {{1, 2, 3, 0}}));
  double area = 0;
  for (const auto& [a, b, c] : bent.triangles) {
    const auto at = [&](std::uint32_t corner) { return bent.points[bent.corner_vertex[corner]]; };
    const double part = cross(at(b) - at(a), at(c) - at(a)).z;
    EXPECT_GT(part, 0);
    area += part / 2;
  }
  EXPECT_DOUBLE_EQ(area, 4);
}

TEST(Surface, HardEdgesPartIt) {
  const Mesh roof =
      bare_mesh({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 1}}, {{0, 2, 1}, {0, 1, 3}});
  SurfaceOptions options;
  options.hard_angle = 0.7;
  EXPECT_EQ(surface_of(roof, options).report.border_edges, 6U);
  options.hard_angle = 0.9;
  EXPECT_EQ(surface_of(roof, options).report.border_edges, 4U);
}

}  // namespace
}  // namespace wrapatlas
