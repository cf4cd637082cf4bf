#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "io/file.h"
#include "io/formats.h"
#include "unit/gltf_builder.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;
using namespace test;

Model load(const GltfBuilder& builder) {
  Result<Model> model = read_gltf(builder.glb(), true, "in.glb", "/nonexistent/in.glb", {});
  EXPECT_TRUE(model) << model.error().message();
  return model ? *std::move(model) : Model{};
}

/// Faces alternate between two places of the texture, so shared vertices split.
Vec2 alternating(std::size_t face, std::size_t corner) {
  return {0.25 * static_cast<double>(corner) + 0.001, face % 2 == 0 ? 0.1 : 0.7};
}

void expect_uvs(const Mesh& mesh, const AtlasMesh& atlas) {
  ASSERT_EQ(mesh.corner_count(), atlas.corner_texcoord.size());
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    ASSERT_EQ(mesh.corner_texcoord[c] == kNone, atlas.corner_texcoord[c] == kNone);
    if (mesh.corner_texcoord[c] == kNone) continue;
    const Vec2 exact = atlas.texcoords[atlas.corner_texcoord[c]];
    const Vec2 read = mesh.texcoords[mesh.corner_texcoord[c]];
    // Through memory: g++ 12 -O3 folds a vectorised double -> float -> double to nothing.
    const volatile float u = static_cast<float>(exact.x), v = static_cast<float>(exact.y);
    ASSERT_EQ(read, (Vec2{u, v})) << "corner " << c;
  }
}

/// The bytes of an attribute at corner `i` of an indexed or plain list of triangles.
std::string bytes_at(const GltfFile& file, const Json& primitive, const Json& attribute,
                     std::size_t i) {
  if (const Json* indices = find_member(primitive, "indices")) {
    const auto opened = open_accessor(file, *as_integer(*indices));
    std::vector<std::uint32_t> vertices;
    EXPECT_TRUE(read_indices(file, *opened, 1U << 30U, 0, vertices));
    i = vertices[i];
  }
  const auto accessor = open_accessor(file, *as_integer(attribute));
  EXPECT_TRUE(accessor) << accessor.error().message();
  return {accessor->element(i), accessor->element_size};
}

/// All attributes but TEXCOORD_0, and all morph targets, are the same at every corner.
void expect_same_attributes(const GltfFile& before, const GltfFile& after) {
  for (std::size_t m = 0; m < before.json["meshes"].size(); ++m) {
    const Json& olds = before.json["meshes"][m]["primitives"];
    for (std::size_t p = 0; p < olds.size(); ++p) {
      const Json& old_primitive = olds[p];
      const Json& new_primitive = after.json["meshes"][m]["primitives"][p];
      const std::size_t corners =
          old_primitive.contains("indices")
              ? before.json["accessors"][old_primitive["indices"].get<std::size_t>()]["count"]
                    .get<std::size_t>()
              : 3;
      for (std::size_t c = 0; c < corners; ++c) {
        for (const auto& [name, index] : old_primitive["attributes"].items()) {
          if (name == "TEXCOORD_0") continue;
          ASSERT_EQ(bytes_at(before, old_primitive, index, c),
                    bytes_at(after, new_primitive, new_primitive["attributes"][name], c))
              << name << " of corner " << c;
        }
        const Json& targets = array_member(old_primitive, "targets");
        for (std::size_t t = 0; t < targets.size(); ++t) {
          for (const auto& [name, index] : targets[t].items()) {
            ASSERT_EQ(bytes_at(before, old_primitive, index, c),
                      bytes_at(after, new_primitive, new_primitive["targets"][t][name], c));
          }
        }
      }
    }
  }
}

GltfFile opened(const GltfBuilder& builder) {
  return *open_gltf(builder.glb(), true, "in.glb", "/nonexistent/in.glb");
}

/// A cube with every kind of attribute, a skin, morph targets (one sparse) and an animation.
GltfBuilder rich_cube() {
  GltfBuilder b;
  std::vector<float> uvs, normals, tangents, weights, moved, zeros(24, 0.0F);
  std::vector<std::uint8_t> joints, colors;
  std::vector<std::uint16_t> feature;
  for (std::size_t v = 0; v < 8; ++v) {
    const auto f = static_cast<float>(v);
    uvs.insert(uvs.end(), {f / 8, 1 - f / 8});
    normals.insert(normals.end(), {v % 2 != 0U ? 0.6F : -0.6F, 0.0F, 0.8F});
    tangents.insert(tangents.end(), {0.0F, 1.0F, 0.0F, v % 2 != 0U ? 1.0F : -1.0F});
    joints.insert(joints.end(),
                  {static_cast<std::uint8_t>(v % 2), static_cast<std::uint8_t>(1 - v % 2), 0, 0});
    weights.insert(weights.end(), {0.75F, 0.25F, 0, 0});
    for (int k = 0; k < 3; ++k) colors.push_back(static_cast<std::uint8_t>(30 * v));
    moved.insert(moved.end(), {0, f / 10, 0});
    feature.push_back(static_cast<std::uint16_t>(v));
  }
  const auto p = b.positions(kCubePositions);
  const auto target = b.positions(moved), sparse = b.positions(zeros);
  const auto at = b.accessor<std::uint8_t>({2, 5}, 1);
  const auto values = b.accessor<float>({1, 0, 0, 0, 0, 2}, 3);
  Json& accessors = b.json["accessors"];
  accessors[sparse].erase("bufferView");
  accessors[sparse]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", accessors[at]["bufferView"]}, {"componentType", 5121}}},
      {"values", {{"bufferView", accessors[values]["bufferView"]}}}};
  accessors[sparse]["max"] = {1, 0, 2};
  const Json attributes = {{"POSITION", p},
                           {"NORMAL", b.accessor(normals, 3)},
                           {"TANGENT", b.accessor(tangents, 4)},
                           {"TEXCOORD_0", b.accessor(uvs, 2)},
                           {"TEXCOORD_1", b.accessor(uvs, 2)},
                           {"COLOR_0", b.accessor(colors, 3, true)},
                           {"JOINTS_0", b.accessor(joints, 4)},
                           {"WEIGHTS_0", b.accessor(weights, 4)},
                           {"_HEAT", b.accessor(feature, 1)}};
  Json& view = b.json["bufferViews"].back();
  std::string spread;  // scalars of vertices take 4 bytes too
  for (const std::uint16_t value : feature)
    spread += std::string{static_cast<char>(value), 0, 0, 0};
  view = b.json["bufferViews"][b.view(spread, 4)];
  b.json["bufferViews"].erase(b.json["bufferViews"].size() - 1);
  Json& primitive = b.primitive(0, attributes, static_cast<int>(b.accessor(kCubeIndices, 1)));
  primitive["targets"] = {{{"POSITION", target}}, {{"POSITION", sparse}}};
  b.json["nodes"][0]["skin"] = 0;
  b.json["nodes"].push_back({{"name", "joint"}, {"children", {2}}});
  b.json["nodes"].push_back({{"name", "other"}});
  b.json["scenes"][0]["nodes"] = {0, 1};
  b.json["skins"] = {{{"joints", {1, 2}}}};
  const auto times = b.accessor<float>({0, 1}, 1);
  b.json["accessors"][times]["min"] = {0};
  b.json["accessors"][times]["max"] = {1};
  const auto morph = b.accessor<float>({0, 0, 1, 1}, 1);
  b.json["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
       {"samplers", {{{"input", times}, {"output", morph}}}}}};
  return b;
}

TEST(GltfWrite, SplitVerticesKeepAllAttributesAndTargets) {
  const GltfBuilder builder = rich_cube();
  const Model model = load(builder);
  const AtlasMesh atlas = atlas_with(model.mesh, alternating);
  const auto after = save_and_reload(model, atlas, "rich.glb");
  ASSERT_TRUE(after) << after.error().message();
  expect_uvs(after->mesh, atlas);
  expect_same_attributes(opened(builder), reopen(output_path("rich.glb")));
}

/// Accessors without views are all zeros; the first views are then those that saving makes.
TEST(GltfWrite, AFileWithoutViewsGetsSome) {
  GltfBuilder builder;
  builder.json["accessors"] = Json::parse(R"([
    {"componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]},
    {"componentType": 5126, "count": 8, "type": "VEC2"}])");
  builder.primitive(0, {{"POSITION", 0}, {"TEXCOORD_0", 1}}, -1, 5);
  const Model model = load(builder);
  const AtlasMesh atlas = atlas_with(model.mesh, alternating);
  const auto after = save_and_reload(model, atlas, "no_views.glb");
  ASSERT_TRUE(after) << after.error().message();
  EXPECT_EQ(after->mesh.face_count(), 6U);
  expect_uvs(after->mesh, atlas);
}

TEST(GltfWrite, NoSplitKeepsEveryOtherAccessor) {
  const GltfBuilder builder = rich_cube();
  const Model model = load(builder);
  const AtlasMesh atlas = atlas_with(model.mesh, [&](std::size_t f, std::size_t k) {
    return 0.5 * model.mesh.texcoords[model.mesh.corner_texcoord[3 * f + k]];
  });
  ASSERT_TRUE(model.source->save(output_path("same.glb"), model.mesh, atlas));
  const GltfFile after = reopen(output_path("same.glb"));
  EXPECT_EQ(after.json["meshes"], builder.json["meshes"])
      << "the new UVs take the place of the old";
  const auto uv =
      builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"].get<std::size_t>();
  EXPECT_EQ(after.json["accessors"].size(), builder.json["accessors"].size());
  for (std::size_t i = 0; i < after.json["accessors"].size(); ++i) {
    if (i == uv) continue;
    EXPECT_EQ(after.json["accessors"][i], builder.json["accessors"][i]);
  }
  EXPECT_LE(after.buffers[0].bytes.size(), builder.bin.size() + 8) << "the old UVs are gone";
  expect_same_attributes(opened(builder), after);
}

TEST(GltfWrite, UnknownMembersExtensionsAndExtrasStayInTheirOrder) {
  GltfBuilder builder = rich_cube();
  builder.json["zebra"] = Json::parse(R"({"z": 1, "a": [1.5, "x", null], "m": {"b": 2, "a": 1}})");
  builder.json["extensionsUsed"] = {"VENDOR_thing"};
  builder.json["extensions"] =
      Json::parse(R"({"VENDOR_thing": {"accessor": 1, "text": "\u00e9"}})");
  builder.json["extras"] = Json::parse(R"({"q": 1, "b": {"y": true, "x": false}})");
  builder.json["cameras"] =
      Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01}}])");
  builder.json["accessors"][0]["extras"] = Json::parse(R"({"made": "by hand"})");
  builder.json["meshes"][0]["primitives"][0]["extras"] = {{"k", 1}};
  const Model model = load(builder);
  const auto after = save_and_reload(model, atlas_with(model.mesh, alternating), "extras.glb");
  ASSERT_TRUE(after) << after.error().message();
  Json json = reopen(output_path("extras.glb")).json;
  for (const char* key :
       {"zebra", "extensions", "extensionsUsed", "extras", "cameras", "nodes", "skins"}) {
    EXPECT_EQ(json[key].dump(), builder.json[key].dump()) << key;
  }
  EXPECT_EQ(json["meshes"][0]["primitives"][0]["extras"]["k"], 1);
  std::vector<std::string> before_keys, after_keys;
  for (const auto& item : builder.json.items()) before_keys.push_back(item.key());
  for (const auto& item : json.items()) {
    if (item.key() != "buffers") after_keys.push_back(item.key());
  }
  EXPECT_EQ(after_keys, before_keys);
  // The extension may mean accessor 1 (a morph target): it has to be what it was.
  EXPECT_EQ(json["accessors"][1]["count"], 8);
  EXPECT_EQ(json["accessors"][0]["count"].get<int>() > 8, true);
  EXPECT_EQ(json["accessors"][0]["extras"]["made"], "by hand");
}

TEST(GltfWrite, UnknownChunksStay) {
  const GltfBuilder builder = rich_cube();
  std::string bytes = builder.glb();
  bytes += std::string("\x04\0\0\0WHAT1234", 12);
  const std::uint32_t size = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data() + 8, &size, 4);
  const auto model = read_gltf(bytes, true, "in.glb", "/nonexistent/in.glb", {});
  ASSERT_TRUE(model);
  ASSERT_TRUE(model->source->save(output_path("chunk.glb"), model->mesh,
                                  atlas_with(model->mesh, alternating)));
  EXPECT_TRUE(
      read_file(output_path("chunk.glb"))->ends_with(std::string("\x04\0\0\0WHAT1234", 12)));
}

TEST(GltfWrite, SharedAccessorsOfTwoPrimitives) {
  GltfBuilder builder;
  const Grid grid(8);
  const Json attributes = {{"POSITION", builder.positions(grid.positions)},
                           {"TEXCOORD_0", builder.accessor(grid.uvs, 2)}};
  const auto middle = grid.indices.begin() + 192;
  const auto one = builder.accessor(std::vector<std::uint32_t>(grid.indices.begin(), middle), 1);
  const auto two = builder.accessor(std::vector<std::uint32_t>(middle, grid.indices.end()), 1);
  builder.primitive(0, attributes, static_cast<int>(one));
  builder.primitive(0, attributes, static_cast<int>(two));
  const auto whole = builder.accessor(grid.indices, 1);
  builder.primitive(1, attributes, static_cast<int>(whole));
  builder.primitive(2, {{"POSITION", 0}}, static_cast<int>(whole), 1);  // lines
  const Model model = load(builder);
  const AtlasMesh atlas = atlas_with(model.mesh, [&](std::size_t f, std::size_t k) {
    const Vec2 uv = model.mesh.texcoords[model.mesh.corner_texcoord[3 * f + k]];
    return 0.25 * uv + Vec2{f < 64 ? 0 : f < 128 ? 0.3 : 0.6, 0};
  });
  const auto after = save_and_reload(model, atlas, "shared.glb");
  ASSERT_TRUE(after) << after.error().message();
  expect_uvs(after->mesh, atlas);
  const GltfFile file = reopen(output_path("shared.glb"));
  const Json& meshes = file.json["meshes"];
  EXPECT_EQ(meshes[0]["primitives"][0]["attributes"], meshes[0]["primitives"][1]["attributes"])
      << "few conflicts along the border: one set of vertices";
  EXPECT_EQ(meshes[1]["primitives"][0]["attributes"]["POSITION"], 0)
      << "all conflict: only new UVs";
  EXPECT_EQ(file.json["accessors"][0]["count"], 81);
  EXPECT_EQ(meshes[2], builder.json["meshes"][2]);
}

TEST(GltfWrite, IndicesWidenWhenTheyMust) {
  GltfBuilder builder;
  const Grid grid(12);  // 169 vertices, 288 triangles
  std::vector<std::uint8_t> indices(grid.indices.begin(), grid.indices.end());
  builder.primitive(0,
                    {{"POSITION", builder.positions(grid.positions)},
                     {"TEXCOORD_0", builder.accessor(grid.uvs, 2)}},
                    static_cast<int>(builder.accessor(indices, 1)));
  const Model model = load(builder);
  const AtlasMesh atlas = atlas_with(model.mesh, alternating);
  const auto after = save_and_reload(model, atlas, "wide.glb");
  ASSERT_TRUE(after) << after.error().message();
  expect_uvs(after->mesh, atlas);
  const GltfFile file = reopen(output_path("wide.glb"));
  const auto index = file.json["meshes"][0]["primitives"][0]["indices"].get<std::size_t>();
  EXPECT_EQ(file.json["accessors"][index]["componentType"], 5123);
}

TEST(GltfWrite, StripsBecomeTrianglesOnlyWhenRewritten) {
  GltfBuilder builder;
  const Json attributes = {{"POSITION", builder.positions(kCubePositions)},
                           {"TEXCOORD_0", builder.accessor(std::vector<float>(16, 0.5F), 2)}};
  builder.primitive(0, attributes, -1, 5);
  const Model model = load(builder);
  const AtlasMesh smooth = atlas_with(model.mesh, [&](std::size_t f, std::size_t k) {
    return Vec2{static_cast<double>(model.mesh.corner_position[3 * f + k]) / 16, 0};
  });
  const auto kept = save_and_reload(model, smooth, "kept.glb");
  ASSERT_TRUE(kept);
  expect_uvs(kept->mesh, smooth);
  EXPECT_EQ(reopen(output_path("kept.glb")).json["meshes"][0]["primitives"][0]["mode"], 5);
  const AtlasMesh split = atlas_with(model.mesh, alternating);
  const auto rewritten = save_and_reload(model, split, "rewritten.glb");
  ASSERT_TRUE(rewritten);
  expect_uvs(rewritten->mesh, split);
  EXPECT_EQ(reopen(output_path("rewritten.glb")).json["meshes"][0]["primitives"][0]["mode"], 4);
}

TEST(GltfWrite, ImagesKeepTheirBytes) {
  GltfBuilder builder = rich_cube();
  const std::string image("\x89PNG\r\n\x1a\nnot really", 18);
  builder.json["images"] = {{{"bufferView", builder.view(image)}, {"mimeType", "image/png"}}};
  const Model model = load(builder);
  ASSERT_TRUE(model.source->save(fs::path(::testing::TempDir()) / "image.glb", model.mesh,
                                 atlas_with(model.mesh, alternating)));
  const GltfFile file = reopen(fs::path(::testing::TempDir()) / "image.glb");
  const Json& view =
      file.json["bufferViews"][file.json["images"][0]["bufferView"].get<std::size_t>()];
  EXPECT_EQ(file.buffers[0].bytes.substr(view["byteOffset"].get<std::size_t>(),
                                         view["byteLength"].get<std::size_t>()),
            image);
}

TEST(GltfWrite, DracoCopiesAreDropped) {
  GltfBuilder builder = rich_cube();
  const auto view = builder.view(std::string(1000, 'd'));
  builder.json["extensionsUsed"] = {"KHR_draco_mesh_compression", "VENDOR_other"};
  builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  const Model model = load(builder);
  EXPECT_EQ(model.remarks.size(), 1U);
  const auto after = save_and_reload(model, atlas_with(model.mesh, alternating), "draco.glb");
  ASSERT_TRUE(after) << after.error().message();
  const GltfFile file = reopen(output_path("draco.glb"));
  EXPECT_EQ(file.json["extensionsUsed"].dump(), R"(["VENDOR_other"])");
  EXPECT_FALSE(file.json["meshes"][0]["primitives"][0].contains("extensions"));
  EXPECT_EQ(file.buffers[0].bytes.find("dddddddd"), std::string_view::npos);
}

TEST(GltfWrite, TextFilesWithSideFilesNeverTouchTheSource) {
  const GltfBuilder builder = rich_cube();
  const fs::path path = output_path("model.gltf");
  Json json = builder.json;
  json["buffers"] =
      Json::array({Json::object({{"byteLength", builder.bin.size()}, {"uri", "model.bin"}})});
  json["images"] =
      Json::array({Json::object({{"uri", "p%20q.png"}}), Json::object({{"uri", "gone.png"}})});
  std::ofstream(path.parent_path() / "model.bin", std::ios::binary) << builder.bin;
  std::ofstream(path.parent_path() / "p q.png", std::ios::binary) << "x";
  const auto model = read_gltf(json.dump(), false, "model.gltf", path, {});
  ASSERT_TRUE(model) << model.error().message();
  const AtlasMesh atlas = atlas_with(model->mesh, alternating);
  const auto after = save_and_reload(*model, atlas, "model.gltf");  // over itself
  ASSERT_TRUE(after) << after.error().message();
  expect_uvs(after->mesh, atlas);
  EXPECT_EQ(*read_file(path.parent_path() / "model.bin"), builder.bin)
      << "the source's data is as it was";
  EXPECT_EQ(reopen(path).json["buffers"][0]["uri"], "model_1.bin");
  EXPECT_EQ(reopen(path).json["images"][0]["uri"], "p%20q.png");

  fs::create_directories(path.parent_path() / "sub");
  ASSERT_TRUE(model->source->save(path.parent_path() / "sub" / "x.gltf", model->mesh, atlas));
  const GltfFile moved = reopen(path.parent_path() / "sub" / "x.gltf");
  EXPECT_EQ(moved.json["images"][0]["uri"], "../p%20q.png");
  EXPECT_EQ(moved.json["images"][1]["uri"], "gone.png");
  EXPECT_EQ(moved.json["buffers"][0]["uri"], "x.bin");
  fs::remove_all(path.parent_path());
}

TEST(GltfWrite, TheEndingOfThePathDecidesTheContainer) {
  const GltfBuilder builder = rich_cube();
  const Model model = load(builder);
  const AtlasMesh atlas = atlas_with(model.mesh, alternating);
  const auto text = save_and_reload(model, atlas, "as_text.gltf");
  ASSERT_TRUE(text) << text.error().message();
  expect_uvs(text->mesh, atlas);
  const auto again = save_and_reload(*text, atlas, "again.glb");
  ASSERT_TRUE(again) << again.error().message();
  expect_uvs(again->mesh, atlas);
  expect_same_attributes(opened(builder), reopen(output_path("again.glb")));
}

TEST(GltfWrite, ForeignAtlasesAreRefused) {
  const Model model = load(rich_cube());
  const fs::path path = fs::path(::testing::TempDir()) / "foreign.glb";
  const AtlasMesh good = atlas_with(model.mesh, alternating);
  const auto refused = [&](const std::function<void(AtlasMesh&)>& change) {
    AtlasMesh atlas = good;
    change(atlas);
    return !save_model(model, atlas, path) && !fs::exists(path);
  };
  EXPECT_TRUE(refused([](AtlasMesh& a) { a = {}; }));
  EXPECT_TRUE(refused([](AtlasMesh& a) {
    a.face_source[3] = 2;
    a.face_source[2] = 3;
  }));
  EXPECT_TRUE(refused([](AtlasMesh& a) { a.face_source.back() = 77; }));
  EXPECT_TRUE(refused([](AtlasMesh& a) { a.corner_source[4] = 0; }));
  EXPECT_TRUE(refused([](AtlasMesh& a) { a.corner_texcoord[4] = 1000; }));
  EXPECT_TRUE(refused([](AtlasMesh& a) { a.corner_source[4] = kNone; }));
  EXPECT_TRUE(refused([](AtlasMesh& a) { a.corner_cut.pop_back(); }));
}

TEST(GltfWrite, RandomSeamsAndRandomSharing) {
  std::mt19937 random(7);
  for (int round = 0; round < 30; ++round) {
    GltfBuilder builder;
    const Grid grid(5);
    const Json attributes = {{"POSITION", builder.positions(grid.positions)},
                             {"TEXCOORD_0", builder.accessor(grid.uvs, 2)}};
    const std::size_t count = 1 + random() % 4;
    for (std::size_t p = 0; p < count; ++p) {
      std::vector<std::uint16_t> indices;
      for (std::size_t i = 0; i < grid.indices.size(); i += 3) {
        if (random() % 2 == 0) continue;
        for (std::size_t k = 0; k < 3; ++k)
          indices.push_back(static_cast<std::uint16_t>(grid.indices[i + k]));
      }
      if (indices.empty()) indices = {0, 1, 2};
      builder.primitive(p / 2, attributes, static_cast<int>(builder.accessor(indices, 1)));
    }
    const Model model = load(builder);
    const auto places = 1 + random() % 5;
    std::vector<double> place(model.mesh.face_count());
    for (double& value : place) value = static_cast<double>(random() % places);
    const AtlasMesh atlas = atlas_with(model.mesh, [&](std::size_t f, std::size_t k) {
      return model.mesh.texcoords[model.mesh.corner_texcoord[3 * f + k]] + Vec2{place[f] / 3, 0};
    });
    const auto after = save_and_reload(model, atlas, "random_" + std::to_string(round) + ".glb");
    ASSERT_TRUE(after) << after.error().message();
    expect_uvs(after->mesh, atlas);
    expect_same_attributes(opened(builder),
                           reopen(output_path("random_" + std::to_string(round) + ".glb")));
  }
}

}  // namespace
}  // namespace wrapatlas
