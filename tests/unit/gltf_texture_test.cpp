// Samplers that must repeat.
#include <gtest/gtest.h>

#include "io/formats.h"
#include "unit/gltf_builder.h"

namespace wrapatlas {
namespace {

using namespace test;

/// Two triangles with materials 0 and 1.
Json saved(const std::string& rest, Wrap wrap, const std::string& name) {
  GltfBuilder builder;
  const auto p = builder.positions<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto uv = builder.accessor<float>({0, 0, 1, 0, 0, 1}, 2);
  const Json attributes = {{"POSITION", p}, {"TEXCOORD_0", uv}, {"TEXCOORD_1", uv}};
  builder.primitive(0, attributes)["material"] = 0;
  builder.primitive(0, attributes)["material"] = 1;
  builder.json["images"] = Json::array(
      {Json::object({{"uri",
                      "data:image/"
                      "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+"
                      "M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}})});
  const Json parsed = Json::parse(rest);
  for (const auto& [key, value] : parsed.items()) builder.json[key] = value;
  const auto model = read_gltf(builder.glb(), true, "in.glb", "/nonexistent/in", {});
  EXPECT_TRUE(model) << model.error().message();
  const AtlasMesh atlas = atlas_with(
      model->mesh,
      [](std::size_t, std::size_t k) {
        return Vec2{0.8 + 0.3 * static_cast<double>(k % 2), 0.4};
      },
      wrap);
  EXPECT_TRUE(model->source->save(output_path(name), model->mesh, atlas));
  return reopen(output_path(name)).json;
}

constexpr const char* kClamped = R"({
  "samplers": [{"wrapS": 33071, "minFilter": 9987, "wrapT": 33648}],
  "textures": [{"source": 0, "sampler": 0}, {"source": 0, "sampler": 0}],
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                {"emissiveTexture": {"index": 1, "texCoord": 1}}]})";

TEST(GltfTextures, NothingChangesWithoutWrap) {
  EXPECT_EQ(saved(kClamped, Wrap::none, "none.glb")["samplers"], Json::parse(kClamped)["samplers"]);
}

TEST(GltfTextures, SharedSamplersAreCloned) {
  const Json json = saved(kClamped, Wrap::uv, "cloned.glb");
  EXPECT_EQ(json["samplers"][0], Json::parse(kClamped)["samplers"][0]);
  EXPECT_EQ(json["samplers"][1].dump(), R"({"wrapS":10497,"minFilter":9987,"wrapT":10497})");
  EXPECT_EQ(json["textures"][0]["sampler"], 1);
  EXPECT_EQ(json["textures"][1]["sampler"], 0);
}

TEST(GltfTextures, OnlyAxesThatWrapAreChanged) {
  const Json json = saved(kClamped, Wrap::v, "v.glb");
  EXPECT_EQ(json["samplers"][1].dump(), R"({"wrapS":33071,"minFilter":9987,"wrapT":10497})");
}

TEST(GltfTextures, UnsharedSamplersChangeInPlace) {
  Json rest = Json::parse(kClamped);
  rest["textures"].erase(1);
  rest["materials"].erase(1);
  rest["materials"].push_back(Json::object());
  const Json json = saved(rest.dump(), Wrap::u, "in_place.glb");
  EXPECT_EQ(json["samplers"].size(), 1U);
  EXPECT_EQ(json["samplers"][0].dump(), R"({"wrapS":10497,"minFilter":9987,"wrapT":33648})");
}

TEST(GltfTextures, DefaultSamplersBecomeExplicit) {
  const Json json = saved(R"({
    "extensionsUsed": ["KHR_materials_clearcoat"],
    "samplers": [{}],
    "textures": [{"source": 0}, {"source": 0, "sampler": 0}],
    "materials": [{"occlusionTexture": {"index": 0},
                   "extensions": {"KHR_materials_clearcoat": {"clearcoatTexture": {"index": 1}}}}, {}]})",
                          Wrap::uv, "default.glb");
  EXPECT_EQ(json["samplers"].dump(),
            R"([{"wrapS":10497,"wrapT":10497},{"wrapS":10497,"wrapT":10497}])");
  EXPECT_EQ(json["textures"][0]["sampler"], 1);
  EXPECT_EQ(json["textures"][1]["sampler"], 0);
}

TEST(GltfTextures, TexturesUsedOtherwiseAreCloned) {
  const Json json = saved(R"({
    "samplers": [{"wrapS": 33071, "wrapT": 33071}],
    "textures": [{"source": 0, "sampler": 0, "name": "t"}],
    "materials": [{"emissiveTexture": {"index": 0}, "normalTexture": {"index": 0, "texCoord": 1}},
                  {"emissiveTexture": {"index": 0, "texCoord": 1}}]})",
                          Wrap::uv, "used_otherwise.glb");
  EXPECT_EQ(json["textures"].size(), 2U);
  EXPECT_EQ(json["textures"][1]["name"], "t");
  EXPECT_EQ(json["materials"][0]["emissiveTexture"]["index"], 1);
  EXPECT_EQ(json["materials"][0]["normalTexture"]["index"], 0);
  EXPECT_EQ(json["samplers"][json["textures"][0]["sampler"].get<std::size_t>()]["wrapS"], 33071);
  EXPECT_EQ(json["samplers"][json["textures"][1]["sampler"].get<std::size_t>()]["wrapS"], 10497);
}

TEST(GltfTextures, TransformsNameTheirOwnSet) {
  Json rest = Json::parse(kClamped);
  rest["materials"][1]["emissiveTexture"] = Json::parse(
      R"({"index": 1, "texCoord": 1, "extensions": {"KHR_texture_transform": {"texCoord": 0}}})");
  rest["extensionsUsed"] = {"KHR_texture_transform"};
  const Json json = saved(rest.dump(), Wrap::uv, "transform.glb");
  EXPECT_EQ(json["samplers"].size(), 1U) << "all its users want it to repeat";
  EXPECT_EQ(json["samplers"][0]["wrapS"], 10497);
}

}  // namespace
}  // namespace wrapatlas
