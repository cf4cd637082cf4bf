#include "io/cut_vertices.h"

#include <array>
#include <map>

namespace wrapatlas {

CutVertices number_cut_vertices(const Mesh& mesh, const AtlasMesh& atlas) {
  CutVertices vertices;
  vertices.of_point.reserve(atlas.cut_points.size());
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> known;
  for (std::uint32_t i = 0; i < atlas.cut_points.size(); ++i) {
    const AtlasMesh::CutPoint& point = atlas.cut_points[i];
    std::array<std::uint32_t, 4> key{point.position, kNone, kNone, kNone};
    for (std::size_t k = 0; k < 3; ++k) {
      if (point.weights[k] != 0) key[k + 1] = mesh.corner_position[point.corners[k]];
    }
    const auto next = static_cast<std::uint32_t>(vertices.first_point.size());
    const auto [entry, is_new] = known.try_emplace(key, next);
    if (is_new) vertices.first_point.push_back(i);
    vertices.of_point.push_back(entry->second);
  }
  return vertices;
}

Vec3 cut_position(const Mesh& mesh, const AtlasMesh::CutPoint& point) {
  return interpolate(point, [&](std::uint32_t corner) -> const Vec3& {
    return mesh.positions[mesh.corner_position[corner]];
  });
}

}  // namespace wrapatlas
