// Flipped triangles in a flattened chart, turned back by moving single points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// Moves points of triangles that have no or negative area, towards the middle of their neighbours
/// as far as that makes the least area around them larger, until none is left or nothing helps.
/// Returns how many are left. Ours: angle based flattening leaves a handful among thousands where
/// a part shrinks, and a point or two out of place is what is wrong with them.
std::uint32_t untangle(std::span<Vec2> uv, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace wrapatlas
