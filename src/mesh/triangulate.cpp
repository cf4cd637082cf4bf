#include "mesh/triangulate.h"

#include "mesh/polygon_plane.h"

namespace wrapatlas {

Triangulated triangulated(const Mesh& mesh) {
  Triangulated result;
  result.mesh.positions = mesh.positions;
  result.mesh.texcoords = mesh.texcoords;
  const std::size_t most = 3 * (mesh.corner_count() - 2 * mesh.face_count());
  result.corner_source.reserve(most);
  std::vector<Vec2> flat;
  std::vector<std::array<std::uint32_t, 3>> cut;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
    cut.assign(1, {0, 1, 2});
    if (end - begin > 3) {
      flat.clear();
      cut.clear();
      const Plane plane(polygon_normal(mesh, face));
      for (std::uint32_t c = begin; c < end; ++c) {
        flat.push_back(plane.project(mesh.positions[mesh.corner_position[c]]));
      }
      triangulate_polygon(flat, cut);
    }
    for (const auto& triangle : cut) {
      for (const std::uint32_t offset : triangle) result.corner_source.push_back(begin + offset);
      result.face_source.push_back(face);
    }
  }
  Mesh& made = result.mesh;
  for (const std::uint32_t c : result.corner_source) {
    made.corner_position.push_back(mesh.corner_position[c]);
    made.corner_texcoord.push_back(mesh.corner_texcoord[c]);
  }
  for (std::uint32_t t = 1; t <= result.face_source.size(); ++t) made.face_begin.push_back(3 * t);
  if (!mesh.face_object.empty()) {
    for (const std::uint32_t face : result.face_source) {
      made.face_object.push_back(mesh.face_object[face]);
    }
  }
  return result;
}

}  // namespace wrapatlas
