// The surface that is baked onto: where a sample of a texel is in space, and along which axes.
#pragma once

#include "bake/texel_samples.h"
#include "bake/triangle_point.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {

struct LowPoint {
  Vec3 position, normal;
  Vec3 tangent, bitangent;
};

class LowSurface {
 public:
  /// Precondition: triangles alone.
  LowSurface(const Mesh& mesh, double hard_angle, bool v_points_down)
      : mesh_(mesh),
        frames_(tangent_frames(mesh, smooth_normals(mesh, hard_angle), v_points_down)) {}

  /// `on_texels`: the triangle's corners in texels (TexelSamples::corners).
  [[nodiscard]] LowPoint at(const TexelSample& sample, const std::array<Vec2, 3>& on_texels) const;

 private:
  const Mesh& mesh_;
  TangentFrames frames_;
};

}  // namespace wrapatlas
