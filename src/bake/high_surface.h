// The detailed surface: where a place of the low one looks at it, and what is there.
#pragma once

#include "bake/ray_scene.h"
#include "mesh/corner_normals.h"
#include "wrapatlas/bake.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {

struct HighPoint {
  std::uint32_t triangle = kNone;
  std::array<double, 3> weights{};
  bool by_ray = true;  ///< else it is the nearest point
};

class HighSurface {
 public:
  /// Preconditions: at least one triangle; all arguments outlive it.
  static Result<HighSurface> build(const Triangulated& mesh, const BakeSource& source,
                                   double hard_angle, int threads);

  /// The nearest place along the normal, both ways, that faces as the normal does; or else the
  /// nearest point of a face that does, or of all. `normal`: a unit vector.
  [[nodiscard]] HighPoint find(const Vec3& place, const Vec3& normal, double distance) const;

  [[nodiscard]] Vec3 position(const HighPoint& point) const;
  [[nodiscard]] Vec3 normal(const HighPoint& point) const;  ///< smooth, unit
  [[nodiscard]] TextureValue color(const HighPoint& point) const;
  /// Share of rays of the hemisphere, denser towards its pole, that meet nothing up to `farthest`;
  /// 0: no end. `turn`: 0 to 1, turns the directions.
  [[nodiscard]] double openness(const HighPoint& point, int rays, double farthest,
                                std::array<double, 2> turn) const;

  [[nodiscard]] const RayScene& scene() const { return scene_; }

 private:
  HighSurface(const Triangulated& mesh, const BakeSource& source, double hard_angle, RayScene scene)
      : mesh_(&mesh.mesh),
        face_(&mesh.face_source),
        corner_(&mesh.corner_source),
        source_(&source),
        normals_(corner_normals(mesh, source.corner_normals, hard_angle)),
        scene_(std::move(scene)) {}

  [[nodiscard]] Vec3 face_normal(std::uint32_t triangle) const;

  [[nodiscard]] TextureValue texture_color(const HighPoint& point) const;
  [[nodiscard]] TextureValue corner_color(const HighPoint& point) const;

  const Mesh* mesh_;
  const std::vector<std::uint32_t>* face_;    ///< of the source, per triangle
  const std::vector<std::uint32_t>* corner_;  ///< of the source, per corner
  const BakeSource* source_;
  CornerVectors normals_;
  RayScene scene_;
};

}  // namespace wrapatlas
