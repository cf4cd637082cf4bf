// The triangles of a mesh that can be part of a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

struct SurfaceTriangles {
  Mesh mesh;  ///< the positions and texcoords of the source; a face has UVs at all corners or at
              ///< none
  std::vector<std::uint32_t> source;  ///< per triangle: the face
  std::uint32_t dropped = 0;          ///< triangles that use a point twice
};

/// In an order in which what is near in space is near in memory. O(n log n).
SurfaceTriangles surface_triangles(const Mesh& mesh);

}  // namespace wrapatlas
