// The surface as charts that are all within the limits.
#pragma once

#include <vector>

#include "segment/draft.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// Every face of the surface in exactly one draft; drafts by their first face. A draft that is not
/// good has one face. Error: interrupted.
Result<std::vector<Draft>> segment_surface(const Surface& surface, const UnwrapOptions& options);

}  // namespace wrapatlas
