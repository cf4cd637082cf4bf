// Numbers to and from text, the same under every locale.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace wrapatlas {

/// Coordinates of this magnitude or above are refused: see validate_mesh.
inline constexpr double kCoordinateLimit = 1e30;

/// Reads all of `text` as a decimal number; a leading '+' is fine, a number too small for a double
/// is 0. False if it is no number; a number too large comes out as infinity.
bool parse_number(std::string_view text, double& value);

/// parse_number, and the number is finite and below kCoordinateLimit in magnitude.
inline bool parse_coordinate(std::string_view text, double& value) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) {
    if (!parse_number(text, value)) return false;
  }
  return std::abs(value) < kCoordinateLimit;  // false for NaN as well
}

/// Reads all of `text` as a decimal integer; a leading '+' is fine.
bool parse_integer(std::string_view text, std::int64_t& value);

/// Appends the shortest text that reads back as the same bits.
void append_number(std::string& out, double value);
/// The same; a value that a 32-bit float holds exactly gets the shortest text that reads back as
/// that float.
void append_float(std::string& out, double value);
void append_integer(std::string& out, std::int64_t value);

}  // namespace wrapatlas
