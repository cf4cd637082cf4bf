#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/corner_angle.h"
#include "mesh/edge_groups.h"
#include "mesh/polygon_plane.h"
#include "mesh/union_find.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {
namespace {

/// Each face at an edge is compared with so many after it: all pairs, of any edge but a bundle's.
constexpr std::size_t kMostNeighbours = 8;

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

/// Which corners share a normal.
class SmoothGroups {
 public:
  SmoothGroups(const Mesh& mesh, const WeldedCorners& points, const std::vector<Vec3>& face_normal,
               double least_cosine)
      : mesh_(mesh),
        points_(points),
        normal_(face_normal),
        least_cosine_(least_cosine),
        corners_(mesh.corner_count()) {}

  /// One number for each group: the smallest of its corners.
  std::vector<std::uint32_t> find() {
    const std::vector<EdgeUse> uses = edges_of(mesh_, points_);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      for (std::size_t i = 0; i < edge.size(); ++i) {
        const std::size_t end = std::min(edge.size(), i + 1 + kMostNeighbours);
        for (std::size_t j = i + 1; j < end; ++j) look_across(edge[i].face, edge[j].face, edge[i]);
      }
    });
    bridge_slivers();
    std::vector<std::uint32_t> groups(mesh_.corner_count());
    for (std::uint32_t c = 0; c < groups.size(); ++c) groups[c] = corners_.find(c);
    return groups;
  }

 private:
  [[nodiscard]] bool is_sliver(std::uint32_t face) const { return normal_[face] == Vec3{}; }
  [[nodiscard]] bool is_smooth(std::uint32_t f, std::uint32_t g) const {
    return dot(normal_[f], normal_[g]) >= least_cosine_;
  }

  void look_across(std::uint32_t f, std::uint32_t g, const EdgeUse& edge) {
    for (const std::uint32_t point : {edge.low, edge.high}) {
      if (is_sliver(f)) beside_.push_back({f, point, g});
      if (is_sliver(g)) beside_.push_back({g, point, f});
      const bool unite =
          !is_sliver(f) && !is_sliver(g) ? is_smooth(f, g) : is_sliver(f) && is_sliver(g);
      if (unite) join(f, g, point);
    }
  }

  void join(std::uint32_t f, std::uint32_t g, std::uint32_t point) {
    corners_.unite(corner_at(mesh_, points_, f, point), corner_at(mesh_, points_, g, point));
  }

  /// A face without area has no direction: those beside it are compared with each other as if it
  /// were not there, and it goes along with the first.
  void bridge_slivers() {
    std::sort(beside_.begin(), beside_.end());
    for (std::size_t i = 0; i < beside_.size(); ++i) {
      const auto [sliver, point, f] = beside_[i];
      if (is_sliver(f)) continue;
      const bool is_first = i == 0 || beside_[i - 1][0] != sliver || beside_[i - 1][1] != point ||
                            is_sliver(beside_[i - 1][2]);
      if (is_first) join(sliver, f, point);
      const std::size_t end = std::min(beside_.size(), i + 1 + kMostNeighbours);
      for (std::size_t j = i + 1; j < end; ++j) {
        const auto [other_sliver, other_point, g] = beside_[j];
        if (other_sliver != sliver || other_point != point) break;
        if (!is_sliver(g) && is_smooth(f, g)) join(f, g, point);
      }
    }
  }

  const Mesh& mesh_;
  const WeldedCorners& points_;
  const std::vector<Vec3>& normal_;  // of faces
  double least_cosine_;
  UnionFind corners_;
  std::vector<std::array<std::uint32_t, 3>> beside_;  // a sliver, a point of it, a face there
};

/// Corners that share a normal get one number.
std::vector<std::uint32_t> smooth_groups(const Mesh& mesh, const WeldedCorners& points,
                                         const std::vector<Vec3>& face_normal, double hard_angle) {
  if (hard_angle < 0) return points.of_corner;
  return SmoothGroups(mesh, points, face_normal, std::cos(hard_angle)).find();
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
