// Mikkelsen, Simulation of wrinkled surfaces revisited (2008), chapter 3, and the rules by which
// programs that name it agree on tangents: which corners share one. Written from the description of
// what it computes.
#include "wrapatlas/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "mesh/corner_angle.h"
#include "mesh/edge_groups.h"
#include "mesh/perpendicular.h"
#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

constexpr double kNothing = 1e-38;  ///< the smallest normal 32-bit float: less counts as 0

/// What the UVs of a triangle say.
struct FaceTangent {
  Vec3 u;                  ///< where u grows along the surface, unit
  bool preserves = false;  ///< the orientation: UVs are not mirrored
  bool is_any = true;      ///< no direction: goes along with any neighbour
  bool is_point = false;   ///< two corners at one place: part of no group
};

Vec3 within_plane(const Vec3& v, const Vec3& normal) { return unit(v - dot(normal, v) * normal); }

class Builder {
 public:
  Builder(const Mesh& mesh, const CornerVectors& normals, bool v_points_down)
      : mesh_(mesh), normals_(normals), down_(v_points_down), points_(weld_corners(mesh)) {
    number_vertices();
    read_faces();
    find_neighbours();
    group_.assign(mesh.corner_count(), kNone);
  }

  void build(TangentFrames& frames) {
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      for (std::uint32_t c = 3 * face; c < 3 * face + 3; ++c) {
        if (group_[c] == kNone && !faces_[face].is_any && !faces_[face].is_point) flood(c);
      }
    }
    std::vector<Vec3> tangent_of_vertex(vertex_count_);  // for faces that are points
    std::vector<float> sign_of_vertex(vertex_count_, 1);
    for (std::uint32_t c = 0; c < group_.size(); ++c) {
      const Vec3 tangent =
          group_[c] == kNone ? Vec3{} : within_plane(sums_[group_[c]], normals_[c]);
      frames.tangent[c] = tangent == Vec3{} ? perpendicular(normals_[c]) : tangent;
      frames.sign[c] = group_[c] == kNone || preserves_[group_[c]] ? 1.0F : -1.0F;
      if (group_[c] == kNone) continue;
      tangent_of_vertex[vertex_[c]] = frames.tangent[c];
      sign_of_vertex[vertex_[c]] = frames.sign[c];
    }
    for (std::uint32_t c = 0; c < group_.size(); ++c) {
      if (group_[c] != kNone || tangent_of_vertex[vertex_[c]] == Vec3{}) continue;
      frames.tangent[c] = tangent_of_vertex[vertex_[c]];
      frames.sign[c] = sign_of_vertex[vertex_[c]];
    }
  }

 private:
  [[nodiscard]] const Vec3& position(std::uint32_t corner) const {
    return mesh_.positions[mesh_.corner_position[corner]];
  }
  [[nodiscard]] Vec2 uv(std::uint32_t corner) const {
    const std::uint32_t index = mesh_.corner_texcoord[corner];
    if (index == kNone) return {};
    const Vec2 given = mesh_.texcoords[index];
    return {given.x, down_ ? 1 - given.y : given.y};
  }

  /// Corners equal in position, normal and UV are one vertex.
  void number_vertices() {
    const auto key = [&](std::uint32_t c) {
      const Vec3& n = normals_[c];
      const Vec2 t = uv(c);
      return std::make_tuple(points_.of_corner[c], n.x, n.y, n.z, t.x, t.y);
    };
    std::vector<std::uint32_t> order(mesh_.corner_count());
    for (std::uint32_t c = 0; c < order.size(); ++c) order[c] = c;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    vertex_.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && key(order[i]) != key(order[i - 1])) ++vertex_count_;
      vertex_[order[i]] = vertex_count_;
    }
    if (!order.empty()) ++vertex_count_;
  }

  void read_faces() {
    faces_.resize(mesh_.face_count());
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      FaceTangent& tangent = faces_[face];
      const std::uint32_t a = 3 * face, b = a + 1, c = a + 2;
      const auto& at = points_.of_corner;
      tangent.is_point = at[a] == at[b] || at[b] == at[c] || at[c] == at[a];
      const Vec2 ab = uv(b) - uv(a), ac = uv(c) - uv(a);
      const double area = cross(ab, ac);
      tangent.preserves = area > 0;
      if (!(std::abs(area) > kNothing)) continue;
      const Vec3 u = ac.y * (position(b) - position(a)) - ab.y * (position(c) - position(a));
      const Vec3 v = ab.x * (position(c) - position(a)) - ac.x * (position(b) - position(a));
      if (!(length(u) > kNothing) || !(length(v) > kNothing)) continue;
      tangent.u = (tangent.preserves ? 1.0 : -1.0) * unit(u);
      tangent.is_any = false;
    }
  }

  /// Across edge c, from corner c to the next: the face there.
  void find_neighbours() {
    neighbour_.assign(mesh_.corner_count(), kNone);
    std::vector<EdgeUse> uses;
    for (std::uint32_t c = 0; c < mesh_.corner_count(); ++c) {
      if (faces_[c / 3].is_point) continue;
      const std::uint32_t a = vertex_[c], b = vertex_[next(c)];
      uses.push_back({std::min(a, b), std::max(a, b), c, a > b});
    }
    gather_edges(uses, vertex_count_);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      for (std::size_t i = 0; i < edge.size(); ++i) {  // `face` holds the corner here
        if (neighbour_[edge[i].face] != kNone) continue;
        for (std::size_t j = i + 1; j < edge.size(); ++j) {
          if (edge[j].reversed == edge[i].reversed || neighbour_[edge[j].face] != kNone) continue;
          neighbour_[edge[i].face] = edge[j].face / 3;
          neighbour_[edge[j].face] = edge[i].face / 3;
          break;
        }
      }
    });
  }

  static std::uint32_t next(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
  static std::uint32_t last(std::uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

  /// The corners of one vertex that hang together with `first` by edges and are oriented alike.
  void flood(std::uint32_t first) {
    const auto group = static_cast<std::uint32_t>(sums_.size());
    sums_.emplace_back();
    preserves_.push_back(faces_[first / 3].preserves);
    pending_.assign(1, first);
    while (!pending_.empty()) {
      const std::uint32_t c = pending_.back();
      pending_.pop_back();
      if (group_[c] != kNone) continue;
      FaceTangent& face = faces_[c / 3];
      if (face.is_any) adopt(c / 3, preserves_[group]);
      if (face.preserves != preserves_[group]) continue;
      group_[c] = group;
      if (!face.is_any) sums_[group] = sums_[group] + weighted_tangent(c);
      for (const std::uint32_t edge : {c, last(c)}) {
        const std::uint32_t other = neighbour_[edge];
        if (other == kNone) continue;
        for (std::uint32_t d = 3 * other; d < 3 * other + 3; ++d) {
          if (vertex_[d] == vertex_[c] && group_[d] == kNone) pending_.push_back(d);
        }
      }
    }
  }

  /// A face without a direction of its own is oriented as the first group that reaches it.
  void adopt(std::uint32_t face, bool preserves) {
    const bool is_free =
        group_[3 * face] == kNone && group_[3 * face + 1] == kNone && group_[3 * face + 2] == kNone;
    if (is_free) faces_[face].preserves = preserves;
  }

  [[nodiscard]] Vec3 weighted_tangent(std::uint32_t c) const {
    const Vec3& normal = normals_[c];
    const double angle = angle_between(within_plane(position(last(c)) - position(c), normal),
                                       within_plane(position(next(c)) - position(c), normal));
    return angle * within_plane(faces_[c / 3].u, normal);
  }

  const Mesh& mesh_;
  const CornerVectors& normals_;
  bool down_;
  WeldedCorners points_;
  std::vector<std::uint32_t> vertex_, neighbour_, group_;  // per corner
  std::uint32_t vertex_count_ = 0;
  std::vector<FaceTangent> faces_;
  std::vector<Vec3> sums_;       // per group
  std::vector<bool> preserves_;  // per group
  std::vector<std::uint32_t> pending_;
};

}  // namespace

TangentFrames tangent_frames(const Mesh& mesh, CornerVectors normals, bool v_points_down) {
  TangentFrames frames;
  frames.tangent.resize(mesh.corner_count());
  frames.sign.assign(mesh.corner_count(), 1);
  Builder(mesh, normals, v_points_down).build(frames);
  frames.normal = std::move(normals);
  return frames;
}

}  // namespace wrapatlas
