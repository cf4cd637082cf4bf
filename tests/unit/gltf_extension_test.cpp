// Extensions that hold the geometry once more.
#include <gtest/gtest.h>

#include "io/formats.h"
#include "unit/gltf_builder.h"

namespace wrapatlas {
namespace {

using namespace test;

GltfBuilder cube() {
  GltfBuilder builder;
  const auto p = builder.positions(kCubePositions);
  const auto uv = builder.accessor(std::vector<float>(16, 0.5F), 2);
  const auto i = builder.accessor(kCubeIndices, 1);
  builder.primitive(0, {{"POSITION", p}, {"TEXCOORD_0", uv}}, static_cast<int>(i));
  return builder;
}

/// Saved with UVs that split vertices, or with ones that do not.
Json saved(const GltfBuilder& builder, const std::string& name, bool split) {
  const auto model = read_gltf(builder.glb(), true, "in.glb", "/nonexistent/in", {});
  EXPECT_TRUE(model) << model.error().message();
  if (!model) return {};
  const AtlasMesh atlas = atlas_with(model->mesh, [&](std::size_t f, std::size_t) {
    return Vec2{0.25, split ? static_cast<double>(f) / 16 : 0.5};
  });
  EXPECT_TRUE(model->source->save(output_path(name), model->mesh, atlas));
  return reopen(output_path(name)).json;
}

TEST(GltfExtensions, OptionalMeshoptIsReplacedByItsFallback) {
  GltfBuilder builder = cube();
  const auto packed = builder.view("compressed bytes");
  builder.json["extensionsUsed"] = {"EXT_meshopt_compression"};
  builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0},      {"byteOffset", builder.json["bufferViews"][packed]["byteOffset"]},
      {"byteLength", 16}, {"byteStride", 12},
      {"count", 8},       {"mode", "ATTRIBUTES"}};
  const Json json = saved(builder, "meshopt.glb", true);
  EXPECT_EQ(json.dump().find("meshopt"), std::string::npos);
  EXPECT_FALSE(json.contains("extensionsUsed"));
}

TEST(GltfExtensions, TopologyCopiesGoWhenIndicesChange) {
  GltfBuilder builder = cube();
  builder.json["extensionsUsed"] = {"EXT_mesh_manifold"};
  builder.json["meshes"][0]["extensions"]["EXT_mesh_manifold"] = {
      {"manifoldPrimitive", {{"attributes", {{"POSITION", 0}}}, {"indices", 2}}}};
  EXPECT_TRUE(saved(builder, "kept.glb", false)["meshes"][0].contains("extensions"));
  const Json json = saved(builder, "dropped.glb", true);
  EXPECT_FALSE(json["meshes"][0].contains("extensions"));
  EXPECT_FALSE(json.contains("extensionsUsed"));
}

TEST(GltfExtensions, ViewsInTheMiddleShrinkWhenNothingTakesTheirPlace) {
  GltfBuilder builder = cube();
  // More dead views than new ones, and a live image behind them.
  for (int i = 0; i < 6; ++i) builder.view(std::string(500, 'd'));
  const auto packed = builder.view(std::string(5000, 'd'));
  const auto image = builder.view("image bytes");
  builder.json["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
  builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", packed}, {"more", {3, 4, 5, 6, 7, 8}}};
  const auto model = read_gltf(builder.glb(), true, "in.glb", "/nonexistent/in", {});
  ASSERT_TRUE(model) << model.error().message();
  const AtlasMesh atlas = atlas_with(model->mesh, [](std::size_t, std::size_t) {
    return Vec2{0, 1};
  });
  const auto path = output_path("shrunk.bin.glb");
  ASSERT_TRUE(model->source->save(path, model->mesh, atlas));
  const GltfFile file = reopen(path);
  EXPECT_LT(file.buffers[0].bytes.size(), 700U);
  const Json& view = file.json["bufferViews"][image];
  EXPECT_EQ(file.buffers[0].bytes.substr(view["byteOffset"].get<std::size_t>(), 11), "image bytes");
}

}  // namespace
}  // namespace wrapatlas
