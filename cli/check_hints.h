// What a user of `wrapatlas check` probably forgot: the promise is not in the file.
#pragma once

#include <string>
#include <vector>

#include "wrapatlas/validate.h"

namespace wrapatlas::cli {

/// Which parts of the promise were given, rather than taken from the defaults.
struct GivenPromise {
  bool wrap = false, resolution = false, padding = false;
};

/// One line each, with the option that would help. Checks again with it where that tells: at most
/// six times, and only if there are violations.
std::vector<std::string> check_hints(const Mesh& atlas, const Mesh* reference,
                                     const CheckOptions& options, const CheckReport& report,
                                     GivenPromise given);

/// What the options at hand leave unchecked.
std::vector<std::string> unchecked(bool has_reference, const CheckOptions& options,
                                   GivenPromise given);

}  // namespace wrapatlas::cli
