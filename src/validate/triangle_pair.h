// How two triangles in the plane lie to each other, in plain double arithmetic.
#pragma once

#include <array>

#include "wrapatlas/geometry.h"

namespace wrapatlas::validate {

using Triangle = std::array<Vec2, 3>;

/// How deep two triangles lie in each other: of the shadows of both on the normals of their six
/// edges, the shortest common piece. By the separating-axis theorem it is positive if and only if
/// the interiors meet; it is never more than the distance by which one would have to be moved to
/// leave the other, so moving corners by r and s makes at most r + s of it out of nothing. Zero if
/// it is not above `tolerance`, and for triangles without interior.
double overlap_depth(const Triangle& a, const Triangle& b, double tolerance);

/// True only if the triangles are further apart than `distance`; cheap, and not always true then.
bool surely_apart(const Triangle& a, const Triangle& b, double distance);

/// Two points, one of each triangle, that are closest, and their distance. Triangles without
/// interior count as the segment or point they are.
struct Closest {
  double distance = 0;
  Vec2 on_a, on_b;
};
Closest closest_points(const Triangle& a, const Triangle& b);

/// A point in both triangles, in the middle of what they share. Precondition: they do overlap.
Vec2 middle_of_overlap(const Triangle& a, const Triangle& b);

/// Does the triangle touch the box? May say yes for a triangle off it by rounding, never no wrongly
/// by more than that.
bool touches_box(const Triangle& t, const Box2& box);

}  // namespace wrapatlas::validate
