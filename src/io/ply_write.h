// A PLY file with new UVs.
#pragma once

#include <string>
#include <string_view>

#include "io/ply_header.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// Which elements and properties a mesh is made of; -1 where the file has none.
struct PlyRoles {
  int vertex = -1, x = -1, y = -1, z = -1;
  int u = -1, v = -1;                   ///< UVs per vertex
  int nx = -1, ny = -1, nz = -1;        ///< normals of vertices; all three or none
  int red = -1, green = -1, blue = -1;  ///< of vertices; all three or none
  int face = -1, indices = -1;
  int texcoord = -1;  ///< UVs per corner, as MeshLab writes them; they win over u and v

  [[nodiscard]] bool uvs_on_vertices() const { return texcoord < 0 && u >= 0; }
};

/// The bytes of a PLY file with the UVs of `atlas`, in the same encoding and with all its other
/// elements, properties and comments.
///
/// UVs go where they were: to the vertices, of which one that needs several UVs is repeated with
/// all its properties, or else to a list `texcoord` per face. A cut vertex interpolates the numeric
/// properties of its sources. A type too small for new indices or list lengths becomes `uint`.
/// Fails if vertices on cut edges would be rounded to whole numbers.
Result<std::string> rewrite_ply(std::string_view bytes, const PlyHeader& header,
                                const PlyRoles& roles, const Mesh& mesh, const AtlasMesh& atlas);

}  // namespace wrapatlas
