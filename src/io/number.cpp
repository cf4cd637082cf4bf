#include "io/number.h"

#include <algorithm>
#include <limits>

namespace wrapatlas {
namespace {

// Of a well-formed number that does not fit a double: is it below the range rather than above?
// Decided by the decimal exponent of its first significant digit.
bool is_tiny(std::string_view text) {
  const std::size_t mark = text.find_first_of("eE");
  const std::string_view digits = text.substr(0, mark);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return true;
  double magnitude = static_cast<double>(point) - static_cast<double>(first);
  if (mark != std::string_view::npos) {
    const std::string_view exponent = text.substr(mark + 1);
    std::int64_t power = 0;
    if (parse_integer(exponent, power)) {
      magnitude += static_cast<double>(power);
    } else {  // an exponent beyond 64 bits
      return exponent.front() == '-';
    }
  }
  return magnitude < 0;
}

template <typename T>
void append_chars(std::string& out, T value) {
  char buffer[40];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  out.append(buffer, error == std::errc() ? end : buffer);
}

}  // namespace

bool parse_number(std::string_view text, double& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return false;
  if (error == std::errc::result_out_of_range) {
    value = is_tiny(text) ? 0 : std::numeric_limits<double>::infinity();
    return true;
  }
  return error == std::errc();
}

bool parse_integer(std::string_view text, std::int64_t& value) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void append_number(std::string& out, double value) { append_chars(out, value + 0.0); }

void append_float(std::string& out, double value) {
  const auto single = static_cast<float>(value);
  if (static_cast<double>(single) == value) {
    append_chars(out, single + 0.0F);
  } else {
    append_number(out, value);
  }
}

void append_integer(std::string& out, std::int64_t value) { append_chars(out, value); }

}  // namespace wrapatlas
