#include "mesh/corner_normals.h"

#include <algorithm>

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

}  // namespace wrapatlas
