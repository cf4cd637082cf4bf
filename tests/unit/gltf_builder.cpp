#include "unit/gltf_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "io/file.h"
#include "io/formats.h"

namespace wrapatlas::test {

namespace fs = std::filesystem;

const std::vector<float> kCubePositions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                           0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
const std::vector<std::uint16_t> kCubeIndices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6,
                                                 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,
                                                 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

GltfBuilder::GltfBuilder() {
  json["asset"] = {{"version", "2.0"}};
  json["scene"] = 0;
  json["scenes"] = Json::parse(R"([{"nodes": []}])");
}

std::size_t GltfBuilder::view(const std::string& bytes, std::size_t stride) {
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  Json view = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}};
  if (stride != 0) view["byteStride"] = stride;
  bin += bytes;
  json["bufferViews"].push_back(std::move(view));
  return json["bufferViews"].size() - 1;
}

void GltfBuilder::bound(std::size_t index, const std::vector<double>& values,
                        std::size_t components) {
  Json low = Json::array(), high = Json::array();
  for (std::size_t c = 0; c < components; ++c) {
    double least = values[c], most = values[c];
    for (std::size_t i = c; i < values.size(); i += components) {
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
    }
    low.push_back(least);
    high.push_back(most);
  }
  json["accessors"][index]["min"] = low;
  json["accessors"][index]["max"] = high;
}

Json& GltfBuilder::primitive(std::size_t mesh, const Json& attributes, int indices, int mode) {
  Json& meshes = json["meshes"];
  if (mesh == meshes.size()) {
    meshes.push_back({{"primitives", Json::array()}});
    json["nodes"].push_back({{"mesh", mesh}});
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
  }
  Json primitive = {{"attributes", attributes}};
  if (indices >= 0) primitive["indices"] = indices;
  if (mode >= 0) primitive["mode"] = mode;
  Json& primitives = meshes[mesh]["primitives"];
  primitives.push_back(std::move(primitive));
  return primitives.back();
}

std::string GltfBuilder::glb() const {
  Json copy = json;
  std::string padded = bin;
  padded.resize((bin.size() + 3) / 4 * 4, '\0');
  if (!bin.empty()) copy["buffers"] = Json::array({Json::object({{"byteLength", bin.size()}})});
  std::string text = copy.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255U);
    return bytes;
  };
  std::string chunks = word(text.size()) + "JSON" + text;
  if (!bin.empty()) chunks += word(padded.size()) + std::string("BIN\0", 4) + padded;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

std::string GltfBuilder::gltf() const {
  Json copy = json;
  copy["buffers"] = Json::array(
      {Json::object({{"byteLength", bin.size()},
                     {"uri", "data:application/octet-stream;base64," + base64_encode(bin)}})});
  return copy.dump(1);
}

AtlasMesh atlas_with(const Mesh& mesh, const std::function<Vec2(std::size_t, std::size_t)>& uv,
                     Wrap wrap) {
  AtlasMesh atlas;
  atlas.wrap = wrap;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      atlas.corner_source.push_back(c);
      atlas.corner_cut.push_back(kNone);
      const bool has = mesh.corner_texcoord[c] != kNone;
      atlas.corner_texcoord.push_back(has ? static_cast<std::uint32_t>(atlas.texcoords.size())
                                          : kNone);
      if (has) atlas.texcoords.push_back(uv(f, c - mesh.face_begin[f]));
    }
    atlas.face_source.push_back(static_cast<std::uint32_t>(f));
    atlas.face_begin.push_back(static_cast<std::uint32_t>(atlas.corner_source.size()));
  }
  return atlas;
}

AtlasMesh midpoint_cut(const Mesh& mesh, const std::function<Vec2(std::size_t, std::size_t)>& uv) {
  AtlasMesh atlas;
  const std::vector<std::uint32_t> welded = weld_positions(mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
  const auto add_corner = [&](std::uint32_t source, std::uint32_t cut, bool has, Vec2 at) {
    atlas.corner_source.push_back(source);
    atlas.corner_cut.push_back(cut);
    atlas.corner_texcoord.push_back(has ? static_cast<std::uint32_t>(atlas.texcoords.size())
                                        : kNone);
    if (has) atlas.texcoords.push_back(at);
  };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t first = mesh.face_begin[f];
    const bool has = mesh.corner_texcoord[first] != kNone;
    const auto corner = [&](std::size_t k) {
      add_corner(first + static_cast<std::uint32_t>(k), kNone, has, uv(f, k));
    };
    const auto middle = [&](std::size_t j, std::size_t k) {
      std::uint32_t a = first + static_cast<std::uint32_t>(j),
                    b = first + static_cast<std::uint32_t>(k);
      const Vec2 at = 0.5 * (uv(f, j) + uv(f, k));
      const auto place = [&](std::uint32_t c) { return welded[mesh.corner_position[c]]; };
      if (place(b) < place(a)) std::swap(a, b);
      const auto [found, fresh] =
          numbers.try_emplace({place(a), place(b)}, static_cast<std::uint32_t>(numbers.size()));
      atlas.cut_points.push_back({{a, b, a}, {0.5, 0.5, 0}, found->second});
      add_corner(kNone, static_cast<std::uint32_t>(atlas.cut_points.size() - 1), has, at);
    };
    const auto end_face = [&] {
      atlas.face_source.push_back(static_cast<std::uint32_t>(f));
      atlas.face_begin.push_back(static_cast<std::uint32_t>(atlas.corner_source.size()));
    };
    corner(0);
    middle(0, 1);
    middle(2, 0);
    end_face();
    middle(0, 1);
    corner(1);
    middle(1, 2);
    corner(2);
    middle(2, 0);
    end_face();
  }
  atlas.cut_position_count = static_cast<std::uint32_t>(numbers.size());
  return atlas;
}

fs::path output_path(const std::string& name) {
  const char* folder = std::getenv("WRAPATLAS_GLTF_OUT");
  fs::path path = folder != nullptr ? fs::path(folder) : fs::path(::testing::TempDir());
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  path /= std::string("wrapatlas_") + test->test_suite_name() + "_" + test->name();
  fs::create_directories(path);
  return path / name;
}

Result<Model> save_and_reload(const Model& model, const AtlasMesh& atlas, const std::string& name) {
  const fs::path path = output_path(name);
  if (Status saved = model.source->save(path, model.mesh, atlas); !saved) return saved.error();
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return read_gltf(*std::move(bytes), path.extension() == ".glb", name, path, {});
}

GltfFile reopen(const fs::path& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return {};
  Result<GltfFile> file =
      open_gltf(*std::move(bytes), path.extension() == ".glb", path.string(), path);
  EXPECT_TRUE(file) << file.error().message();
  return file ? *std::move(file) : GltfFile{};
}

Grid::Grid(std::uint32_t n) {
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(n);
      const float v = static_cast<float>(y) / static_cast<float>(n);
      positions.insert(positions.end(), {u, v, u * v});
      uvs.insert(uvs.end(), {u, v});
    }
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  }
}

}  // namespace wrapatlas::test
