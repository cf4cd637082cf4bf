// glTF files made in code, and atlases for them, for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/gltf_accessor.h"
#include "io/gltf_json.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/model.h"

namespace wrapatlas::test {

class GltfBuilder {
 public:
  GltfBuilder();

  Json json;
  std::string bin;

  /// A buffer view of these bytes, at a multiple of 4.
  std::size_t view(const std::string& bytes, std::size_t stride = 0);

  /// An accessor of `components` wide elements; those of vertex attributes are padded to 4 bytes.
  template <typename T>
  std::size_t accessor(const std::vector<T>& values, int components, bool normalized = false) {
    const std::size_t size = sizeof(T) * static_cast<std::size_t>(components);
    const bool scalar = components == 1;
    const std::size_t stride = scalar ? size : (size + 3) / 4 * 4;
    std::string bytes(values.size() * sizeof(T) / size * stride, '\0');
    for (std::size_t i = 0; i * size < values.size() * sizeof(T); ++i) {
      std::memcpy(bytes.data() + i * stride,
                  reinterpret_cast<const char*>(values.data()) + i * size, size);
    }
    Json accessor;
    accessor["bufferView"] = view(bytes, stride == size ? 0 : stride);
    accessor["componentType"] = component_type(T{});
    if (normalized) accessor["normalized"] = true;
    accessor["count"] = values.size() / static_cast<std::size_t>(components);
    accessor["type"] = scalar ? "SCALAR" : "VEC" + std::to_string(components);
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
  }

  /// POSITION needs bounds.
  template <typename T>
  std::size_t positions(const std::vector<T>& values, bool normalized = false) {
    const std::size_t index = accessor(values, 3, normalized);
    bound(index, std::vector<double>(values.begin(), values.end()), 3);
    return index;
  }

  /// A primitive of mesh `mesh` (made if it is the next one), with a node. Returns its object.
  Json& primitive(std::size_t mesh, const Json& attributes, int indices = -1, int mode = -1);

  [[nodiscard]] std::string glb() const;
  [[nodiscard]] std::string gltf() const;  ///< with a data URI

 private:
  static int component_type(std::int8_t) { return 5120; }
  static int component_type(std::uint8_t) { return 5121; }
  static int component_type(std::int16_t) { return 5122; }
  static int component_type(std::uint16_t) { return 5123; }
  static int component_type(std::uint32_t) { return 5125; }
  static int component_type(float) { return 5126; }
  void bound(std::size_t index, const std::vector<double>& values, std::size_t components);
};

/// Every face as it is, its corners with the UVs that `uv` says (face, corner of it).
AtlasMesh atlas_with(const Mesh& mesh, const std::function<Vec2(std::size_t, std::size_t)>& uv,
                     Wrap wrap = Wrap::none);

/// Each face cut by the line through the middles of its edges 0-1 and 2-0, and the middle of its
/// edge 1-2 inserted: a triangle and a pentagon, both with corners from `uv`.
AtlasMesh midpoint_cut(const Mesh& mesh, const std::function<Vec2(std::size_t, std::size_t)>& uv);

/// A file in a fresh folder for this test, or below $WRAPATLAS_GLTF_OUT if that is set.
std::filesystem::path output_path(const std::string& name);

/// Saves the model with `atlas` as `name` and reads the file back.
Result<Model> save_and_reload(const Model& model, const AtlasMesh& atlas, const std::string& name);

/// The container of a file that was saved.
GltfFile reopen(const std::filesystem::path& path);

/// A 1 x 1 cube of 8 shared vertices: positions, and triangles' indices.
extern const std::vector<float> kCubePositions;
extern const std::vector<std::uint16_t> kCubeIndices;

/// A grid of n x n quads in the plane, with UVs equal to its position.
struct Grid {
  explicit Grid(std::uint32_t n);
  std::vector<float> positions, uvs;
  std::vector<std::uint32_t> indices;
};

}  // namespace wrapatlas::test
