// Whole meshes, whole and broken, come to charts that keep every promise.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "charts/hull.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/unwrap.h"

namespace wrapatlas {
namespace {

/// L2 stretch of one chart by the formula as it is printed, area normalised.
double slow_l2(const std::vector<std::array<Vec3, 3>>& space,
               const std::vector<std::array<Vec2, 3>>& plane) {
  double sum = 0, area3 = 0, area2 = 0;
  for (std::size_t i = 0; i < space.size(); ++i) {
    const auto& [q1, q2, q3] = space[i];
    const auto& [p1, p2, p3] = plane[i];
    const double a3 = 0.5 * length(cross(q2 - q1, q3 - q1));
    const double twice = signed_area2(p1, p2, p3);
    area2 += 0.5 * twice;
    if (a3 == 0) continue;
    const Vec3 ss = (1 / twice) * ((p2.y - p3.y) * q1 + (p3.y - p1.y) * q2 + (p1.y - p2.y) * q3);
    const Vec3 st = (1 / twice) * ((p3.x - p2.x) * q1 + (p1.x - p3.x) * q2 + (p2.x - p1.x) * q3);
    sum += 0.5 * (dot(ss, ss) + dot(st, st)) * a3;
    area3 += a3;
  }
  return std::sqrt(sum / area3) * std::sqrt(area2 / area3);
}

/// Every promise of unwrap(), looked at anew from the mesh that came out.
Unwrapping expect_unwrapped(const Mesh& mesh, const UnwrapOptions& options = {}) {
  EXPECT_TRUE(validate_mesh(mesh));
  auto result = unwrap(mesh, options);
  EXPECT_TRUE(result) << (result ? "" : result.error().message());
  if (!result) return {};
  const Mesh& out = result->mesh;
  EXPECT_TRUE(validate_mesh(out));
  EXPECT_EQ(out.face_begin, mesh.face_begin);
  EXPECT_EQ(out.corner_position, mesh.corner_position);
  EXPECT_EQ(out.positions, mesh.positions);

  const auto charts = build_charts(out);
  EXPECT_TRUE(charts);
  if (!charts) return {};
  EXPECT_EQ(charts->charts.size(), result->charts.size());
  EXPECT_EQ(charts->faces_without_uv, 0U);
  EXPECT_EQ(charts->self_overlapping, 0U);
  EXPECT_EQ(charts->stacked, 0U);

  std::map<std::uint32_t, std::vector<std::uint32_t>> faces_of;
  for (std::uint32_t f = 0; f < out.face_count(); ++f) {
    EXPECT_LT(result->face_chart[f], result->charts.size());
    faces_of[result->face_chart[f]].push_back(f);
  }
  EXPECT_EQ(faces_of.size(), result->charts.size());
  for (const auto& [chart, faces] : faces_of) {
    std::set<std::uint32_t> points;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::vector<std::array<Vec3, 3>> space;
    std::vector<std::array<Vec2, 3>> plane;
    for (const std::uint32_t f : faces) {
      const std::uint32_t begin = out.face_begin[f], size = out.face_size(f);
      for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint32_t a = out.corner_texcoord[begin + i];
        const std::uint32_t b = out.corner_texcoord[begin + (i + 1) % size];
        EXPECT_NE(a, kNone);
        points.insert(a);
        ++edges[{std::min(a, b), std::max(a, b)}];
      }
      if (size != 3) continue;
      std::array<Vec3, 3> q;
      std::array<Vec2, 3> p;
      for (std::uint32_t i = 0; i < 3; ++i) {
        q[i] = out.positions[out.corner_position[begin + i]];
        p[i] = out.texcoords[out.corner_texcoord[begin + i]];
      }
      space.push_back(q);
      plane.push_back(p);
    }
    EXPECT_EQ(points.size() + faces.size(), edges.size() + 1) << "chart " << chart << " is no disc";
    for (const auto& [edge, count] : edges) EXPECT_LE(count, 2);
    EXPECT_EQ(result->charts[chart].faces, faces.size());
    if (space.size() != faces.size() || result->surface.turned_faces > 0 ||
        result->charts[chart].area < 1e-15) {  // a line but for rounding: a dot
      continue;
    }
    for (const Vec2 uv : out.texcoords) EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
    const double l2 = slow_l2(space, plane);
    if (options.max_charts == 0) {
      EXPECT_LE(l2, options.max_stretch * (1 + 1e-9));
    }
    EXPECT_NEAR(l2, result->charts[chart].distortion.l2, 1e-6 * l2);
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const double a3 = length(cross(space[i][1] - space[i][0], space[i][2] - space[i][0]));
      if (a3 > 0) {
        EXPECT_GT(signed_area2(plane[i][0], plane[i][1], plane[i][2]), 0);
      }
    }
  }
  return *std::move(result);
}

TEST(Unwrap, ASheetIsOneChartWithoutStretch) {
  for (const bool quads : {false, true}) {
    const Unwrapping u = expect_unwrapped(test::sheet(12, quads));
    ASSERT_EQ(u.charts.size(), 1U);
    EXPECT_NEAR(u.charts[0].distortion.linf, 1, 1e-6);
  }
}

TEST(Unwrap, FewChartsOfRoundThings) {
  EXPECT_LE(expect_unwrapped(test::ball(16)).charts.size(), 3U);
  EXPECT_LE(expect_unwrapped(test::torus(16)).charts.size(), 4U);
  EXPECT_LE(expect_unwrapped(test::tube(16, 4)).charts.size(), 1U);
  EXPECT_LE(expect_unwrapped(test::ball(16, 8)).charts.size(), 3U);
  EXPECT_LE(expect_unwrapped(test::torus(16, 0.3, true)).charts.size(), 4U);
}

TEST(Unwrap, LessStretchTakesMoreCharts) {
  UnwrapOptions options;
  options.max_stretch = 1.02;
  const std::size_t strict = expect_unwrapped(test::torus(16), options).charts.size();
  EXPECT_GT(strict, expect_unwrapped(test::torus(16)).charts.size());
  options.stretch = StretchMeasure::linf;
  options.max_stretch = 1.5;
  const Unwrapping u = expect_unwrapped(test::ball(10), options);
  for (const UnwrappedChart& chart : u.charts) EXPECT_LE(chart.distortion.linf, 1.5);
}

/// Sides of squares around the charts, as shares of the side of one with the area of all.
double largest_extent(const Unwrapping& u) {
  std::vector<std::vector<Vec2>> points(u.charts.size());
  double area = 0;
  for (std::uint32_t face = 0; face < u.mesh.face_count(); ++face) {
    for (std::uint32_t c = u.mesh.face_begin[face]; c < u.mesh.face_begin[face + 1]; ++c) {
      points[u.face_chart[face]].push_back(u.mesh.texcoords[u.mesh.corner_texcoord[c]]);
    }
  }
  for (const UnwrappedChart& chart : u.charts) area += chart.area;
  double largest = 0;
  for (const auto& chart : points) largest = std::max(largest, square_side(convex_hull(chart)));
  return largest / std::sqrt(area);
}

TEST(Unwrap, NoChartLongerThanAsked) {
  const Mesh tube = test::tube(8, 64);
  EXPECT_GT(largest_extent(expect_unwrapped(tube)), 2);
  for (const double most : {2.0, 1.2, 0.8}) {
    UnwrapOptions options;
    options.max_extent = most;
    EXPECT_LE(largest_extent(expect_unwrapped(tube, options)), most * (1 + 1e-9)) << most;
    options.max_charts = 1;  // joins no more than may be
    EXPECT_LE(largest_extent(expect_unwrapped(tube, options)), most * (1 + 1e-9)) << most;
  }
  UnwrapOptions options;
  options.max_extent = 0.01;  // a face is not cut
  EXPECT_EQ(expect_unwrapped(test::ball(4), options).charts.size(), test::ball(4).face_count());
}

TEST(Unwrap, AtMostSoManyCharts) {
  UnwrapOptions options;
  options.max_stretch = 1.02;
  options.max_charts = 4;
  EXPECT_LE(expect_unwrapped(test::torus(12), options).charts.size(), 4U);
}

TEST(Unwrap, BrokenMeshesLoseNoFace) {
  expect_unwrapped(test::moebius(16));
  expect_unwrapped(test::with_turned_faces(test::ball(6), 3));
  expect_unwrapped(test::both(test::ball(5), test::ball(5)));
  expect_unwrapped(test::both(test::ball(5), test::moved(test::sheet(5), {5, 0, 0})));
  expect_unwrapped(test::both(test::sheet(5), test::with_turned_faces(test::sheet(5), 1)));
  const Mesh odd = test::bare_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {1, 1, 0}, {3, 3, 3}},
      {{0, 3, 1}, {0, 0, 1}, {0, 1, 2}, {1, 4, 1, 2}, {2, 1, 4}, {5, 5, 5}, {0, 1, 5}, {1, 0, 5}});
  expect_unwrapped(odd);
}

/// A mesh after some accidents: faces lost, doubled, turned, points moved, points made one.
Mesh mutilated(const Mesh& mesh, std::mt19937_64& random) {
  std::vector<test::Face> faces;
  std::vector<Vec3> positions = mesh.positions;
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  const auto often = [&](int percent) { return random() % 100 < static_cast<unsigned>(percent); };
  const int lost = below(20), doubled = below(5), turned = below(30), moved = below(20),
            joined = below(6);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    test::Face face(mesh.corner_position.begin() + mesh.face_begin[f],
                    mesh.corner_position.begin() + mesh.face_begin[f + 1]);
    for (std::uint32_t& p : face) {
      if (often(joined)) p = below(positions.size());
    }
    if (often(turned)) std::reverse(face.begin(), face.end());
    if (often(doubled)) faces.push_back(face);
    if (!often(lost)) faces.push_back(face);
  }
  for (Vec3& p : positions) {
    if (!often(moved)) continue;
    for (double* x : {&p.x, &p.y, &p.z}) *x += test::uniform(random, -0.5, 0.5);
  }
  if (faces.empty()) faces.push_back({0, 1, 2});
  return test::bare_mesh(positions, faces);
}

TEST(Unwrap, WhateverHappenedToTheMesh) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    const Mesh whole = trial % 3 == 0   ? test::ball(7)
                       : trial % 3 == 1 ? test::torus(6, 0.4, trial % 2 == 0)
                                        : test::tube(7, 2);
    expect_unwrapped(mutilated(whole, random));
  }
}

TEST(Unwrap, AnySizeAndPlace) {
  for (const double size : {1e-12, 1e-3, 1e9}) {
    Mesh mesh = test::torus(8);
    for (Vec3& p : mesh.positions) p = size * p;
    EXPECT_EQ(expect_unwrapped(mesh).charts.size(), expect_unwrapped(test::torus(8)).charts.size());
  }
  expect_unwrapped(test::moved(test::torus(8), {1e5, -1e6, 1e4}));
}

TEST(Unwrap, FlatFacesAlone) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 9, 9}};
  const auto nothing = unwrap(test::bare_mesh(points, {{0, 1, 2}, {0, 2, 3}, {1, 1, 1}}));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().kind, ErrorKind::input);
  expect_unwrapped(test::bare_mesh(points, {{0, 1, 2}, {0, 2, 3}, {4, 5, 5}, {3, 4, 5}}));
}

TEST(Unwrap, FacesThatAreLinesButForRounding) {
  // Decimals on a line: as doubles they have areas of about 1e-17, of either sign in their plane.
  const Mesh slivers = test::bare_mesh({{1.1, 0.7, 0.3},
                                        {1.2, 0.9, 0.6},
                                        {1.3, 1.1, 0.9},
                                        {1.3, 2.2, 0.1},
                                        {1.4, 2.5, 0.3},
                                        {1.5, 2.8, 0.5}},
                                       {{0, 1, 2}, {3, 4, 5}});
  EXPECT_FALSE(unwrap(slivers));
  const Unwrapping u = expect_unwrapped(test::both(slivers, test::sheet(3)));
  for (const Vec2 uv : u.mesh.texcoords) EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
  EXPECT_EQ(u.surface.flat_faces, 2U);
  for (const UnwrappedChart& chart : u.charts) EXPECT_TRUE(chart.is_good);
}

TEST(Unwrap, NoStretchAtAllIsEnoughForFlatThings) {
  UnwrapOptions options;
  options.max_stretch = 1;
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> points;
    for (int i = 0; i < 3; ++i) {
      points.push_back({test::uniform(random, -1, 1), test::uniform(random, -1, 1),
                        test::uniform(random, -1, 1)});
    }
    const auto u = unwrap(test::bare_mesh(points, {{0, 1, 2}}), options);
    ASSERT_TRUE(u && u->charts[0].is_good);
  }
  EXPECT_EQ(expect_unwrapped(test::sheet(9), options).charts.size(), 1U);
}

TEST(Unwrap, SmallClosedThings) {
  const Mesh tetrahedron = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                           {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  EXPECT_LE(expect_unwrapped(tetrahedron).charts.size(), 2U);
}

TEST(Unwrap, APlateWithAHoleAsOneFace) {
  // A keyhole polygon: it uses the points of its slit twice.
  const Mesh plate = test::bare_mesh(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}},
      {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}});
  const auto u = unwrap(plate);
  ASSERT_TRUE(u) << u.error().message();
  EXPECT_EQ(u->surface.folded_faces, 1U);
  ASSERT_EQ(u->charts.size(), 1U);
  EXPECT_NEAR(u->charts[0].area, 12, 1e-12);
  EXPECT_NEAR(u->charts[0].border_length, 24 + 2 * std::sqrt(2), 1e-12);
}

TEST(Unwrap, WhatCannotBeJoinedStaysApart) {
  UnwrapOptions options;
  options.max_charts = 1;
  const Mesh two = test::both(test::sheet(3), test::moved(test::sheet(3), {9, 0, 0}));
  EXPECT_EQ(expect_unwrapped(two, options).charts.size(), 2U);
}

TEST(Unwrap, ThreadsChangeNothing) {
  UnwrapOptions one, four;
  one.threads = 1;
  four.threads = 4;
  const Mesh mesh = test::both(test::torus(12), test::moved(test::ball(12, 5), {9, 0, 0}));
  const auto a = unwrap(mesh, one), b = unwrap(mesh, four);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->mesh.texcoords, b->mesh.texcoords);
  EXPECT_EQ(a->mesh.corner_texcoord, b->mesh.corner_texcoord);
}

TEST(Unwrap, RefusesAndStops) {
  UnwrapOptions options;
  options.max_stretch = 0.5;
  EXPECT_EQ(unwrap(test::ball(4), options).error().kind, ErrorKind::usage);
  options.max_stretch = 2;
  options.max_extent = -1;
  EXPECT_EQ(unwrap(test::ball(4), options).error().kind, ErrorKind::usage);
  options.max_extent = 0;
  options.flatten.iterations = 0;
  EXPECT_EQ(unwrap(test::ball(4), options).error().kind, ErrorKind::usage);
  EXPECT_EQ(unwrap(Mesh{}).error().kind, ErrorKind::input);
  options.flatten.iterations = 2;
  options.progress = [](const UnwrapProgress&) { return false; };
  EXPECT_EQ(unwrap(test::ball(8), options).error().kind, ErrorKind::interrupted);
  // In the middle: it is not asked again. It is asked every 50 ms at most.
  Mesh many = test::ball(6);
  for (int i = 1; i < 20; ++i) many = test::both(many, test::moved(test::ball(6), {3.0 * i, 0, 0}));
  int calls = 0;
  options.progress = [&calls](const UnwrapProgress&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    return ++calls < 3;
  };
  options.threads = 1;
  EXPECT_EQ(unwrap(many, options).error().kind, ErrorKind::interrupted);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace wrapatlas
