// The judge's own triangulation of polygons.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas::validate {

/// Appends triangles of corner numbers that cover the polygon: ear clipping; convex ones and what
/// crosses itself get a fan, which covers at least what the outline winds around. O(k) for a
/// convex polygon of k corners, O(k * reflex corners) for most others, O(k^3) at worst.
void cut_into_triangles(std::span<const Vec2> polygon,
                        std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace wrapatlas::validate
