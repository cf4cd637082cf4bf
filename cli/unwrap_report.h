// What `wrapatlas unwrap` says about its work, before the charts are packed.
#pragma once

#include <string>

#include "common.h"
#include "options.h"
#include "wrapatlas/unwrap.h"

namespace wrapatlas::cli {

struct Worst {
  double l2 = 0, linf = 0;
  std::size_t bad = 0;  ///< charts beyond the limits
};
Worst worst_of(const Unwrapping& unwrapping);

/// What was mended on the way in, and what could not be had.
void print_unwrap_notes(const std::string& input, const UnwrapOptions& options,
                        const Unwrapping& unwrapping);

Json unwrap_json(const UnwrapOptions& options, const Unwrapping& unwrapping);

}  // namespace wrapatlas::cli
