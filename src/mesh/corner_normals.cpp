#include "mesh/corner_normals.h"

#include <algorithm>
#include <utility>

namespace wrapatlas {

CornerVectors corner_normals(const Triangulated& triangles, std::span<const Vec3> given,
                             double hard_angle) {
  const auto has_none = [](const Vec3& normal) { return normal == Vec3{}; };
  CornerVectors normals;
  if (given.empty() || std::any_of(given.begin(), given.end(), has_none)) {
    normals = smooth_normals(triangles.mesh, hard_angle);
  }
  if (given.empty()) return normals;
  normals.resize(triangles.mesh.corner_count());
  for (std::size_t c = 0; c < normals.size(); ++c) {
    const Vec3& own = given[triangles.corner_source[c]];
    if (!has_none(own)) normals[c] = own;
  }
  return normals;
}

TangentFrames corner_frames(const Triangulated& triangles, CornerVectors normals,
                            std::span<const CornerTangent> given, bool v_points_down) {
  TangentFrames frames = tangent_frames(triangles.mesh, std::move(normals), v_points_down);
  if (given.empty()) return frames;
  for (std::size_t c = 0; c < frames.tangent.size(); ++c) {
    const CornerTangent& own = given[triangles.corner_source[c]];
    if (own.direction == Vec3{}) continue;
    frames.tangent[c] = own.direction;
    frames.sign[c] = own.sign;
  }
  return frames;
}

}  // namespace wrapatlas
