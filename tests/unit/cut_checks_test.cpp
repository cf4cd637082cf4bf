// Whatever a packing is cut into, the judge finds the mesh in it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "bumpy_cube.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/model.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {
namespace {

Packing packed(const ChartSet& charts, int resolution, double padding) {
  PackOptions options;
  options.method = Method::modulo;
  options.width = options.height = resolution;
  options.padding = padding;
  options.grid = 64;
  options.rotations = 4;
  auto packing = pack(charts.charts, options);
  EXPECT_TRUE(packing) << (packing ? "" : packing.error().message());
  return packing ? std::move(*packing) : Packing{};
}

/// On the torus everything may move together. Here some vertex comes to lie next to the border,
/// from a billionth of a texel to several texels beside it.
Packing shifted(Packing packing, const ChartSet& charts, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto pick = [&](std::size_t count) { return random() % count; };
  Vec2 shift;
  for (const int axis : {0, 1}) {
    const std::size_t chart = pick(charts.charts.size());
    const std::vector<Vec2>& points = charts.charts[chart].points;
    const Vec2 at = packing.transform(chart).apply(points[pick(points.size())]);
    const double beside = (unit(random) < 0.5 ? -1 : 1) * std::pow(10, 10 * unit(random) - 9);
    (axis == 0 ? shift.x : shift.y) = beside - (axis == 0 ? at.x : at.y);
  }
  for (Placement& placement : packing.placements) {
    placement.translation = placement.translation + shift;
  }
  return packing;
}

void round_positions(Mesh& mesh) {
  std::vector<float> stored;  // by way of memory: see round_texcoords_to_float
  for (const Vec3& p : mesh.positions) {
    for (const double x : {p.x, p.y, p.z}) stored.push_back(static_cast<float>(x));
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.positions[i] = {stored[3 * i], stored[3 * i + 1], stored[3 * i + 2]};
  }
}

void expect_all_cuts_pass(const Mesh& mesh, int resolution, double padding, int cuts,
                          std::uint32_t seed, bool floats_too = true) {
  const auto charts = build_charts(mesh);
  ASSERT_TRUE(charts) << charts.error().message();
  const Packing packing = packed(*charts, resolution, padding);
  std::mt19937 random(seed);
  CheckOptions options;
  options.width = options.height = resolution;
  options.padding = padding;
  options.wrap = Wrap::none;
  for (int i = 0; i < cuts; ++i) {
    AtlasMesh atlas = export_cut(mesh, *charts, shifted(packing, *charts, random));
    round_texcoords_to_float(atlas);
    Mesh cut = apply_atlas(mesh, atlas);
    for (const bool as_floats : {false, true}) {
      if (as_floats && !floats_too) continue;
      if (as_floats) round_positions(cut);
      const auto report = check_atlas(cut, &mesh, options);
      ASSERT_TRUE(report) << report.error().message() << ", cut " << i;
      ASSERT_TRUE(report->ok()) << report->findings[0].text << ", cut " << i;
      ASSERT_EQ(report->charts, charts->charts.size());
    }
  }
}

TEST(CutChecks, BumpyCubes) {
  for (int kind = 0; kind < 4; ++kind) {
    SCOPED_TRACE(kind);
    expect_all_cuts_pass(test::cube(5, kind, 7 + kind), 256, 2, 25, 1 + kind);
  }
}

TEST(CutChecks, FarFromTheOrigin) {
  for (int kind = 0; kind < 4; ++kind) {
    SCOPED_TRACE(kind);
    Mesh mesh = test::cube(3, kind, 70 + kind);
    for (Vec3& p : mesh.positions) p = p + Vec3{3000, -500, 0};
    expect_all_cuts_pass(mesh, 2048, 1, 15, 5 + kind);
  }
}

/// Flat faces in a square grid of two charts that alternate: their sides lie along the border.
TEST(CutChecks, FlatGrids) {
  for (const bool as_triangles : {false, true}) {
    test::MeshBuilder b;
    for (std::uint32_t i = 0; i < 6; ++i) {
      for (std::uint32_t j = 0; j < 6; ++j) {
        const double x = i, y = j, aside = j % 2 ? 20 : 0;
        const std::array<Vec2, 4> square{{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
        std::vector<test::MeshBuilder::Corner> corners;
        for (const Vec2 p : square) {
          corners.push_back({b.position({p.x, p.y, 0}), b.texcoord({p.x + aside, p.y})});
        }
        if (as_triangles) {
          b.face({corners[0], corners[1], corners[2]});
          b.face({corners[0], corners[2], corners[3]});
        } else {
          b.face(corners);
        }
      }
    }
    expect_all_cuts_pass(b.mesh, 512, 1, 60, 11);
  }
}

TEST(CutChecks, Samples) {
  const std::filesystem::path samples = std::filesystem::path(WRAPATLAS_SOURCE_DIR) / "samples";
  for (const char* name : {"coral.glb", "mosaic.ply", "machine.obj"}) {
    SCOPED_TRACE(name);
    const auto model = load_model(samples / name);
    ASSERT_TRUE(model) << model.error().message();
    std::uint32_t seed = 21;
    for (const int resolution : {512, 1024, 4096}) {
      expect_all_cuts_pass(model->mesh, resolution, resolution / 256.0, 3, seed++);
    }
  }
}

/// Faces of 3 to 8 corners that nobody would draw: crossing themselves in the texture or in space,
/// with corners that coincide there, or without area.
Mesh odd_faces(std::mt19937& random, Vec3 origin, double unit) {
  std::uniform_real_distribution<double> angle(0, 6.28);
  const auto on_grid = [&] { return static_cast<double>(random() % 7); };
  test::MeshBuilder b;
  const std::size_t faces = 1 + random() % 4;
  for (std::size_t i = 0; i < faces; ++i) {
    const double aside = 20.0 * static_cast<double>(i);
    const bool star = random() % 2 == 0;
    const std::size_t count = 3 + random() % 6;
    std::vector<double> angles(count);
    for (double& a : angles) a = angle(random);
    std::sort(angles.begin(), angles.end());
    std::vector<test::MeshBuilder::Corner> corners;
    for (const double a : angles) {
      const double radius = 1 + static_cast<double>(random() % 3);
      const Vec2 uv = star ? radius * Vec2{std::cos(a), std::sin(a)} : Vec2{on_grid(), on_grid()};
      const Vec3 at{aside + on_grid(), on_grid(), on_grid()};
      corners.push_back({b.position(origin + unit * at), b.texcoord(uv + Vec2{aside, 0})});
    }
    b.face(corners);
  }
  return b.mesh;
}

void expect_odd_faces_pass(Vec3 origin, double unit, bool floats_too) {
  std::mt19937 random(17);
  for (int round = 0; round < 60; ++round) {
    const Mesh mesh = odd_faces(random, origin, unit);
    const auto charts = build_charts(mesh);
    if (!charts || !(charts->total_area() > 1)) continue;
    SCOPED_TRACE(round);
    expect_all_cuts_pass(mesh, 256, 2, 2, round, floats_too);
  }
}

TEST(CutChecks, OddFaces) { expect_odd_faces_pass({0, 0, 0}, 1, true); }

TEST(CutChecks, OddFacesFarFromTheOrigin) {
  expect_odd_faces_pass({451234, 5412345, 120}, 1, false);
  expect_odd_faces_pass({451234, 5412345, 120}, 0.05, false);
  expect_odd_faces_pass({1e9, -1e11, 0}, 1, false);
}

/// Five centimetres in a national grid: where doubles are kept, all is known to the last texel.
TEST(CutChecks, FarFromTheOriginButExact) {
  test::MeshBuilder b;
  const auto corner = [&](double x, double y) {
    return test::MeshBuilder::Corner{b.position({451234 + 0.05 * x, 5412345 + 0.05 * y, 120}),
                                     b.texcoord({x, y})};
  };
  for (int i = 0; i < 8; ++i) {
    b.face({corner(i, 0), corner(i + 1, 0), corner(i, 1)});
    b.face({corner(i + 1, 0), corner(i + 1, 1), corner(i, 1)});
  }
  expect_all_cuts_pass(b.mesh, 512, 2, 10, 3);
  const auto charts = build_charts(b.mesh);
  std::mt19937 random(4);
  AtlasMesh atlas = export_cut(b.mesh, *charts, shifted(packed(*charts, 512, 2), *charts, random));
  ASSERT_TRUE(atlas.is_cut());
  round_texcoords_to_float(atlas);
  CheckOptions options;
  options.width = options.height = 512;
  std::size_t cut_corners = 0;
  for (std::size_t c = 0; c < atlas.corner_cut.size(); ++c) {
    if (atlas.corner_cut[c] == kNone) continue;
    ++cut_corners;
    Mesh moved = apply_atlas(b.mesh, atlas);
    Vec2& uv = moved.texcoords[moved.corner_texcoord[c]];
    uv.y = uv.y + (uv.y < 0.5 ? 1 : -1) * 0.25 / 512;
    const auto report = check_atlas(moved, &b.mesh, options);
    EXPECT_FALSE(report && report->ok()) << "corner " << c;
  }
  EXPECT_GT(cut_corners, 4U);
}

}  // namespace
}  // namespace wrapatlas
