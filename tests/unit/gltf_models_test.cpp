// Whole files: all models below $WRAPATLAS_GLTF_IN, and ours. With $WRAPATLAS_GLTF_OUT set, what
// is written stays there for the Khronos validator (tests/gltf/validate.mjs).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "io/file.h"
#include "io/formats.h"
#include "unit/gltf_builder.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;
using namespace test;

TEST(GltfModels, SurviveNewUvs) {
  const char* folder = std::getenv("WRAPATLAS_GLTF_IN");
  if (folder == nullptr) GTEST_SKIP() << "WRAPATLAS_GLTF_IN is not set";
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".glb" || ending == ".gltf") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::size_t number = 0;
  for (const fs::path& path : paths) {
    SCOPED_TRACE(path.string());
    Result<std::string> bytes = read_file(path);
    ASSERT_TRUE(bytes);
    const bool binary = path.extension() == ".glb";
    const Result<Model> model =
        read_gltf(*std::move(bytes), binary, path.filename().string(), path, {});
    if (!model) {
      std::cout << path << ": " << model.error().message() << "\n";
      continue;
    }
    std::cout << path << ": " << model->mesh.face_count() << " faces\n";
    for (const std::string& remark : model->remarks) std::cout << "  " << remark << "\n";
    const Mesh& mesh = model->mesh;
    const auto stepped = [&](std::size_t f, std::size_t k) {
      const std::uint32_t uv = mesh.corner_texcoord[mesh.face_begin[f] + k];
      const Vec2 old = uv == kNone ? Vec2{} : mesh.texcoords[uv];
      return Vec2{old.x / 2 + (f % 5 == 0 ? 0.5 : 0), old.y / 2};
    };
    const std::string stem = std::to_string(number++) + "_" + path.stem().string();
    const std::string ending = path.extension().string();
    const Result<Model> split =
        save_and_reload(*model, atlas_with(mesh, stepped, Wrap::uv), stem + "_split" + ending);
    ASSERT_TRUE(split) << split.error().message();
    ASSERT_EQ(split->mesh.face_count(), mesh.face_count());
    for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
      ASSERT_EQ(split->mesh.positions[split->mesh.corner_position[c]],
                mesh.positions[mesh.corner_position[c]]);
      if (mesh.corner_texcoord[c] == kNone) continue;
      const Vec2 uv = split->mesh.texcoords[split->mesh.corner_texcoord[c]];
      const Vec2 wanted = stepped(c / 3, c % 3);
      ASSERT_EQ(uv.x, static_cast<double>(static_cast<float>(wanted.x)));
      ASSERT_EQ(uv.y, static_cast<double>(static_cast<float>(wanted.y)));
    }
    const Result<Model> cut =
        save_and_reload(*model, midpoint_cut(mesh, stepped), stem + "_cut" + ending);
    ASSERT_TRUE(cut) << cut.error().message();
    EXPECT_EQ(cut->mesh.face_count(), 4 * mesh.face_count());
  }
}

}  // namespace
}  // namespace wrapatlas
