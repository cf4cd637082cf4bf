// Convex hulls and the two directions that packers read off them.
#pragma once

#include <span>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// Corners of the convex hull, counter-clockwise, no three on a line. O(n log n).
std::vector<Vec2> convex_hull(std::span<const Vec2> points);

/// Of a hull of fewer than three corners 0.
double hull_area(std::span<const Vec2> hull);

/// Direction (radians, in (-pi, pi]) of the longest distance between two corners of a hull; of
/// equal ones that of the first pair of corners. By rotating calipers (Shamos 1978), O(corners).
double diameter_direction(std::span<const Vec2> hull);

/// Direction (radians) of a side of the smallest-area rectangle around a hull. Such a rectangle
/// has a side along an edge of the hull (Freeman & Shapira 1975). By rotating calipers, O(corners).
double smallest_box_direction(std::span<const Vec2> hull);

/// Side of a square around a hull, at most 0.4 % larger than that of the smallest one. O(corners).
double square_side(std::span<const Vec2> hull);

}  // namespace wrapatlas
