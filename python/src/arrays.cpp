#include "arrays.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <type_traits>

namespace wrapatlas::python {
namespace {

static_assert(sizeof(Vec2) == 2 * sizeof(double) && sizeof(Vec3) == 3 * sizeof(double));

/// Calls `each` with all entries in order, as they are.
template <typename T, typename Each>
void for_each_entry(const AnyArray& array, const Each& each) {
  const auto* data = static_cast<const T*>(array.data());
  std::array<std::size_t, 3> size{1, 1, 1};
  std::array<std::int64_t, 3> stride{0, 0, 0};
  for (std::size_t d = 0; d < array.ndim(); ++d) {
    size[d] = array.shape(d);
    stride[d] = array.stride(d);
  }
  std::size_t number = 0;
  for (std::size_t i = 0; i < size[0]; ++i) {
    for (std::size_t j = 0; j < size[1]; ++j) {
      const T* entry = data + static_cast<std::int64_t>(i) * stride[0] +
                       static_cast<std::int64_t>(j) * stride[1];
      for (std::size_t k = 0; k < size[2]; ++k, entry += stride[2]) each(number++, *entry);
    }
  }
}

template <typename Each>
bool for_each_float(const AnyArray& array, const Each& each) {
  if (array.dtype() == nb::dtype<double>()) return for_each_entry<double>(array, each), true;
  if (array.dtype() == nb::dtype<float>()) return for_each_entry<float>(array, each), true;
  return false;
}

template <typename Each>
bool for_each_integer(const AnyArray& array, const Each& each) {
  if (array.dtype() == nb::dtype<std::int64_t>())
    return for_each_entry<std::int64_t>(array, each), true;
  if (array.dtype() == nb::dtype<std::int32_t>())
    return for_each_entry<std::int32_t>(array, each), true;
  if (array.dtype() == nb::dtype<std::uint32_t>())
    return for_each_entry<std::uint32_t>(array, each), true;
  if (array.dtype() == nb::dtype<std::uint64_t>())
    return for_each_entry<std::uint64_t>(array, each), true;
  return false;
}

/// Python's side hands over no other types.
[[noreturn]] void refuse_type(const std::string& name) {
  raise(usage(name, "its dtype is not one that is read", "pass float64, or int64 for indices"));
}

}  // namespace

std::string shape_text(const AnyArray& array) {
  std::string text = "(";
  for (std::size_t d = 0; d < array.ndim(); ++d) {
    text += fmt::format("{}{}", d == 0 ? "" : ", ", array.shape(d));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

namespace {

template <typename Vector, std::size_t Columns>
std::vector<Vector> read_vectors(const AnyArray& array, const std::string& name) {
  if (array.ndim() != 2 || array.shape(1) != Columns) {
    raise(usage(name, fmt::format("its shape is {}", shape_text(array)),
                fmt::format("pass (N, {})", Columns)));
  }
  std::vector<Vector> vectors(array.shape(0));
  auto* values = reinterpret_cast<double*>(vectors.data());
  if (!for_each_float(array, [&](std::size_t i, auto v) { values[i] = double(v); })) {
    refuse_type(name);
  }
  return vectors;
}

}  // namespace

std::vector<Vec2> read_vec2(const AnyArray& array, const std::string& name) {
  return read_vectors<Vec2, 2>(array, name);
}

std::vector<Vec3> read_vec3(const AnyArray& array, const std::string& name) {
  return read_vectors<Vec3, 3>(array, name);
}

std::vector<std::uint32_t> read_indices(const AnyArray& array, const std::string& name,
                                        std::size_t count, const std::string& what) {
  const std::uint64_t limit = std::min<std::uint64_t>(count, kNone);
  if (array.size() >= kNone) raise(usage(name, "it is too long", "pass fewer than 2^32 entries"));
  std::vector<std::uint32_t> indices(array.size());
  std::size_t first_bad = array.size();
  std::string bad;
  const bool known = for_each_integer(array, [&](std::size_t i, auto index) {
    using Index = decltype(index);
    bool out = static_cast<std::uint64_t>(index) >= limit;
    if constexpr (std::is_signed_v<Index>) out = out || index < 0;
    if (out && first_bad == array.size()) {
      first_bad = i;
      bad = fmt::format("{}", index);
    }
    indices[i] = static_cast<std::uint32_t>(index);
  });
  if (!known) refuse_type(name);
  if (first_bad == array.size()) return indices;
  const std::size_t row = array.ndim() == 2 ? array.shape(1) : 1;
  const std::string place = array.ndim() == 2
                                ? fmt::format("{}[{}, {}]", name, first_bad / row, first_bad % row)
                                : fmt::format("{}[{}]", name, first_bad);
  const std::string range = count == 0
                                ? fmt::format("there are no {}", what)
                                : fmt::format("there are {} {}, numbered from 0", count, what);
  raise(bad_input(place, fmt::format("index {} is out of range", bad), range));
}

Texture read_texture(const AnyArray& array, const std::string& name) {
  constexpr std::size_t kMostSide = 65536;
  const std::size_t channels = array.ndim() == 3 ? array.shape(2) : 1;
  const bool is_picture = (array.ndim() == 2 || array.ndim() == 3) && array.shape(0) > 0 &&
                          array.shape(1) > 0 && array.shape(0) <= kMostSide &&
                          array.shape(1) <= kMostSide && channels >= 1 && channels <= kMostChannels;
  if (!is_picture) {
    raise(usage(name, fmt::format("its shape is {}", shape_text(array)),
                "pass (height, width) or (height, width, channels), of 1 to 4 channels and at most "
                "65536 a side"));
  }
  Texture texture(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
                  static_cast<int>(channels));
  float* values = texture.values.data();
  const auto scaled = [&](float scale) {
    return [values, scale](std::size_t i, auto v) { values[i] = static_cast<float>(v) / scale; };
  };
  if (array.dtype() == nb::dtype<std::uint8_t>()) {
    for_each_entry<std::uint8_t>(array, scaled(255));
  } else if (array.dtype() == nb::dtype<std::uint16_t>()) {
    for_each_entry<std::uint16_t>(array, scaled(65535));
  } else if (!for_each_float(array, scaled(1))) {
    raise(usage(name, "its dtype is not one of pixels", "pass uint8, uint16 or float32"));
  }
  return texture;
}

nb::ndarray<nb::numpy, float> own(Texture texture) {
  const std::vector<std::size_t> shape{static_cast<std::size_t>(texture.height),
                                       static_cast<std::size_t>(texture.width),
                                       static_cast<std::size_t>(texture.channels)};
  return own(std::move(texture.values), shape);
}

}  // namespace wrapatlas::python
