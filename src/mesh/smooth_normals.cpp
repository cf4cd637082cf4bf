#include <algorithm>
#include <cmath>

#include "mesh/corner_angle.h"
#include "mesh/edge_groups.h"
#include "mesh/polygon_plane.h"
#include "mesh/union_find.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {
namespace {

/// The corner of a face at a point.
std::uint32_t corner_at(const Mesh& mesh, const WeldedCorners& points, std::uint32_t face,
                        std::uint32_t point) {
  std::uint32_t c = mesh.face_begin[face];
  while (c + 1 < mesh.face_begin[face + 1] && points.of_corner[c] != point) ++c;
  return c;
}

std::vector<EdgeUse> edges_of(const Mesh& mesh, const WeldedCorners& points) {
  std::vector<EdgeUse> uses;
  uses.reserve(mesh.corner_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face], size = mesh.face_size(face);
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = points.of_corner[begin + i];
      const std::uint32_t b = points.of_corner[begin + (i + 1) % size];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), face, a > b});
    }
  }
  gather_edges(uses, points.count);
  return uses;
}

/// Corners that share a normal get one number: the smallest of theirs.
std::vector<std::uint32_t> smooth_groups(const Mesh& mesh, const WeldedCorners& points,
                                         const std::vector<Vec3>& face_normal, double hard_angle) {
  if (hard_angle < 0) return points.of_corner;
  const double least_cosine = std::cos(hard_angle);
  UnionFind corners(mesh.corner_count());
  const std::vector<EdgeUse> uses = edges_of(mesh, points);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
      const std::uint32_t f = edge[i].face, g = edge[i + 1].face;
      if (dot(face_normal[f], face_normal[g]) < least_cosine) continue;
      for (const std::uint32_t point : {edge[i].low, edge[i].high}) {
        corners.unite(corner_at(mesh, points, f, point), corner_at(mesh, points, g, point));
      }
    }
  });
  std::vector<std::uint32_t> groups(mesh.corner_count());
  for (std::uint32_t c = 0; c < groups.size(); ++c) groups[c] = corners.find(c);
  return groups;
}

}  // namespace

CornerVectors smooth_normals(const Mesh& mesh, double hard_angle) {
  const WeldedCorners points = weld_corners(mesh);
  std::vector<Vec3> face_normal(mesh.face_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    face_normal[face] = unit(polygon_normal(mesh, face));
  }
  const std::vector<std::uint32_t> groups = smooth_groups(mesh, points, face_normal, hard_angle);
  std::vector<Vec3> sums(std::max<std::size_t>(points.count, mesh.corner_count()));
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face], size = mesh.face_size(face);
    for (std::uint32_t i = 0; i < size; ++i) {
      const auto at = [&](std::uint32_t k) -> const Vec3& {
        return mesh.positions[mesh.corner_position[begin + k % size]];
      };
      const double angle = angle_between(at(i + size - 1) - at(i), at(i + 1) - at(i));
      Vec3& sum = sums[groups[begin + i]];
      sum = sum + angle * face_normal[face];
    }
  }
  for (Vec3& sum : sums) sum = unit(sum);
  CornerVectors normals(mesh.corner_count());
  for (std::uint32_t c = 0; c < normals.size(); ++c) normals[c] = sums[groups[c]];
  return normals;
}

}  // namespace wrapatlas
