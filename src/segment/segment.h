// The surface as charts that are all within the limits.
#pragma once

#include <vector>

#include "segment/draft.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

struct Segmentation {
  std::vector<Draft> charts;   ///< by their first face; one that is not good has no other
  double flatten_seconds = 0;  ///< of all that were tried, over all threads
};

/// Every face of the surface in exactly one chart. Error: interrupted.
Result<Segmentation> segment_surface(const Surface& surface, const UnwrapOptions& options);

}  // namespace wrapatlas
