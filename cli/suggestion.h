// What was meant by a name that does not exist.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace wrapatlas::cli {

/// The name that takes the fewest letters put in, left out or changed: at most a third of those
/// given, or two if that is no more than half; else empty. Of equal ones the first.
std::string nearest_name(std::string_view given, std::span<const std::string> names);

}  // namespace wrapatlas::cli
