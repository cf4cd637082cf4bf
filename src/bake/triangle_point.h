// Points of triangles in space.
#pragma once

#include <array>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

using Triangle = std::array<Vec3, 3>;

/// Precondition: a mesh of triangles.
inline Triangle triangle_of(const Mesh& mesh, std::uint32_t face) {
  const std::uint32_t* corner = mesh.corner_position.data() + std::size_t{3} * face;
  return {mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]};
}

inline Vec3 point_at(const Triangle& t, const std::array<double, 3>& weights) {
  return weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
}

/// The way in space that a way in the plane is on a triangle whose corners lie at `flat` there, of
/// which the area must not be 0.
Vec3 along_surface(const Triangle& t, const std::array<Vec2, 3>& flat, Vec2 way);

/// How far a way of this length in the plane may lead in space: three times as far as it does in
/// the mean. A triangle that is stretched more says nothing of what is beside it. Precondition:
/// that of along_surface().
double farthest_along(const Triangle& t, const std::array<Vec2, 3>& flat, double way);

/// The weights of the triangle's point that is nearest to `p`. Triangles without area as well.
std::array<double, 3> nearest_weights(const Triangle& t, const Vec3& p);

}  // namespace wrapatlas
