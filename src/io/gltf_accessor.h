// Accessors: typed arrays in a glTF's buffers. Opened once with every bound checked, read at will.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_json.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// componentType of the specification.
enum class GltfComponent : std::uint16_t {
  i8 = 5120,
  u8 = 5121,
  i16 = 5122,
  u16 = 5123,
  u32 = 5125,
  f32 = 5126,
};

std::size_t component_size(GltfComponent component);
/// 127 for i8 and so on: what 1.0 is in a normalized accessor. 1 for f32.
double component_one(GltfComponent component);

struct GltfAccessor {
  std::uint64_t index = 0;
  GltfComponent component = GltfComponent::f32;
  bool normalized = false;
  bool matrix = false;
  std::size_t components = 1;    ///< 3 for VEC3
  std::size_t element_size = 4;  ///< bytes; matrix columns padded as the specification wants
  std::size_t count = 0;
  std::size_t stride = 0;
  const char* data = nullptr;  ///< null: all zero but for the sparse ones

  std::size_t sparse_count = 0;
  std::size_t sparse_index_size = 0;
  const char* sparse_indices = nullptr;
  const char* sparse_values = nullptr;

  /// The bytes of element i < count.
  [[nodiscard]] const char* element(std::size_t i) const {
    if (sparse_count == 0 && data != nullptr) return data + i * stride;
    return patched_element(i);
  }
  /// Component c of an element, normalized integers already divided. Not for padded matrices.
  [[nodiscard]] double value(const char* element, std::size_t c) const;
  /// Writes what value() reads: rounded and clamped to the component type.
  void store(char* element, std::size_t c, double value) const;

 private:
  [[nodiscard]] const char* patched_element(std::size_t i) const;
};

/// Opens accessor `index`. Checks its type, that all its elements lie within the buffer, and that
/// sparse indices ascend and are in range.
Result<GltfAccessor> open_accessor(const GltfFile& file, std::uint64_t index);

/// Appends all elements (2 or 3 components wide). Error: one that is not finite or beyond 1e30.
Status read_points(const GltfFile& file, const GltfAccessor& accessor, std::vector<Vec3>& points);
Status read_points(const GltfFile& file, const GltfAccessor& accessor, std::vector<Vec2>& points);

/// The first `components` values of all elements: element i's begin at out[i * components].
void read_floats(const GltfAccessor& accessor, std::size_t components, float* out);

/// Appends first_vertex + i for all values i of an index accessor. Error: one that is not below
/// vertex_count.
Status read_indices(const GltfFile& file, const GltfAccessor& accessor, std::size_t vertex_count,
                    std::uint32_t first_vertex, std::vector<std::uint32_t>& indices);

/// "accessor 3"
std::string accessor_place(std::uint64_t index);

}  // namespace wrapatlas
