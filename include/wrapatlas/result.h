// Errors as values: every fallible function of the library returns a Result.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace wrapatlas {

/// What went wrong, coarsely. The command maps each kind to an exit status.
enum class ErrorKind {
  usage,        ///< options that contradict each other or are out of range
  input,        ///< a file or an array that cannot be read or used
  output,       ///< a file that cannot be written
  no_packing,   ///< no scale was found at which everything fits
  check,        ///< a finished atlas breaks a promise
  interrupted,  ///< stopped by the user before there was any result
};

/// One error: where it is (file, line, accessor, chart ...), what is wrong, and the way out.
struct Error {
  ErrorKind kind = ErrorKind::input;
  std::string where;   ///< "model.obj:17", "chart 4"; may be empty
  std::string what;    ///< "face refers to vertex 9 of 8"
  std::string remedy;  ///< "export the mesh again"; may be empty
  /// no_packing at PackOptions::density, as a chart is too large: a density that would fit. Else 0.
  double density_that_fits = 0;

  /// All of it on one line: "where: what; remedy".
  [[nodiscard]] std::string message() const {
    std::string line = where.empty() ? what : where + ": " + what;
    if (!remedy.empty()) line += "; " + remedy;
    return line;
  }
};

/// A value of type T, or the Error that kept it from being made.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(value()); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  /// Precondition: there is a value.
  T& value() {
    assert(state_.index() == 0);
    return *std::get_if<0>(&state_);
  }
  const T& value() const {
    assert(state_.index() == 0);
    return *std::get_if<0>(&state_);
  }
  /// Precondition: there is no value.
  [[nodiscard]] const Error& error() const {
    assert(state_.index() == 1);
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, Error> state_;
};

/// The result of an action that yields nothing but success.
struct Done {};
using Status = Result<Done>;

}  // namespace wrapatlas
