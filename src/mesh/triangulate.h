// A mesh of triangles alone.
#pragma once

#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

struct Triangulated {
  Mesh mesh;                                 ///< positions and texcoords as in the source
  std::vector<std::uint32_t> corner_source;  ///< per corner: the source's
  std::vector<std::uint32_t> face_source;    ///< per triangle: the source's face; ascending
};

/// Each face cut into size - 2 triangles, by ear clipping in its plane. O(corners) for triangles.
Triangulated triangulated(const Mesh& mesh);

}  // namespace wrapatlas
