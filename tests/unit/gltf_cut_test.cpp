// Cut atlases: attributes between vertices, triangles of pieces, and cracks.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "io/formats.h"
#include "io/gltf_blend.h"
#include "io/gltf_layers.h"
#include "unit/gltf_builder.h"

namespace wrapatlas {
namespace {

using namespace test;

double smallest_area(const std::vector<Vec2>& points) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangulate_piece(points, triangles);
  EXPECT_EQ(triangles.size(), points.size() - 2);
  double smallest = 1e9, sum = 0, whole = 0;
  for (const auto& t : triangles) {
    const double area = signed_area2(points[t[0]], points[t[1]], points[t[2]]);
    smallest = std::min(smallest, std::abs(area));
    sum += area;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    whole += cross(points[i], points[(i + 1) % points.size()]);
  EXPECT_NEAR(sum, whole, 1e-12);
  return smallest;
}

TEST(GltfCut, PiecesWithCollinearPointsHaveNoEmptyTriangles) {
  EXPECT_GT(smallest_area({{0, 0}, {0.5, 0}, {1, 0}, {0, 1}}), 0.1);
  EXPECT_GT(smallest_area({{0, 0}, {0.25, 0}, {0.5, 0}, {0.75, 0}, {1, 0}, {0, 1}}), 0.1);
  EXPECT_GT(smallest_area({{0, 0}, {0.5, 0}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 0.5}}), 0.2);
  EXPECT_GT(smallest_area({{0, 1}, {0.3, 0.7}, {0.7, 0.3}, {1, 0}, {0, 0}}), 0.1);
  EXPECT_GT(smallest_area({{0, 0}, {0, 1}, {0.5, 0.5}, {1, 0}}), 0.1) << "clockwise";
  std::vector<Vec2> many = {{0, 1}};
  for (int i = 0; i <= 100; ++i) many.push_back({i / 100.0, 0});
  EXPECT_GT(smallest_area(many), 0.009) << "beyond the exact method's size";
}

TEST(GltfCut, SurfacesStayClosed) {
  GltfBuilder builder;  // the cube's faces in two primitives with their own accessors
  for (int part = 0; part < 2; ++part) {
    const auto p = builder.positions(kCubePositions);
    const auto uv = builder.accessor(std::vector<float>(16, 0.25F), 2);
    const auto begin = kCubeIndices.begin() + 18 * part;
    const auto i = builder.accessor(std::vector<std::uint16_t>(begin, begin + 18), 1);
    Json attributes = {{"POSITION", p}};
    if (part == 0) attributes["TEXCOORD_0"] = uv;  // cuts reach faces without UVs as well
    builder.primitive(0, attributes, static_cast<int>(i));
  }
  const auto model = read_gltf(builder.glb(), true, "in.glb", "/nonexistent/in", {});
  ASSERT_TRUE(model) << model.error().message();
  const AtlasMesh atlas = midpoint_cut(model->mesh, [](std::size_t f, std::size_t k) {
    return Vec2{static_cast<double>(f) / 8, static_cast<double>(k) / 4};
  });
  const auto after = save_and_reload(*model, atlas, "closed.glb");
  ASSERT_TRUE(after) << after.error().message();
  EXPECT_EQ(after->mesh.face_count(), 4 * 12U);
  const std::vector<std::uint32_t> welded = weld_positions(after->mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t f = 0; f < after->mesh.face_count(); ++f) {
    Vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = after->mesh.positions[after->mesh.corner_position[3 * f + k]];
      ++edges[{welded[after->mesh.corner_position[3 * f + k]],
               welded[after->mesh.corner_position[3 * f + (k + 1) % 3]]}];
    }
    EXPECT_GT(length(cross(p[1] - p[0], p[2] - p[0])), 0.1);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U) << "a crack";
  }
}

/// One triangle with every attribute, cut; the saved file and its primitive.
struct CutTriangle {
  GltfFile file;
  Json primitive;

  [[nodiscard]] std::vector<double> middle(const Json& index) const {  // of vertices 0 and 1
    const auto accessor = *open_accessor(file, index.get<std::uint64_t>());
    std::vector<double> values;
    for (std::size_t c = 0; c < accessor.components; ++c)
      values.push_back(accessor.value(accessor.element(3), c));
    return values;
  }
  [[nodiscard]] std::vector<double> middle(const char* name) const {
    return middle(primitive["attributes"][name]);
  }
};

CutTriangle cut_triangle(const std::string& name) {
  GltfBuilder b;
  const auto p = b.positions<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto normal = b.accessor<std::int8_t>({127, 0, 0, 0, 127, 0, 0, 0, 127}, 3, true);
  const auto tangent = b.accessor<float>({0, 1, 0, -1, 0, 0, 1, -1, 1, 0, 0, 1}, 4);
  const auto uv = b.accessor<float>({0, 0, 1, 0, 0, 1}, 2);
  const auto uv1 = b.accessor<std::uint8_t>({0, 0, 101, 255, 0, 1}, 2, true);
  const auto color = b.accessor<float>({1, 0, 0, 0, 0.5F, 0, 0, 0, 1}, 3);
  const auto j0 = b.accessor<std::uint8_t>({0, 1, 2, 3, 4, 1, 5, 0, 0, 0, 0, 0}, 4);
  const auto w0 =
      b.accessor<std::uint8_t>({100, 80, 50, 25, 120, 100, 35, 0, 255, 0, 0, 0}, 4, true);
  const auto id = b.accessor<std::uint8_t>({7, 0, 0, 0, 9, 0, 0, 0, 11, 0, 0, 0}, 4);
  const auto heat = b.accessor<float>({10, 20, 30}, 1);
  const auto move = b.positions<float>({0, 0, 0, 0, 0, 3, 0, 0, 0});
  const auto turn = b.accessor<float>({0, 0, 0, 0, 0.5F, 0, 0, 0, 0}, 3);
  b.primitive(0, {{"POSITION", p},
                  {"NORMAL", normal},
                  {"TANGENT", tangent},
                  {"TEXCOORD_0", uv},
                  {"TEXCOORD_1", uv1},
                  {"COLOR_0", color},
                  {"JOINTS_0", j0},
                  {"WEIGHTS_0", w0},
                  {"_ID", id},
                  {"_HEAT", heat}})["targets"] = {{{"POSITION", move}, {"NORMAL", turn}}};
  b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  for (int i = 0; i < 6; ++i) b.json["nodes"].push_back(Json::object());
  b.json["nodes"][0]["skin"] = 0;
  b.json["nodes"][1]["children"] = {2, 3, 4, 5, 6};
  b.json["scenes"][0]["nodes"] = {0, 1};
  b.json["skins"] = {{{"joints", {1, 2, 3, 4, 5, 6}}}};
  const auto model = read_gltf(b.glb(), true, "in.glb", "/nonexistent/in", {});
  EXPECT_TRUE(model) << model.error().message();
  const AtlasMesh atlas = midpoint_cut(model->mesh, [](std::size_t, std::size_t k) {
    return Vec2{k == 1 ? 1.0 : 0.0, 0.5};
  });
  EXPECT_TRUE(model->source->save(output_path(name), model->mesh, atlas));
  CutTriangle result{reopen(output_path(name)), {}};
  result.primitive = result.file.json["meshes"][0]["primitives"][0];
  return result;
}

TEST(GltfCut, AttributesAreBlended) {
  const CutTriangle cut = cut_triangle("blend.glb");
  const double half = std::sqrt(0.5);
  EXPECT_EQ(cut.middle("POSITION"), (std::vector<double>{0.5, 0, 0}));
  EXPECT_EQ(cut.middle("TEXCOORD_0"), (std::vector<double>{0.5, 0.5}));
  EXPECT_NEAR(cut.middle("TEXCOORD_1")[0], 50.5 / 255, 1e-7);
  EXPECT_NEAR(cut.middle("TEXCOORD_1")[1], 127.5 / 255, 1e-7);
  EXPECT_EQ(cut.middle("COLOR_0"), (std::vector<double>{0.5, 0.25, 0}));
  EXPECT_EQ(cut.middle("_HEAT"), (std::vector<double>{15}));
  EXPECT_EQ(cut.middle("_ID")[0], 7) << "identifiers are not averaged";
  EXPECT_NEAR(cut.middle("NORMAL")[0], half, 0.005);
  EXPECT_NEAR(cut.middle("NORMAL")[1], half, 0.005);
  EXPECT_NEAR(cut.middle("TANGENT")[1], half, 1e-7);
  EXPECT_EQ(cut.middle("TANGENT")[3], -1);
  EXPECT_EQ(cut.middle(cut.primitive["targets"][0]["POSITION"]), (std::vector<double>{0, 0, 1.5}));
  EXPECT_EQ(cut.middle(cut.primitive["targets"][0]["NORMAL"]), (std::vector<double>{0, 0.25, 0}));
}

/// What cutting a quantised triangle makes.
GltfFile cut_quantized(const std::string& name, const std::function<void(GltfBuilder&)>& change) {
  GltfBuilder b;
  const auto p = b.positions<std::int16_t>({0, 0, 0, 3, 0, 0, 0, 5, 0});
  const auto uv = b.accessor<std::int8_t>({0, 0, 1, 0, 0, 1}, 2);
  const auto move = b.positions<std::int8_t>({0, 0, 0, 0, 0, 1, 0, 0, 0});
  b.primitive(0, {{"POSITION", p}, {"TEXCOORD_0", uv}})["targets"] = {{{"POSITION", move}}};
  b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  change(b);
  const auto model = read_gltf(b.glb(), true, "in.glb", "/nonexistent/in", {});
  EXPECT_TRUE(model) << model.error().message();
  const AtlasMesh atlas = midpoint_cut(model->mesh, [](std::size_t, std::size_t k) {
    return Vec2{k == 1 ? 1.0 : 0.0, 0.5};
  });
  EXPECT_TRUE(model->source->save(output_path(name), model->mesh, atlas));
  return reopen(output_path(name));
}

TEST(GltfCut, QuantizedSurfacesStayWhereTheyAre) {
  const GltfFile file = cut_quantized("quantized.glb", [](GltfBuilder&) {});
  const Json& primitive = file.json["meshes"][0]["primitives"][0];
  const auto position = *open_accessor(file, primitive["attributes"]["POSITION"]);
  const auto shift = *open_accessor(file, primitive["targets"][0]["POSITION"]);
  EXPECT_EQ(position.component, GltfComponent::f32);
  EXPECT_EQ(shift.component, GltfComponent::f32);
  EXPECT_EQ(position.value(position.element(2), 1), 5) << "old vertices too";
  EXPECT_EQ(position.value(position.element(3), 0), 1.5);
  EXPECT_EQ(shift.value(shift.element(3), 2), 0.5);
  EXPECT_EQ(file.json["accessors"][position.index]["max"], (Json{3.0, 5.0, 0.0}));
  EXPECT_FALSE(file.json.contains("extensionsUsed")) << "nothing needs it any more";
  EXPECT_FALSE(file.json.contains("extensionsRequired"));
}

TEST(GltfCut, QuantizationStaysListedWhereItIsUsed) {
  const GltfFile normals = cut_quantized("quantized_normals.glb", [](GltfBuilder& b) {
    b.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        b.accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127}, 3, true);
  });
  EXPECT_EQ(normals.json["extensionsRequired"], Json{"KHR_mesh_quantization"});
  const GltfFile targets = cut_quantized("quantized_targets.glb", [](GltfBuilder& b) {
    b.json["meshes"][0]["primitives"][0]["targets"][0]["NORMAL"] =
        b.accessor<std::int8_t>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3, true);
  });
  EXPECT_EQ(targets.json["extensionsUsed"], Json{"KHR_mesh_quantization"});
  const GltfFile needless = cut_quantized("needless.glb", [](GltfBuilder& b) {
    Json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive.erase("targets");
    primitive["attributes"] = {{"POSITION", b.positions<float>({0, 0, 0, 3, 0, 0, 0, 5, 0})},
                               {"TEXCOORD_0", b.accessor<float>({0, 0, 1, 0, 0, 1}, 2)}};
  });
  EXPECT_EQ(needless.json["extensionsUsed"], Json{"KHR_mesh_quantization"}) << "as it was";
}

TEST(GltfCut, JointsAreMergedAndTheHeaviestKept) {
  const CutTriangle cut = cut_triangle("joints.glb");
  // Halves of 0:100 1:80 2:50 3:25 and 4:120 1:100 5:35; the four heaviest are 1, 4, 0, 2.
  EXPECT_EQ(cut.middle("JOINTS_0"), (std::vector<double>{1, 4, 0, 2}));
  const std::vector<double> weights = cut.middle("WEIGHTS_0");
  double sum = 0;
  for (const double weight : weights) sum += weight * 255;
  EXPECT_NEAR(sum, 255, 1e-9);
  EXPECT_NEAR(weights[0], 180.0 / 450, 0.004);
  EXPECT_NEAR(weights[3], 50.0 / 450, 0.004);
}

TEST(GltfCut, CutsAndSplitsTogether) {
  std::mt19937 random(3);
  GltfBuilder builder;
  const Grid grid(6);
  const auto p = builder.positions(grid.positions);
  const auto uv = builder.accessor(grid.uvs, 2);
  builder.primitive(0, {{"POSITION", p}, {"TEXCOORD_0", uv}},
                    static_cast<int>(builder.accessor(grid.indices, 1)));
  const auto model = read_gltf(builder.glb(), true, "in.glb", "/nonexistent/in", {});
  ASSERT_TRUE(model);
  std::vector<double> place(model->mesh.face_count());
  for (double& value : place) value = static_cast<double>(random() % 2);
  const AtlasMesh atlas = midpoint_cut(model->mesh, [&](std::size_t f, std::size_t k) {
    return model->mesh.texcoords[model->mesh.corner_texcoord[3 * f + k]] + Vec2{place[f], 0};
  });
  const auto after = save_and_reload(*model, atlas, "both.glb");
  ASSERT_TRUE(after) << after.error().message();
  // On this grid u == x and v == y, so every new vertex can be checked on its own.
  for (std::size_t c = 0; c < after->mesh.corner_count(); ++c) {
    const Vec3 at = after->mesh.positions[after->mesh.corner_position[c]];
    const Vec2 read = after->mesh.texcoords[after->mesh.corner_texcoord[c]];
    EXPECT_NEAR(read.x, at.x + place[c / 12], 1e-6);
    EXPECT_NEAR(read.y, at.y, 1e-6);
  }
}

}  // namespace
}  // namespace wrapatlas
