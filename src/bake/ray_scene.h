// Rays and nearest points on a mesh of triangles, by Embree: the one place that knows it.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "wrapatlas/mesh.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// A place on a triangle mesh.
struct SurfacePoint {
  std::uint32_t triangle = kNone;
  std::array<double, 3> weights{};  ///< of its corners; they add up to 1
  double distance = 0;              ///< from where it was looked for
};

/// Holds 32-bit coordinates relative to the mesh's box: places are right to about 1e-7 of its
/// diagonal. Looking is thread safe.
class RayScene {
 public:
  /// Preconditions: triangles alone, at least one; the mesh outlives the scene. O(n log n).
  /// Error: output (Embree cannot start, no memory).
  static Result<RayScene> build(const Mesh& mesh, int threads);

  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  /// The first place along a ray, up to `farthest`. `direction`: a unit vector. With a `facing`
  /// only triangles count whose normal has a part along it; rays go through the others.
  [[nodiscard]] std::optional<SurfacePoint> first_hit(const Vec3& origin, const Vec3& direction,
                                                      double farthest,
                                                      const Vec3& facing = {}) const;
  /// Whether there is anything along a ray, up to `farthest`.
  [[nodiscard]] bool is_blocked(const Vec3& origin, const Vec3& direction, double farthest) const;
  [[nodiscard]] std::optional<SurfacePoint> nearest_point(const Vec3& place,
                                                          const Vec3& facing = {}) const;

  /// Length of the diagonal of the mesh's box.
  [[nodiscard]] double diagonal() const;

 private:
  struct Parts;
  explicit RayScene(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace wrapatlas
