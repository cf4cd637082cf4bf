// NumPy's arrays in and out.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <string>
#include <vector>

#include "failures.h"
#include "wrapatlas/geometry.h"
#include "wrapatlas/texture.h"

namespace wrapatlas::python {

/// Any type, any strides; may be read-only.
using AnyArray = nb::ndarray<nb::ro, nb::device::cpu>;

/// What we hand out: arrays that show our memory.
template <typename T, int Dimensions>
using View = nb::ndarray<nb::numpy, const T, nb::ndim<Dimensions>>;

/// Rows of numbers: 32- or 64-bit floats. `name` is for errors.
std::vector<Vec2> read_vec2(const AnyArray& array, const std::string& name);
std::vector<Vec3> read_vec3(const AnyArray& array, const std::string& name);

/// All entries in order, 32- or 64-bit integers, each from 0 to count - 1: indices of `what`.
std::vector<std::uint32_t> read_indices(const AnyArray& array, const std::string& name,
                                        std::size_t count, const std::string& what);

/// Pixels: (rows, columns) or (rows, columns, channels) of 8- or 16-bit integers, or of floats.
Texture read_texture(const AnyArray& array, const std::string& name);

/// "(12, 3)"
std::string shape_text(const AnyArray& array);

template <typename T>
View<T, 1> view_of(const std::vector<T>& values) {
  return View<T, 1>(values.data(), {values.size()});
}
inline View<double, 2> view_of(const std::vector<Vec2>& values) {
  return View<double, 2>(reinterpret_cast<const double*>(values.data()), {values.size(), 2});
}
inline View<double, 2> view_of(const std::vector<Vec3>& values) {
  return View<double, 2>(reinterpret_cast<const double*>(values.data()), {values.size(), 3});
}
template <typename T>
View<T, 2> rows_of(const std::vector<T>& values, std::size_t columns) {
  return View<T, 2>(values.data(), {values.size() / columns, columns});
}

/// An array that owns its memory, and may be written to.
template <typename T>
nb::ndarray<nb::numpy, T> own(std::vector<T> values, const std::vector<std::size_t>& shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(
      kept, [](void* memory) noexcept { delete static_cast<std::vector<T>*>(memory); });
  return nb::ndarray<nb::numpy, T>(kept->data(), shape.size(), shape.data(), owner);
}

/// (rows, columns, channels), 32-bit floats.
nb::ndarray<nb::numpy, float> own(Texture texture);

}  // namespace wrapatlas::python
