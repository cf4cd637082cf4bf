// What an outline winds around, without a triangulation of its corners.
#pragma once

#include <span>
#include <vector>

#include "validate/triangle_pair.h"

namespace wrapatlas::validate {

/// Appends triangles that cover the points that the polygon winds around, and its sides as
/// triangles without interior. Moving corners a little moves what is covered no more than that.
/// O(k^2 log k) for k corners.
void cover_by_slabs(std::span<const Vec2> polygon, std::vector<Triangle>& triangles);

}  // namespace wrapatlas::validate
