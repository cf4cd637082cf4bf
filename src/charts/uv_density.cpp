#include <cmath>

#include "wrapatlas/charts.h"

namespace wrapatlas {
namespace {

bool has_uvs(const Mesh& mesh, std::size_t face) {
  for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
    if (mesh.corner_texcoord[c] == kNone) return false;
  }
  return true;
}

}  // namespace

double uv_density(const Mesh& mesh) {
  double in_uv = 0, in_space = 0;
  std::vector<Vec2> polygon;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (!has_uvs(mesh, f)) continue;
    const std::uint32_t begin = mesh.face_begin[f];
    polygon.clear();
    triangles.clear();
    for (std::uint32_t c = begin; c < mesh.face_begin[f + 1]; ++c) {
      polygon.push_back(mesh.texcoords[mesh.corner_texcoord[c]]);
    }
    triangulate_polygon(polygon, triangles);
    for (const auto& [i, j, k] : triangles) {
      in_uv += std::abs(signed_area2(polygon[i], polygon[j], polygon[k])) / 2;
      const auto at = [&](std::uint32_t offset) {
        return mesh.positions[mesh.corner_position[begin + offset]];
      };
      in_space += length(cross(at(j) - at(i), at(k) - at(i))) / 2;
    }
  }
  const double density = std::sqrt(in_uv / in_space);
  return in_uv > 0 && in_space > 0 && std::isfinite(density) ? density : 0;
}

}  // namespace wrapatlas
