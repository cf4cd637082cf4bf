// Straight ahead over a mesh of triangles: over an edge as if both its faces lay in one plane.
#pragma once

#include <array>
#include <vector>

#include "bake/triangle_point.h"
#include "wrapatlas/result.h"
#include "wrapatlas/surface.h"

namespace wrapatlas {

/// Where a walk came to.
struct WalkEnd {
  std::uint32_t triangle = kNone;
  std::array<double, 3> weights{};                                        ///< of its corners
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< as carried along

  /// A vector that was carried along.
  [[nodiscard]] Vec3 carried(const Vec3& v) const {
    return v.x * axes[0] + v.y * axes[1] + v.z * axes[2];
  }
};

class SurfaceWalk {
 public:
  /// Of triangles alone. Errors: those of build_surface.
  static Result<SurfaceWalk> build(const Mesh& triangles);

  /// From a point of a triangle by a vector in its plane. Ends at the border of the surface, and
  /// where it meets a triangle without area. Thread safe. O(triangles on the way).
  [[nodiscard]] WalkEnd go(std::uint32_t triangle, const std::array<double, 3>& weights,
                           const Vec3& by) const;

 private:
  explicit SurfaceWalk(Surface surface, std::size_t triangles);
  [[nodiscard]] Triangle corners(std::uint32_t face) const;

  Surface surface_;
  std::vector<std::uint32_t> face_of_;  ///< per triangle of the mesh: of the surface, or kNone
};

}  // namespace wrapatlas
