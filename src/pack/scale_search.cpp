#include "pack/scale_search.h"

#include <algorithm>

namespace wrapatlas {

std::optional<double> search_scale(const ScaleSearchOptions& options, const ScaleAttempt& attempt,
                                   const std::function<bool()>& stop) {
  double lower = std::min(options.lower, options.upper / 2), upper = options.upper;
  std::optional<double> best;
  while (!stop()) {
    const double factor = (lower + upper) / 2;
    if (attempt(factor)) {
      best = std::max(best.value_or(0), factor);
      lower = factor;
    } else {
      upper = factor + (upper - factor) / options.sigma;
    }
    // Relative where scales are small, so that a hard set of charts still gets a fair one.
    const double tolerance = std::min(options.tolerance, upper / 10);
    if (upper - lower >= tolerance) continue;
    if (best || lower < options.smallest) break;
    lower /= 4;
  }
  return best;
}

}  // namespace wrapatlas
