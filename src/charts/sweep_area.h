// Areas of overlap between closed outlines, by a sweep over slabs.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// A directed edge of one or both of two layers; `winding` says how often it belongs to each. The
/// edges of a layer form closed loops.
struct SweepEdge {
  Vec2 from, to;
  std::array<std::int32_t, 2> winding{};
};

/// What is measured at a point where the layers' winding numbers are c0 and c1.
enum class Measure {
  repeated,  ///< max(|c0| - 1, 0): how often layer 0 covers the point beyond the first time
  shared,    ///< 1 where c0 and c1 are both not 0
};

/// Integral of the measure over `window`'s x or y range (whichever is the cheaper sweep): pass the
/// box of all edges for the whole plane, or a box outside which the measure is 0. Returns early
/// with a value above `enough`. Exact up to rounding; O(E log E + E * A + K log K) for A edges on
/// one sweep line and K crossings. Where that is more than 4e7 steps the sweep line stops at evenly
/// spaced places only: bounded time, and an error that is no longer rounding (about 1e-4). What
/// the measure is 0 everywhere for remains 0 even then.
double sweep_area(const std::vector<SweepEdge>& edges, Measure measure, const Box2& window,
                  double enough = std::numeric_limits<double>::infinity());

}  // namespace wrapatlas
