#include "io/cut_vertices.h"
#include "wrapatlas/model.h"

namespace wrapatlas {

Mesh apply_atlas(const Mesh& mesh, const AtlasMesh& atlas) {
  const CutVertices cut = number_cut_vertices(mesh, atlas);
  const auto source_vertices = static_cast<std::uint32_t>(mesh.positions.size());
  Mesh applied;
  applied.positions.reserve(source_vertices + cut.first_point.size());
  applied.positions = mesh.positions;
  for (const std::uint32_t point : cut.first_point) {
    applied.positions.push_back(cut_position(mesh, atlas.cut_points[point]));
  }
  applied.texcoords = atlas.texcoords;
  applied.face_begin = atlas.face_begin;
  applied.corner_texcoord = atlas.corner_texcoord;
  applied.corner_position.reserve(atlas.corner_source.size());
  for (std::size_t c = 0; c < atlas.corner_source.size(); ++c) {
    const std::uint32_t corner = atlas.corner_source[c];
    applied.corner_position.push_back(corner != kNone
                                          ? mesh.corner_position[corner]
                                          : source_vertices + cut.of_point[atlas.corner_cut[c]]);
  }
  if (mesh.face_object.empty()) return applied;
  applied.face_object.reserve(atlas.face_source.size());
  for (const std::uint32_t face : atlas.face_source) {
    applied.face_object.push_back(mesh.face_object[face]);
  }
  return applied;
}

}  // namespace wrapatlas
