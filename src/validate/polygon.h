// What a polygon covers: the judge's own triangles.
#pragma once

#include <span>
#include <vector>

#include "validate/triangle_pair.h"

namespace wrapatlas::validate {

/// Appends triangles that cover the polygon, in the same place however it is turned or rounded:
/// ears, or where rounding leaves none, slabs of what the outline winds around, and the outline.
/// If sides cross, and would do so even with all corners moved by `rounding`, programs differ in
/// what they fill: then it is the convex hull, in which all their triangles lie, and the answer is
/// true. O(k) for a convex polygon of k corners, O(k * reflex corners + pairs of sides side by
/// side) for most others, O(k^3) at worst.
bool cover_polygon(std::span<const Vec2> polygon, double rounding,
                   std::vector<Triangle>& triangles);

}  // namespace wrapatlas::validate
