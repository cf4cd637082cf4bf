// The library's errors as Python's exceptions.
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <utility>

#include "wrapatlas/result.h"

namespace wrapatlas::python {

namespace nb = nanobind;

/// Raises what wrapatlas._errors makes of it. The interpreter's lock must be held.
[[noreturn]] void raise(const Error& error);

/// The value, or raises the error.
template <typename T>
T take(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(*result);
}

inline Error usage(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::usage, std::move(where), std::move(what), std::move(remedy)};
}
inline Error bad_input(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::input, std::move(where), std::move(what), std::move(remedy)};
}

}  // namespace wrapatlas::python
