// The vertices a PLY file will have with its new UVs.
#pragma once

#include <cstdint>
#include <vector>

#include "io/cut_vertices.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas {

struct PlyVertices {
  /// A vertex added after those of the file.
  struct Added {
    std::uint32_t source = kNone;     ///< the vertex it repeats, or kNone
    std::uint32_t cut_point = kNone;  ///< or the cut point it stands for
    std::uint32_t texcoord = kNone;   ///< the UV it takes; kNone: it keeps that of its source
  };
  std::vector<Added> added;
  std::vector<std::uint32_t> texcoord;       ///< per vertex of the file: as in Added
  std::vector<std::uint32_t> corner_vertex;  ///< per corner of the atlas
};

/// With `uvs_on_vertices`, vertices are repeated until each has one UV; else cut points alone are
/// added. Numbered by first use in the order of the faces. O(n log n).
PlyVertices number_ply_vertices(const Mesh& mesh, const AtlasMesh& atlas, bool uvs_on_vertices);

}  // namespace wrapatlas
