#include "chart_borders.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/union_find.h"

namespace wrapatlas::bench {

ChartBorders::ChartBorders(const Mesh& mesh, int side) : chart_(mesh.face_count()) {
  std::map<std::array<double, 4>, std::vector<std::uint32_t>> faces;
  const auto corner = [&](std::uint32_t c) {
    return double(side) * mesh.texcoords[mesh.corner_texcoord[c]];
  };
  const auto key = [](Vec2 a, Vec2 b) {
    if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
    return std::array<double, 4>{a.x, a.y, b.x, b.y};
  };
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
    faces[key(corner(c), corner(c % 3 == 2 ? c - 2 : c + 1))].push_back(c / 3);
  }
  UnionFind sets(mesh.face_count());
  for (const auto& [edge, users] : faces) {
    for (const std::uint32_t face : users) sets.unite(users.front(), face);
  }
  for (std::uint32_t face = 0; face < chart_.size(); ++face) chart_[face] = sets.find(face);
  for (const auto& [edge, users] : faces) {
    if (users.size() > 1) continue;
    edges_[chart_[users.front()]].push_back({{edge[0], edge[1]}, {edge[2], edge[3]}});
  }
}

double ChartBorders::distance(std::uint32_t face, Vec2 place) const {
  double least2 = 1e300;
  const auto found = edges_.find(chart_[face]);
  if (found == edges_.end()) return std::sqrt(least2);
  for (const auto& [a, b] : found->second) {
    const Vec2 ab = b - a, ap = place - a;
    const double size2 = dot(ab, ab);
    const double share = size2 > 0 ? std::clamp(dot(ap, ab) / size2, 0.0, 1.0) : 0;
    const Vec2 off = ap - share * ab;
    least2 = std::min(least2, dot(off, off));
  }
  return std::sqrt(least2);
}

}  // namespace wrapatlas::bench
