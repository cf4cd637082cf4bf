// Polygons that cross themselves.
#pragma once

#include <span>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas::validate {

/// Do two sides cross each other, and still do so when every corner moves by `rounding`? O(k) more
/// than the number of pairs of sides that lie above each other.
bool crosses_itself(std::span<const Vec2> polygon, double rounding);

/// Corners of the convex hull, counter-clockwise.
std::vector<Vec2> hull_of(std::span<const Vec2> points);

}  // namespace wrapatlas::validate
