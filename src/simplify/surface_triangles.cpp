#include "simplify/surface_triangles.h"

#include "mesh/triangulate.h"

namespace wrapatlas {

SurfaceTriangles surface_triangles(const Mesh& mesh) {
  Triangulated all = triangulated(mesh);
  SurfaceTriangles result;
  Mesh& kept = result.mesh;
  kept.positions = std::move(all.mesh.positions);
  kept.texcoords = std::move(all.mesh.texcoords);
  for (std::uint32_t t = 0; t < all.face_source.size(); ++t) {
    const std::uint32_t* position = all.mesh.corner_position.data() + std::size_t{3} * t;
    const Vec3 a = kept.positions[position[0]], b = kept.positions[position[1]];
    const Vec3 c = kept.positions[position[2]];
    if (a == b || b == c || c == a) {
      ++result.dropped;
      continue;
    }
    const std::uint32_t face = all.face_source[t];
    bool has_uvs = true;
    for (std::uint32_t i = mesh.face_begin[face]; i < mesh.face_begin[face + 1]; ++i) {
      has_uvs = has_uvs && mesh.corner_texcoord[i] != kNone;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      kept.corner_position.push_back(position[i]);
      kept.corner_texcoord.push_back(has_uvs ? all.mesh.corner_texcoord[std::size_t{3} * t + i]
                                             : kNone);
    }
    kept.face_begin.push_back(static_cast<std::uint32_t>(kept.corner_position.size()));
    if (!mesh.face_object.empty()) kept.face_object.push_back(mesh.face_object[face]);
    result.source.push_back(face);
  }
  return result;
}

}  // namespace wrapatlas
