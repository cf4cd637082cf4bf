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

/// The cube with each of its views in a buffer of its own, the UVs' in the last one, and with UVs
/// that make no vertices; saved as text.
Json saved_from_buffers(GltfBuilder builder, const std::string& name) {
  Json& json = builder.json;
  const Json views = json["bufferViews"];
  const std::size_t places[] = {0, 2, 1};
  for (std::size_t b = 0; b < views.size(); ++b) {
    const auto begin = views[places[b]]["byteOffset"].get<std::size_t>();
    const auto length = views[places[b]]["byteLength"].get<std::size_t>();
    json["buffers"].push_back({{"byteLength", length},
                               {"uri", "data:application/octet-stream;base64," +
                                           base64_encode(builder.bin.substr(begin, length))}});
    json["bufferViews"][places[b]]["buffer"] = b;
    json["bufferViews"][places[b]]["byteOffset"] = 0;
  }
  const auto model = read_gltf(json.dump(), false, "in.gltf", "/nonexistent/in", {});
  EXPECT_TRUE(model) << model.error().message();
  if (!model) return {};
  const AtlasMesh atlas = atlas_with(model->mesh, [](std::size_t, std::size_t) {
    return Vec2{0.25, 0.5};
  });
  EXPECT_TRUE(model->source->save(output_path(name), model->mesh, atlas));
  return reopen(output_path(name)).json;
}

TEST(GltfBuffers, EmptyOnesAtTheEndGo) {
  const Json json = saved_from_buffers(cube(), "emptied.gltf");
  ASSERT_EQ(json["buffers"].size(), 2U);
  EXPECT_EQ(json["buffers"][0]["byteLength"], 96 + 64);
  EXPECT_EQ(json["buffers"][1]["byteLength"], 72);
}

TEST(GltfBuffers, EmptyOnesThatAnExtensionMayNameStay) {
  GltfBuilder builder = cube();
  builder.json["extensions"]["VENDOR_something"] = {{"number", 2}};
  const Json json = saved_from_buffers(builder, "named.gltf");
  ASSERT_EQ(json["buffers"].size(), 3U);
  EXPECT_EQ(json["buffers"][2]["byteLength"], 4);
}

TEST(GltfExtensions, FallbackBuffersGoWithTheCompression) {
  GltfBuilder builder = cube();
  Json& json = builder.json;
  const std::string packed(16, 'c');
  const auto uri = [](const std::string& bytes) {
    return "data:application/octet-stream;base64," + base64_encode(bytes);
  };
  json["buffers"] = {{{"byteLength", 16}, {"uri", uri(packed)}},
                     {{"byteLength", builder.bin.size()},
                      {"uri", uri(builder.bin)},
                      {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  for (Json& view : json["bufferViews"]) {
    view["buffer"] = 1;
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteLength", 16},
                                                     {"byteStride", 12},
                                                     {"count", 8},
                                                     {"mode", "ATTRIBUTES"}};
  }
  json["extensionsUsed"] = {"EXT_meshopt_compression"};
  const auto model = read_gltf(json.dump(), false, "in.gltf", "/nonexistent/in", {});
  ASSERT_TRUE(model) << model.error().message();
  const AtlasMesh atlas = midpoint_cut(model->mesh, [](std::size_t f, std::size_t k) {
    return Vec2{static_cast<double>(f) / 16, static_cast<double>(k) / 4};
  });
  ASSERT_TRUE(model->source->save(output_path("fallback.gltf"), model->mesh, atlas));
  const Json after = reopen(output_path("fallback.gltf")).json;
  EXPECT_EQ(after["buffers"].size(), 1U);
  EXPECT_EQ(after.dump().find("meshopt"), std::string::npos);
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
