// Meshes of a glTF as its nodes place them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/model_files.h"
#include "wrapatlas/model.h"

namespace wrapatlas {
namespace {

using Json = nlohmann::json;

/// One triangle (0,0,0) (1,0,0) (0,1,0), with its normal, in a mesh that the nodes name.
std::string with_nodes(const Json& nodes, const Json& roots) {
  // Floats 0 0 0 1 0 0 0 1 0, and three times 0 0 1.
  const std::string data =
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
      "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/";
  Json json = {
      {"asset", {{"version", "2.0"}}},
      {"buffers", {{{"byteLength", 72}, {"uri", "data:application/octet-stream;base64," + data}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", 36}},
        {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 36}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"min", {0, 0, 0}},
         {"max", {1, 1, 0}}},
        {{"bufferView", 1}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}}}},
      {"nodes", nodes},
      {"scenes", {{{"nodes", roots}}}},
      {"scene", 0}};
  return json.dump();
}

Result<Model> in_scene(const Json& nodes, const Json& roots) {
  LoadOptions options;
  options.in_scene = options.shading = options.may_add_set = true;
  return load_model_bytes(with_nodes(nodes, roots), FileFormat::gltf, "m", {}, options);
}

Vec3 corner(const Model& model, std::size_t c) {
  return model.mesh.positions[model.mesh.corner_position[c]];
}

TEST(GltfScene, NodesPlaceTheirMeshes) {
  const auto model = in_scene({{{"mesh", 0}, {"translation", {5, 0, 0}}},
                               {{"children", {2}}, {"scale", {2, 3, 1}}},
                               {{"mesh", 0}, {"translation", {0, 1, 0}}}},
                              {0, 1});
  ASSERT_TRUE(model) << model.error().message();
  ASSERT_EQ(model->mesh.face_count(), 2U);
  EXPECT_EQ(corner(*model, 1), (Vec3{6, 0, 0}));
  EXPECT_EQ(corner(*model, 3), (Vec3{0, 3, 0}));
  EXPECT_EQ(corner(*model, 4), (Vec3{2, 3, 0}));
  EXPECT_EQ(corner(*model, 5), (Vec3{0, 6, 0}));
  EXPECT_EQ(model->corner_normal[3], (Vec3{0, 0, 1}));
  EXPECT_NE(model->mesh.face_object[0], model->mesh.face_object[1]);
}

TEST(GltfScene, RotationsAndMatrices) {
  const double half = std::sqrt(0.5);  // a quarter turn about x: y becomes z
  const auto turned = in_scene({{{"mesh", 0}, {"rotation", {half, 0, 0, half}}}}, {0});
  ASSERT_TRUE(turned);
  EXPECT_LT(length(corner(*turned, 2) - Vec3{0, 0, 1}), 1e-12);
  EXPECT_LT(length(turned->corner_normal[0] - Vec3{0, -1, 0}), 1e-12);
  const auto same =
      in_scene({{{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 7, 8, 9, 1}}}}, {0});
  ASSERT_TRUE(same);
  EXPECT_LT(length(corner(*same, 2) - Vec3{7, 8, 10}), 1e-12);
}

TEST(GltfScene, MirroredMeshesKeepTheirOutside) {
  const auto model = in_scene({{{"mesh", 0}, {"scale", {-1, 1, 1}}}}, {0});
  ASSERT_TRUE(model);
  const Vec3 a = corner(*model, 0), b = corner(*model, 1), c = corner(*model, 2);
  EXPECT_GT(dot(cross(b - a, c - a), model->corner_normal[0]), 0);
  EXPECT_EQ(model->corner_normal[0], (Vec3{0, 0, 1}));
}

TEST(GltfScene, NodesInACircleAreRefused) {
  EXPECT_FALSE(in_scene({{{"mesh", 0}, {"children", {1}}}, {{"children", {0}}}}, {0}));
  // Without nodes that have meshes the file shows what it holds.
  const auto bare = in_scene(Json::array({Json::object()}), {0});
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->mesh.face_count(), 1U);
}

}  // namespace
}  // namespace wrapatlas
