#include "settings.h"

#include <cmath>

namespace wrapatlas::python {

std::string shown(nb::handle value) {
  constexpr std::size_t kLongest = 60;
  std::string text = nb::cast<std::string>(nb::repr(value));
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

double number_from(const char* name, nb::handle value, Range range, bool whole) {
  const double number = PyBool_Check(value.ptr()) ? std::nan("") : PyFloat_AsDouble(value.ptr());
  const bool none = PyErr_Occurred() != nullptr;
  if (none) PyErr_Clear();
  const bool usable = !none && std::isfinite(number);
  if (usable && number >= range.low && number <= range.high &&
      (!whole || number == std::floor(number))) {
    return number;
  }
  raise(usage(fmt::format("{}={}", name, shown(value)),
              !usable                                     ? "not a number"
              : number < range.low || number > range.high ? "out of range"
                                                          : "not a whole number",
              fmt::format("give a {}number{}{} from {} to {}", whole ? "whole " : "",
                          *range.unit == 0 ? "" : " of ", range.unit, range.low, range.high)));
}

}  // namespace wrapatlas::python
