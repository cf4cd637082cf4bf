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
  for (Vec3& p : mesh.positions) {
    p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
}

void expect_all_cuts_pass(const Mesh& mesh, int resolution, double padding, int cuts,
                          std::uint32_t seed) {
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

}  // namespace
}  // namespace wrapatlas
