#include "io/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace wrapatlas {
namespace {

template <typename T>
T load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <typename T>
void save(char* bytes, double value) {
  const double low = static_cast<double>(std::numeric_limits<T>::min());
  const double high = static_cast<double>(std::numeric_limits<T>::max());
  const double number = value >= low ? std::min(std::nearbyint(value), high) : low;  // NaN: low
  const T rounded = static_cast<T>(number);
  std::memcpy(bytes, &rounded, sizeof rounded);
}

std::uint32_t load_unsigned(const char* bytes, std::size_t size) {
  if (size == 1) return load<std::uint8_t>(bytes);
  if (size == 2) return load<std::uint16_t>(bytes);
  return load<std::uint32_t>(bytes);
}

struct Shape {
  const char* name;
  std::size_t rows, columns;
};
constexpr Shape kShapes[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
                             {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};

/// The bytes of a buffer view from `offset` on; nothing if they are fewer than `needed`.
std::optional<std::string_view> view_bytes(const GltfFile& file, const Json& view,
                                           std::uint64_t offset, std::uint64_t needed) {
  const std::string_view buffer = file.buffers[*integer_member(view, "buffer", 0)].bytes;
  const std::string_view bytes =
      buffer.substr(*integer_member(view, "byteOffset", 0), *integer_member(view, "byteLength", 0));
  if (offset > bytes.size() || needed > bytes.size() - offset) return std::nullopt;
  return bytes.substr(offset);
}

const Json* view_of(const GltfFile& file, const Json& holder) {
  const Json* index = find_member(holder, "bufferView");
  if (index == nullptr) return nullptr;
  const std::uint64_t number = as_integer(*index).value_or(~std::uint64_t{0});
  const Json& views = array_member(file.json, "bufferViews");
  return number < views.size() ? &views[number] : nullptr;
}

Status open_sparse(const GltfFile& file, const Json& sparse, GltfAccessor& accessor) {
  const std::string place = accessor_place(accessor.index);
  const auto count = integer_member(sparse, "count", 0);
  const Json* indices = find_member(sparse, "indices");
  const Json* values = find_member(sparse, "values");
  if (!count || *count > accessor.count || indices == nullptr || values == nullptr) {
    return file.error(place, "its sparse part is incomplete");
  }
  const auto type = integer_member(*indices, "componentType", 0);
  if (!type || (*type != 5121 && *type != 5123 && *type != 5125)) {
    return file.error(place, "its sparse indices have a wrong type");
  }
  accessor.sparse_count = *count;
  accessor.sparse_index_size = component_size(static_cast<GltfComponent>(*type));
  const auto part = [&](const Json& holder,
                        std::uint64_t element) -> std::optional<std::string_view> {
    const Json* view = view_of(file, holder);
    const auto offset = integer_member(holder, "byteOffset", 0);
    if (view == nullptr || !offset) return std::nullopt;
    return view_bytes(file, *view, *offset, *count * element);
  };
  const auto index_bytes = part(*indices, accessor.sparse_index_size);
  const auto value_bytes = part(*values, accessor.element_size);
  if (!index_bytes || !value_bytes) {
    return file.error(place, "its sparse part lies outside of its bufferView");
  }
  accessor.sparse_indices = index_bytes->data();
  accessor.sparse_values = value_bytes->data();
  std::uint64_t smallest = 0;
  for (std::size_t i = 0; i < accessor.sparse_count; ++i) {
    const std::uint64_t at = load_unsigned(accessor.sparse_indices + i * accessor.sparse_index_size,
                                           accessor.sparse_index_size);
    if (at < smallest || at >= accessor.count) {
      return file.error(place, fmt::format("its sparse index {} is out of order or range", i));
    }
    smallest = at + 1;
  }
  return Done{};
}

/// Calls `work` with a value of the C++ type of the component, so that loops over elements are
/// compiled for each type.
template <typename Work>
auto with_type_of(GltfComponent component, const Work& work) {
  switch (component) {
    case GltfComponent::i8:
      return work(std::int8_t{});
    case GltfComponent::u8:
      return work(std::uint8_t{});
    case GltfComponent::i16:
      return work(std::int16_t{});
    case GltfComponent::u16:
      return work(std::uint16_t{});
    case GltfComponent::u32:
      return work(std::uint32_t{});
    default:
      return work(float{});
  }
}

template <typename T>
double decoded(const char* bytes, bool normalized) {
  const auto number = static_cast<double>(load<T>(bytes));
  if (std::is_floating_point_v<T> || !normalized) return number;
  return std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

/// What a float attribute of the same value holds: vertices of primitives with floats and of such
/// with integers meet, and so do those that a cut made floats of.
template <typename T>
double coordinate(const char* bytes, bool normalized) {
  return double{static_cast<float>(decoded<T>(bytes, normalized))};
}

template <typename T, typename Point>
Status append_points(const GltfFile& file, const GltfAccessor& accessor,
                     std::vector<Point>& points) {
  for (std::size_t i = 0; i < accessor.count; ++i) {
    const char* element = accessor.element(i);
    Point point{};
    point.x = coordinate<T>(element, accessor.normalized);
    point.y = coordinate<T>(element + sizeof(T), accessor.normalized);
    bool usable = std::abs(point.x) < 1e30 && std::abs(point.y) < 1e30;
    if constexpr (std::is_same_v<Point, Vec3>) {
      point.z = coordinate<T>(element + 2 * sizeof(T), accessor.normalized);
      usable = usable && std::abs(point.z) < 1e30;
    }
    if (!usable) {
      return file.error(accessor_place(accessor.index),
                        fmt::format("element {} is not a usable number", i),
                        "export the model again without NaN, infinite or huge values");
    }
    points.push_back(point);
  }
  return Done{};
}

template <typename Point>
Status read_all(const GltfFile& file, const GltfAccessor& accessor, std::vector<Point>& points) {
  const std::size_t total = points.size() + accessor.count;
  if (total > points.capacity()) points.reserve(std::max(total, points.capacity() * 2));
  return with_type_of(accessor.component, [&](auto type) {
    return append_points<decltype(type)>(file, accessor, points);
  });
}

}  // namespace

std::size_t component_size(GltfComponent component) {
  switch (component) {
    case GltfComponent::i8:
    case GltfComponent::u8:
      return 1;
    case GltfComponent::i16:
    case GltfComponent::u16:
      return 2;
    default:
      return 4;
  }
}

double component_one(GltfComponent component) {
  switch (component) {
    case GltfComponent::i8:
      return 127;
    case GltfComponent::u8:
      return 255;
    case GltfComponent::i16:
      return 32767;
    case GltfComponent::u16:
      return 65535;
    case GltfComponent::u32:
      return 4294967295.0;
    default:
      return 1;
  }
}

std::string accessor_place(std::uint64_t index) { return fmt::format("accessor {}", index); }

double GltfAccessor::value(const char* element, std::size_t c) const {
  const char* at = element + c * component_size(component);
  return with_type_of(component,
                      [&](auto type) { return decoded<decltype(type)>(at, normalized); });
}

void GltfAccessor::store(char* element, std::size_t c, double value) const {
  char* at = element + c * component_size(component);
  if (component == GltfComponent::f32) {
    const auto rounded = static_cast<float>(value);
    std::memcpy(at, &rounded, sizeof rounded);
    return;
  }
  const double number = normalized ? value * component_one(component) : value;
  switch (component) {
    case GltfComponent::i8:
      save<std::int8_t>(at, number);
      break;
    case GltfComponent::u8:
      save<std::uint8_t>(at, number);
      break;
    case GltfComponent::i16:
      save<std::int16_t>(at, number);
      break;
    case GltfComponent::u16:
      save<std::uint16_t>(at, number);
      break;
    default:
      save<std::uint32_t>(at, number);
      break;
  }
}

const char* GltfAccessor::patched_element(std::size_t i) const {
  static constexpr char kZeros[64] = {};
  std::size_t low = 0, high = sparse_count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const std::size_t at =
        load_unsigned(sparse_indices + middle * sparse_index_size, sparse_index_size);
    if (at == i) return sparse_values + middle * element_size;
    if (at < i) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return data != nullptr ? data + i * stride : kZeros;
}

Result<GltfAccessor> open_accessor(const GltfFile& file, std::uint64_t index) {
  const Json& accessors = array_member(file.json, "accessors");
  const std::string place = accessor_place(index);
  if (index >= accessors.size()) {
    return file.error(place, fmt::format("there are only {} accessors", accessors.size()));
  }
  const Json& json = accessors[index];
  GltfAccessor accessor;
  accessor.index = index;

  const auto type = integer_member(json, "componentType", 0);
  if (!type || *type < 5120 || *type > 5126 || *type == 5124) {
    return file.error(place, "its componentType is unknown");
  }
  accessor.component = static_cast<GltfComponent>(*type);
  const Json* shape_name = find_member(json, "type");
  const Shape* shape = nullptr;
  for (const Shape& known : kShapes) {
    if (shape_name != nullptr && *shape_name == known.name) shape = &known;
  }
  if (shape == nullptr) return file.error(place, "its type is unknown");
  accessor.matrix = shape->columns > 1;
  accessor.components = shape->rows * shape->columns;
  const std::size_t column = shape->rows * component_size(accessor.component);
  accessor.element_size = accessor.matrix ? (column + 3) / 4 * 4 * shape->columns : column;
  const Json* normalized = find_member(json, "normalized");
  accessor.normalized = normalized != nullptr && *normalized == true;

  const auto count = integer_member(json, "count", 0);
  const auto offset = integer_member(json, "byteOffset", 0);
  if (!count || *count == 0 || *count > file.byte_count || !offset) {
    return file.error(place, "its count or byteOffset is missing or out of range");
  }
  accessor.count = *count;
  if (find_member(json, "bufferView") != nullptr) {
    const Json* view = view_of(file, json);
    if (view == nullptr) return file.error(place, "its bufferView does not exist");
    accessor.stride = *integer_member(*view, "byteStride", accessor.element_size);
    if (accessor.stride < accessor.element_size) {
      return file.error(place, "its elements are longer than the byteStride of its bufferView");
    }
    const std::uint64_t needed = accessor.stride * (*count - 1) + accessor.element_size;
    const auto bytes = view_bytes(file, *view, *offset, needed);
    if (!bytes) {
      return file.error(place, fmt::format("its {} elements end beyond its bufferView", *count));
    }
    accessor.data = bytes->data();
  }
  if (const Json* sparse = find_member(json, "sparse")) {
    const Status opened = open_sparse(file, *sparse, accessor);
    if (!opened) return opened.error();
  }
  return accessor;
}

Status read_points(const GltfFile& file, const GltfAccessor& accessor, std::vector<Vec3>& points) {
  return read_all(file, accessor, points);
}

Status read_points(const GltfFile& file, const GltfAccessor& accessor, std::vector<Vec2>& points) {
  return read_all(file, accessor, points);
}

void read_floats(const GltfAccessor& accessor, std::size_t components, float* out) {
  with_type_of(accessor.component, [&](auto type) {
    for (std::size_t i = 0; i < accessor.count; ++i) {
      const char* element = accessor.element(i);
      for (std::size_t c = 0; c < components; ++c) {
        *out++ = static_cast<float>(
            decoded<decltype(type)>(element + c * sizeof type, accessor.normalized));
      }
    }
  });
}

Status read_indices(const GltfFile& file, const GltfAccessor& accessor, std::size_t vertex_count,
                    std::uint32_t first_vertex, std::vector<std::uint32_t>& indices) {
  const std::string place = accessor_place(accessor.index);
  const bool is_unsigned = accessor.component == GltfComponent::u8 ||
                           accessor.component == GltfComponent::u16 ||
                           accessor.component == GltfComponent::u32;
  if (!is_unsigned || accessor.components != 1 || accessor.normalized) {
    return file.error(place, "it holds indices, but its type is not for them");
  }
  const std::size_t begin = indices.size();
  indices.resize(begin + accessor.count);
  const auto append = [&](auto type) -> Status {
    for (std::size_t i = 0; i < accessor.count; ++i) {
      const std::uint32_t index = load<decltype(type)>(accessor.element(i));
      if (index >= vertex_count) {
        return file.error(place,
                          fmt::format("index {} is vertex {} of {}", i, index, vertex_count));
      }
      indices[begin + i] = first_vertex + index;
    }
    return Done{};
  };
  if (accessor.element_size == 1) return append(std::uint8_t{});
  return accessor.element_size == 2 ? append(std::uint16_t{}) : append(std::uint32_t{});
}

}  // namespace wrapatlas
