// Models from text in a test, and back.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "io/file.h"
#include "wrapatlas/model.h"

namespace wrapatlas {

inline Result<Model> model_from(const std::string& bytes, FileFormat format) {
  return load_model_bytes(bytes, format, "m", {});
}

/// The error line of a model that must not load.
inline std::string load_error(const std::string& bytes, FileFormat format) {
  const Result<Model> model = model_from(bytes, format);
  return model ? "no error" : model.error().message();
}

/// The bytes that saving the model under this ending gives.
inline std::string saved_bytes(const Model& model, const AtlasMesh& atlas,
                               const std::string& ending) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) /
                                     ("wrapatlas_" + std::to_string(::getpid()) + ending);
  const Status saved = save_model(model, atlas, path);
  if (!saved) return "error: " + saved.error().message();
  const Result<std::string> bytes = read_file(path);
  std::filesystem::remove(path);
  return bytes ? *bytes : "error: " + bytes.error().message();
}

/// Corner by corner, do two meshes have the same positions and UVs? Their numbering may differ.
inline void expect_same_corners(const Mesh& a, const Mesh& b, double uv_tolerance = 0) {
  ASSERT_EQ(a.face_begin, b.face_begin);
  for (std::size_t c = 0; c < a.corner_count(); ++c) {
    EXPECT_EQ(a.positions[a.corner_position[c]], b.positions[b.corner_position[c]]) << c;
    ASSERT_EQ(a.corner_texcoord[c] == kNone, b.corner_texcoord[c] == kNone) << c;
    if (a.corner_texcoord[c] == kNone) continue;
    const Vec2 difference = a.texcoords[a.corner_texcoord[c]] - b.texcoords[b.corner_texcoord[c]];
    EXPECT_LE(length(difference), uv_tolerance) << c;
  }
}

}  // namespace wrapatlas
