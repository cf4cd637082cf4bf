#include "validate/stored.h"

#include <charconv>
#include <iterator>

namespace wrapatlas::validate {
namespace {

constexpr double kNinthDigit = 5e-9;

/// The float as a text that was read as a double.
template <typename... Format>
double by_text(float value, Format... format) {
  char text[48];
  const auto written = std::to_chars(std::begin(text), std::end(text), value, format...);
  double read = 0;
  std::from_chars(std::begin(text), written.ptr, read);
  return read;
}

}  // namespace

bool Stored::as_floats(double value) {
  const auto single = static_cast<float>(value);
  if (double{single} != value) in_bits_ = false;
  if (!in_bits_) {
    shortest_ = shortest_ && by_text(single) == value;
    nine_digits_ = nine_digits_ && by_text(single, std::chars_format::scientific, 8) == value;
  }
  return in_bits_ || shortest_ || nine_digits_;
}

double Stored::float_error() const {
  if (in_bits_) return kFloatHalfUnit;
  return nine_digits_ ? kFloatHalfUnit + kNinthDigit : 2 * kFloatHalfUnit;
}

}  // namespace wrapatlas::validate
