#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/formats.h"
#include "unit/gltf_builder.h"

namespace wrapatlas {
namespace {

using namespace test;

Result<Model> load(const std::string& bytes, bool binary = true, int set = 0) {
  LoadOptions options;
  options.texcoord_set = set;
  return read_gltf(bytes, binary, binary ? "model.glb" : "model.gltf", "/nonexistent/model",
                   options);
}

std::string error_of(const std::string& bytes, bool binary = true) {
  const Result<Model> model = load(bytes, binary);
  return model ? "no error" : model.error().message();
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool remarks_mention(const Model& model, const std::string& part) {
  for (const std::string& remark : model.remarks) {
    if (mentions(remark, part)) return true;
  }
  return false;
}

std::vector<Vec3> corners_of(const Mesh& mesh, std::size_t face) {
  std::vector<Vec3> corners;
  for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
    corners.push_back(mesh.positions[mesh.corner_position[c]]);
  }
  return corners;
}

const std::vector<float> kFive = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
const std::vector<float> kFiveUvs = {0, 0, 1, 0, 0, 1, 1, 1, 2, 1};

TEST(GltfRead, MeshesAndPrimitivesInOrderOncePerInstance) {
  GltfBuilder builder;
  const auto p = builder.positions(kFive), uv = builder.accessor(kFiveUvs, 2);
  const Json attributes = {{"POSITION", p}, {"TEXCOORD_0", uv}};
  const auto first = builder.accessor<std::uint8_t>({0, 1, 2}, 1);
  const auto second = builder.accessor<std::uint16_t>({2, 1, 3}, 1);
  const auto third = builder.accessor<std::uint32_t>({3, 1, 4}, 1);
  builder.primitive(0, attributes, static_cast<int>(first));
  builder.primitive(0, attributes, static_cast<int>(second));
  builder.primitive(1, attributes, static_cast<int>(third));
  builder.json["nodes"].push_back({{"mesh", 0}});  // a second instance
  const auto model = load(builder.glb());
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_TRUE(model->v_points_down);
  EXPECT_EQ(model->format, FileFormat::glb);
  EXPECT_EQ(model->mesh.positions.size(), 5U) << "shared accessors are read once";
  EXPECT_EQ(model->mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 3, 1, 4}));
  EXPECT_EQ(model->mesh.corner_texcoord, model->mesh.corner_position);
  EXPECT_EQ(model->mesh.texcoords[4], (Vec2{2, 1}));
  EXPECT_EQ(model->mesh.face_object, (std::vector<std::uint32_t>{0, 0, 1})) << "one per mesh";
}

TEST(GltfRead, JsonWithDataUriIsTheSame) {
  GltfBuilder builder;
  builder.primitive(
      0, {{"POSITION", builder.positions(kFive)}, {"TEXCOORD_0", builder.accessor(kFiveUvs, 2)}},
      -1, 5);
  const auto binary = load(builder.glb()), text = load(builder.gltf(), false);
  ASSERT_TRUE(binary);
  ASSERT_TRUE(text) << text.error().message();
  EXPECT_EQ(text->format, FileFormat::gltf);
  EXPECT_EQ(text->mesh.positions, binary->mesh.positions);
  EXPECT_EQ(text->mesh.corner_texcoord, binary->mesh.corner_texcoord);
}

TEST(GltfRead, StripsAndFansHaveTheWindingOfTheSpecification) {
  GltfBuilder builder;
  const Json attributes = {{"POSITION", builder.positions(kFive)},
                           {"TEXCOORD_0", builder.accessor(kFiveUvs, 2)}};
  builder.primitive(0, attributes, -1, 5);
  builder.primitive(0, attributes, -1, 6);
  const auto jump = builder.accessor<std::uint16_t>({0, 1, 2, 2, 3, 3, 4}, 1);
  builder.primitive(0, attributes, static_cast<int>(jump), 5);
  const auto model = load(builder.glb());
  ASSERT_TRUE(model);
  const std::vector<std::uint32_t> expected = {0, 1, 2, 1, 3, 2, 2, 3, 4,  // strip
                                               1, 2, 0, 2, 3, 0, 3, 4, 0,  // fan
                                               0, 1, 2};  // 1 2 2, 2 2 3, 2 3 3 and 3 3 4 are jumps
  EXPECT_EQ(model->mesh.corner_position, expected);
}

TEST(GltfRead, QuantizedAndNormalizedValues) {
  GltfBuilder builder;
  const auto p = builder.positions<std::int16_t>({-32768, 0, 0, 32767, 0, 0, 0, 16384, 5}, true);
  const auto uv = builder.accessor<std::uint8_t>({0, 0, 255, 0, 51, 255}, 2, true);
  builder.primitive(0, {{"POSITION", p}, {"TEXCOORD_0", uv}});
  const auto raw = builder.positions<std::int8_t>({-128, 1, 2, 3, 4, 5, 6, 7, 8});
  builder.primitive(1,
                    {{"POSITION", raw},
                     {"TEXCOORD_0", builder.accessor<std::uint16_t>({0, 0, 65535, 1, 2, 3}, 2)}});
  builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const auto model = load(builder.glb());
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(model->mesh.positions[0], (Vec3{-1, 0, 0})) << "-32768 is -1 too";
  EXPECT_EQ(model->mesh.positions[1].x, 1.0);
  EXPECT_EQ(model->mesh.positions[2].y, double{16384.0F / 32767.0F}) << "as if it were a float";
  EXPECT_EQ(model->mesh.texcoords[2], (Vec2{double{0.2F}, 1}));
  EXPECT_EQ(model->mesh.positions[3], (Vec3{-128, 1, 2}));
  EXPECT_EQ(model->mesh.texcoords[4].x, 65535.0);
}

TEST(GltfRead, SparseOverDataAndOverZeros) {
  GltfBuilder builder;
  const auto p = builder.positions(kFive);
  const auto uv = builder.accessor(kFiveUvs, 2);
  const auto at = builder.accessor<std::uint8_t>({1, 3}, 1);
  const auto values = builder.accessor<float>({7, 8, 9, 10, 11, 12}, 3);
  Json& accessors = builder.json["accessors"];
  const Json sparse = {
      {"count", 2},
      {"indices", {{"bufferView", accessors[at]["bufferView"]}, {"componentType", 5121}}},
      {"values", {{"bufferView", accessors[values]["bufferView"]}}}};
  accessors[p]["sparse"] = sparse;
  Json zeros = accessors[p];
  zeros.erase("bufferView");
  accessors.push_back(zeros);
  builder.primitive(0, {{"POSITION", p}, {"TEXCOORD_0", uv}}, -1, 5);
  builder.primitive(0, {{"POSITION", accessors.size() - 1}, {"TEXCOORD_0", uv}}, -1, 5);
  const auto model = load(builder.glb());
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(model->mesh.positions[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(model->mesh.positions[1], (Vec3{7, 8, 9}));
  EXPECT_EQ(model->mesh.positions[3], (Vec3{10, 11, 12}));
  EXPECT_EQ(model->mesh.positions[4], (Vec3{2, 1, 0}));
  EXPECT_EQ(model->mesh.positions[6], (Vec3{7, 8, 9}));
  EXPECT_EQ(model->mesh.positions[9], (Vec3{0, 0, 0}));

  accessors[p]["sparse"]["count"] = 6;
  EXPECT_TRUE(mentions(error_of(builder.glb()), "accessor 0: its sparse part"));
  accessors[p]["sparse"]["count"] = 2;
  builder.bin[*as_integer(builder.json["bufferViews"][2]["byteOffset"])] = 3;  // 3, 3
  EXPECT_TRUE(mentions(error_of(builder.glb()), "sparse index 1 is out of order"));
}

TEST(GltfRead, InterleavedVertices) {
  GltfBuilder builder;
  std::string bytes;
  for (std::size_t i = 0; i < 3; ++i) {
    const float vertex[5] = {kFive[3 * i], kFive[3 * i + 1], kFive[3 * i + 2], kFiveUvs[2 * i],
                             kFiveUvs[2 * i + 1]};
    bytes.append(reinterpret_cast<const char*>(vertex), sizeof vertex);
  }
  const auto view = builder.view(bytes, 20);
  builder.json["accessors"] = {
      {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
      {{"bufferView", view},
       {"byteOffset", 12},
       {"componentType", 5126},
       {"count", 3},
       {"type", "VEC2"}}};
  builder.primitive(0, {{"POSITION", 0}, {"TEXCOORD_0", 1}});
  const auto model = load(builder.glb());
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(corners_of(model->mesh, 0)[2], (Vec3{0, 1, 0}));
  EXPECT_EQ(model->mesh.texcoords[2], (Vec2{0, 1}));
  builder.json["accessors"][1]["byteOffset"] = 16;
  EXPECT_TRUE(mentions(error_of(builder.glb()), "accessor 1: its 3 elements end beyond"));
}

TEST(GltfRead, WhatHasNoUvsOrNoTrianglesIsRemarked) {
  GltfBuilder builder;
  const auto p = builder.positions(kFive), uv = builder.accessor(kFiveUvs, 2);
  builder.primitive(0, {{"POSITION", p}}, -1, 5);
  builder.primitive(0, {{"POSITION", p}, {"TEXCOORD_1", uv}}, -1, 5);
  builder.primitive(0, {{"POSITION", p}}, -1, 1);
  builder.primitive(0, {{"TEXCOORD_0", uv}});
  const auto model = load(builder.glb(), true, 1);
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(model->mesh.face_count(), 6U);
  EXPECT_EQ(model->mesh.corner_texcoord[0], kNone);
  EXPECT_EQ(model->mesh.corner_texcoord[9], 0U);
  EXPECT_TRUE(remarks_mention(*model, "3 faces in 1 primitives have no TEXCOORD_1"));
  EXPECT_TRUE(remarks_mention(*model, "1 primitives of points or lines"));
  EXPECT_TRUE(remarks_mention(*model, "1 primitives without POSITION"));
}

TEST(GltfRead, TexturesAndTransformsAreRemarked) {
  GltfBuilder builder;
  builder.primitive(
      0, {{"POSITION", builder.positions(kFive)}, {"TEXCOORD_0", builder.accessor(kFiveUvs, 2)}},
      -1, 5)["material"] = 0;
  builder.json["textures"] = Json::parse(R"([{}])");
  builder.json["materials"] = Json::parse(R"([{"normalTexture": {"index": 0, "texCoord": 1}}])");
  auto model = load(builder.glb());
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->remarks.empty());
  Json& info = builder.json["materials"][0]["normalTexture"];
  info["extensions"]["KHR_texture_transform"] = {{"texCoord", 0}};
  model = load(builder.glb());
  ASSERT_TRUE(model);
  EXPECT_TRUE(remarks_mention(*model, "its textures are made for its UVs"));
  EXPECT_TRUE(remarks_mention(*model, "KHR_texture_transform"));
}

TEST(GltfRead, SideFilesBesideTheModel) {
  GltfBuilder builder;
  builder.primitive(
      0, {{"POSITION", builder.positions(kFive)}, {"TEXCOORD_0", builder.accessor(kFiveUvs, 2)}},
      -1, 5);
  const auto path = output_path("side.gltf");
  std::ofstream(path.parent_path() / "a b.bin", std::ios::binary) << builder.bin;
  const auto with_uri = [&](const std::string& uri) {
    builder.json["buffers"] =
        Json::array({Json::object({{"byteLength", builder.bin.size()}, {"uri", uri}})});
    const auto model = read_gltf(builder.json.dump(), false, "side.gltf", path, {});
    return model ? "ok" : model.error().message();
  };
  EXPECT_EQ(with_uri("a%20b.bin"), "ok");
  EXPECT_EQ(with_uri("./a%20b.bin"), "ok");
  EXPECT_TRUE(mentions(with_uri("none.bin"), "there is no file"));
  EXPECT_TRUE(mentions(with_uri((path.parent_path() / "a b.bin").string()), "not a file beside"));
  EXPECT_TRUE(mentions(with_uri("x/../../a%20b.bin"), "not a file beside"));
  EXPECT_TRUE(mentions(with_uri("%2e%2E/a.bin"), "not a file beside"));
  EXPECT_TRUE(mentions(with_uri("http://x/a.bin"), "not a file beside"));
  EXPECT_TRUE(mentions(with_uri("%4"), "not a file beside"));
  EXPECT_TRUE(mentions(with_uri(""), "not a file beside"));
  EXPECT_TRUE(mentions(with_uri("data:;base64,?"), "cannot be decoded"));
  EXPECT_TRUE(mentions(with_uri("data:;base64,AAAA"), "has 3 bytes but says"));
}

/// One triangle, with a change to its JSON.
std::string changed(const std::function<void(Json&)>& change) {
  GltfBuilder builder;
  const auto positions = builder.positions<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto uvs = builder.accessor<float>({0, 0, 1, 0, 0, 1}, 2);
  const auto indices = builder.accessor<std::uint16_t>({0, 1, 2}, 1);
  builder.primitive(0, {{"POSITION", positions}, {"TEXCOORD_0", uvs}}, static_cast<int>(indices));
  change(builder.json);
  return error_of(builder.glb());
}

TEST(GltfRead, EveryKindOfBadReferenceIsNamed) {
  EXPECT_EQ(changed([](Json&) {}), "no error");
  const auto accessor = [](const char* key, const Json& value) {
    return changed([&](Json& j) { j["accessors"][0][key] = value; });
  };
  EXPECT_TRUE(mentions(accessor("count", 4), "model.glb: accessor 0: its 4 elements end beyond"));
  EXPECT_TRUE(mentions(accessor("count", 0), "accessor 0: its count"));
  EXPECT_TRUE(mentions(accessor("count", -3), "accessor 0: its count"));
  EXPECT_TRUE(mentions(accessor("count", 18446744073709551615ULL), "accessor 0: its count"));
  EXPECT_TRUE(mentions(accessor("count", 2), "accessor 1: it has 3 elements as TEXCOORD_0"));
  EXPECT_TRUE(mentions(accessor("byteOffset", 18446744073709551615ULL), "accessor 0: "));
  EXPECT_TRUE(mentions(accessor("componentType", 5124), "accessor 0: its componentType"));
  EXPECT_TRUE(mentions(accessor("componentType", "x"), "accessor 0: its componentType"));
  EXPECT_TRUE(mentions(accessor("type", "VEC5"), "accessor 0: its type"));
  EXPECT_TRUE(mentions(accessor("type", "VEC2"), "accessor 0: it is a POSITION but not"));
  EXPECT_TRUE(mentions(accessor("bufferView", 99), "accessor 0: its bufferView"));
  const auto view = [](const char* key, const Json& value) {
    return changed([&](Json& j) { j["bufferViews"][1][key] = value; });
  };
  EXPECT_TRUE(mentions(view("byteLength", 1000), "bufferView 1: bytes"));
  EXPECT_TRUE(mentions(view("byteOffset", 18446744073709551615ULL), "bufferView 1: bytes"));
  EXPECT_TRUE(mentions(view("byteStride", 0), "bufferView 1"));
  EXPECT_TRUE(mentions(view("byteStride", 4), "accessor 1: its elements are longer"));
  EXPECT_TRUE(mentions(view("buffer", 1), "bufferView 1: it names no buffer"));
  EXPECT_TRUE(mentions(
      changed([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 77; }),
      "accessor 77: there are only 3"));
  EXPECT_TRUE(mentions(changed([](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 1; }),
                       "accessor 1: it holds indices"));
  EXPECT_TRUE(
      mentions(changed([](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; }), "mode"));
  EXPECT_TRUE(mentions(changed([](Json& j) { j["meshes"][0]["primitives"][0] = 7; }),
                       "mesh 0, primitive 0"));
  EXPECT_TRUE(mentions(changed([](Json& j) { j["meshes"] = 7; }), "\"meshes\" is not an array"));
  EXPECT_TRUE(mentions(changed([](Json& j) { j["meshes"] = Json::array(); }), "no triangles"));
  EXPECT_TRUE(
      mentions(changed([](Json& j) { j["asset"]["version"] = "1.0"; }), "export it as glTF 2.0"));
}

TEST(GltfRead, BadNumbersNameAccessorAndElement) {
  GltfBuilder builder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto p = builder.accessor<float>({0, 0, 0, 1, nan, 0, 0, 1, 0}, 3);
  builder.primitive(0, {{"POSITION", p}});
  EXPECT_TRUE(
      mentions(error_of(builder.glb()), "model.glb: accessor 0: element 1 is not a usable"));
  const auto indices = builder.accessor<std::uint16_t>({0, 1, 3}, 1);
  builder.json["meshes"].clear();
  builder.primitive(0, {{"POSITION", builder.positions(std::vector<float>(9, 1.0F))}},
                    static_cast<int>(indices));
  EXPECT_TRUE(mentions(error_of(builder.glb()), "accessor 1: index 2 is vertex 3 of 3"));
}

TEST(GltfRead, CompressedGeometryIsRefusedWithAWayOut) {
  const auto required = [](const std::string& name, const std::string& where) {
    return changed([&](Json& j) {
      j["extensionsRequired"] = {name};
      j[Json::json_pointer(where)]["extensions"][name] = Json::object();
    });
  };
  EXPECT_TRUE(
      mentions(required("KHR_draco_mesh_compression", "/meshes/0/primitives/0"),
               "needs KHR_draco_mesh_compression, which is not supported; decompress it first"));
  EXPECT_TRUE(mentions(required("VENDOR_zip", "/bufferViews/0"), "VENDOR_zip"));
  EXPECT_EQ(required("VENDOR_paint", "/asset"), "no error");
  EXPECT_EQ(required("KHR_materials_variants", "/meshes/0/primitives/0"), "no error");
  EXPECT_TRUE(
      mentions(changed([](Json& j) {
                 j["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] =
                     Json::object();
                 j["accessors"][0].erase("bufferView");
               }),
               "KHR_draco_mesh_compression"));
  GltfBuilder builder;
  builder.primitive(0, {{"POSITION", builder.positions(kFive)}}, -1, 5);
  builder.json["buffers"] = Json::parse(R"([{"byteLength": 60}])");
  builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0}};
  EXPECT_TRUE(mentions(error_of(builder.json.dump(), false),
                       "bufferView 0: its data is compressed by EXT_meshopt"));
}

TEST(GltfRead, BrokenContainers) {
  GltfBuilder builder;
  builder.primitive(0, {{"POSITION", builder.positions(kFive)}}, -1, 5);
  const std::string good = builder.glb();
  ASSERT_EQ(error_of(good), "no error");
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(error_of(good.substr(0, size)), "no error") << size;
  }
  EXPECT_EQ(error_of(good + "tail"), "no error")
      << "bytes after the stated length are not the file's";
  EXPECT_TRUE(mentions(error_of("glTF" + std::string(30, '\x01')), "version"));
  EXPECT_TRUE(
      mentions(error_of("{\n\n  \"asset\": ]}", false), "model.gltf:3: it is not valid JSON"));
  EXPECT_TRUE(mentions(error_of("[1]", false), "not an object"));
  EXPECT_TRUE(mentions(error_of("{\"x\": 1e999}", false), "out of range"));
  EXPECT_TRUE(mentions(error_of(std::string(1000000, '['), false), "nested too deeply"));
  std::string members = "{";
  for (int i = 0; i < 5000; ++i) members += fmt::format("\"{}\":0,", i);
  EXPECT_TRUE(mentions(error_of(members + "\"z\":0}", false), "too many members"));
}

TEST(GltfRead, SmallFilesDoNotMakeHugeMeshes) {
  GltfBuilder builder;
  const Json attributes = {{"POSITION", builder.positions(std::vector<float>(300000, 1.0F))}};
  for (int i = 0; i < 3000; ++i) builder.primitive(0, attributes);
  EXPECT_TRUE(mentions(error_of(builder.glb()), "repeat the same data too often"));
}

}  // namespace
}  // namespace wrapatlas
