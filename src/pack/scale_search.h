// The search for the largest scale at which a method places all charts.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pack/placer.h"

namespace wrapatlas {

struct ScaleSearchOptions {
  double lower = 0.1;  ///< the paper's l
  double upper = 1.0;  ///< the paper's u (0.9 there)
  double sigma = 3;
  double tolerance = 0.01;  ///< the paper's tau
  double smallest = 1e-3;   ///< give up when not even this succeeds
};

/// One attempt at factor f of the scale at which charts would fill the texture: true if placed.
using ScaleAttempt = std::function<bool(double factor)>;

/// Noell & Stricker 2011, section 2.2.3: an extended binary search, f = (l + u) / 2; success moves
/// l to f, failure moves u to f + (u - f) / sigma, since success is not monotone in f. Two
/// readings: the largest f that succeeded is the result, not the last one tried; and while nothing
/// has succeeded when u and l meet, l is lowered and the search goes on, down to `smallest`.
/// Returns the largest successful factor, or nothing. Stops early when `stop` is true.
std::optional<double> search_scale(const ScaleSearchOptions& options, const ScaleAttempt& attempt,
                                   const std::function<bool()>& stop);

}  // namespace wrapatlas
