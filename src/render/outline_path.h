// Loose outline edges as the path of an SVG element.
#pragma once

#include <span>
#include <string>

#include "render/coverage.h"

namespace wrapatlas {

/// Chains the edges to closed sub-paths with the same winding numbers; coordinates are rounded to
/// 1/100 and written as differences. The edges must form closed loops. O(n log n).
std::string outline_path(std::span<const Segment> edges);

}  // namespace wrapatlas
