// glTFs made from nothing but a mesh and an atlas.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/file.h"
#include "io/formats.h"
#include "unit/gltf_builder.h"

namespace wrapatlas {
namespace {

using namespace test;

/// A quad and a pentagon with UVs, and a triangle without.
Mesh polygons() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0},   {1, 1, 0}, {0, 1, 0},
                    {2, 0, 0}, {3, 0.5, 0}, {2, 1, 0}, {0, 0, 5}};
  mesh.texcoords = {{0, 0}};
  mesh.corner_position = {0, 1, 2, 3, 1, 4, 5, 6, 2, 0, 1, 7};
  mesh.face_begin = {0, 4, 9, 12};
  mesh.corner_texcoord.assign(9, 0);
  mesh.corner_texcoord.resize(12, kNone);
  return mesh;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto at = [&](std::size_t k) {
      return mesh.positions[mesh.corner_position[mesh.face_begin[f] + k]];
    };
    for (std::size_t k = 1; k + 1 < mesh.face_size(f); ++k) {
      area += 0.5 * length(cross(at(k) - at(0), at(k + 1) - at(0)));
    }
  }
  return area;
}

TEST(GltfNew, PolygonsBecomeTrianglesWithTheirUvs) {
  const Mesh mesh = polygons();
  for (const bool binary : {true, false}) {
    const auto path = output_path(binary ? "new.glb" : "new.gltf");
    const AtlasMesh atlas = atlas_with(mesh, [&](std::size_t f, std::size_t k) {
      const Vec3 p = mesh.positions[mesh.corner_position[mesh.face_begin[f] + k]];
      return Vec2{p.x / 4, p.y / 4 + (f == 1 ? 0.5 : 0)};
    });
    ASSERT_TRUE(write_new_gltf(path, mesh, atlas, binary));
    const auto read = read_gltf(*read_file(path), binary, "new", path, {});
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->mesh.face_count(), 2 + 3 + 1U);
    EXPECT_NEAR(area_of(read->mesh), area_of(mesh), 1e-6);
    EXPECT_EQ(read->mesh.corner_texcoord.back(), kNone);
    for (std::size_t c = 0; c < 15; ++c) {
      const Vec3 at = read->mesh.positions[read->mesh.corner_position[c]];
      const Vec2 uv = read->mesh.texcoords[read->mesh.corner_texcoord[c]];
      EXPECT_EQ(uv.x, at.x / 4);
      EXPECT_EQ(uv.y, at.y / 4 + (c >= 6 ? 0.5 : 0));
    }
    EXPECT_EQ(read->mesh.positions.size(), 4 + 5 + 3U) << "corners with equal UVs share vertices";
  }
}

TEST(GltfNew, CutFacesToo) {
  Mesh mesh = polygons();
  mesh.corner_position.resize(9);
  mesh.corner_texcoord.resize(9);
  mesh.corner_position.erase(mesh.corner_position.begin() + 3);  // the quad loses a corner
  mesh.corner_texcoord.pop_back();
  mesh.corner_position.resize(6);
  mesh.corner_texcoord.resize(6);
  mesh.face_begin = {0, 3, 6};
  const AtlasMesh atlas = midpoint_cut(mesh, [](std::size_t, std::size_t k) {
    return Vec2{static_cast<double>(k), 0};
  });
  const auto path = output_path("cut.glb");
  ASSERT_TRUE(write_new_gltf(path, mesh, atlas, true));
  const auto read = read_gltf(*read_file(path), true, "cut", path, {});
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->mesh.face_count(), 8U);
  EXPECT_NEAR(area_of(read->mesh), area_of(mesh), 1e-6);
}

TEST(GltfNew, AMeshForEachObject) {
  Mesh mesh = polygons();
  for (const auto& objects : {std::vector<std::uint32_t>{5, 2, 5}, {}}) {
    mesh.face_object = objects;
    const auto uv = [](std::size_t, std::size_t k) { return Vec2{static_cast<double>(k), 0}; };
    const auto path = output_path("objects.glb");
    ASSERT_TRUE(write_new_gltf(path, mesh, atlas_with(mesh, uv), true));
    const GltfFile file = reopen(path);
    const std::size_t count = objects.empty() ? 1 : 2;
    EXPECT_EQ(file.json["meshes"].size(), count);
    EXPECT_EQ(file.json["nodes"].size(), count);
    EXPECT_EQ(file.json["scenes"][0]["nodes"].size(), count);
    const auto read = read_gltf(*read_file(path), true, "objects", path, {});
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_NEAR(area_of(read->mesh), area_of(mesh), 1e-6);
    // The quad and the triangle without UVs are of object 5.
    EXPECT_EQ(read->mesh.face_object, objects.empty()
                                          ? std::vector<std::uint32_t>{}
                                          : (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1}));
  }
}

TEST(GltfNew, NoFacesIsAnError) {
  EXPECT_FALSE(write_new_gltf(output_path("none.glb"), Mesh{}, AtlasMesh{}, true));
}

}  // namespace
}  // namespace wrapatlas
