// The plane of a polygon in space.
#pragma once

#include <algorithm>
#include <cmath>

#include "mesh/perpendicular.h"
#include "wrapatlas/geometry.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas {

inline Vec3 unit(const Vec3& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Vec3{};
}

/// Of its longest side's square: what has no more area is a line but for rounding.
inline constexpr double kNoArea = 1e-12;

/// Newell's normal: its length is twice the polygon's area; zero if that is none but for rounding.
/// `point(i)` for i in [0, count).
template <typename Point>
Vec3 newell_normal(std::uint32_t count, Point&& point) {
  Vec3 sum;
  double longest2 = 0;
  const Vec3 origin = point(0);
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    const Vec3 a = point(i) - origin, b = point(i + 1) - origin;
    sum = sum + cross(a, b);
    longest2 = std::max({longest2, dot(a, a), dot(b, b)});
  }
  return length(sum) > kNoArea * longest2 ? sum : Vec3{};
}

inline Vec3 polygon_normal(const Mesh& mesh, std::uint32_t face) {
  const std::uint32_t begin = mesh.face_begin[face];
  return newell_normal(mesh.face_size(face), [&](std::uint32_t i) {
    return mesh.positions[mesh.corner_position[begin + i]];
  });
}

/// Coordinates within the plane of a normal, counter-clockwise as seen from its tip. Of no normal:
/// those of x and y.
class Plane {
 public:
  explicit Plane(const Vec3& normal) {
    const Vec3 n = unit(normal);
    if (n == Vec3{}) return;
    u_ = -1.0 * perpendicular(n);
    v_ = cross(n, u_);
  }
  [[nodiscard]] Vec2 project(const Vec3& p) const { return {dot(u_, p), dot(v_, p)}; }

 private:
  Vec3 u_{1, 0, 0}, v_{0, 1, 0};
};

}  // namespace wrapatlas
