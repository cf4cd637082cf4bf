// The triangles that a face takes up in the texture.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// Appends triangles of corner offsets that cover the polygon. Programs differ in how they
/// triangulate one whose sides cross each other, so such a polygon takes up its convex hull, in
/// which all their triangles lie; true if it is one. O(k^2) for k corners.
bool cover_face(std::span<const Vec2> polygon,
                std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace wrapatlas
