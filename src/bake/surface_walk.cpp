#include "bake/surface_walk.h"

#include <algorithm>
#include <utility>

#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

constexpr int kMostSteps = 1024;  // triangles on the way

Vec3 normal_of(const Triangle& t) { return unit(cross(t[1] - t[0], t[2] - t[0])); }

/// How the weights grow along a vector in the triangle's plane; all 0 where it has no area.
std::array<double, 3> rates(const Triangle& t, const Vec3& along) {
  const Vec3 p = t[1] - t[0], q = t[2] - t[0];
  const double pp = dot(p, p), pq = dot(p, q), qq = dot(q, q);
  const double dp = dot(along, p), dq = dot(along, q), area2 = pp * qq - pq * pq;
  if (!(area2 > 0)) return {};
  const double b = (qq * dp - pq * dq) / area2, c = (pp * dq - pq * dp) / area2;
  return {-b - c, b, c};
}

/// Turns vectors about an edge, from the plane of one face into that of the next.
class Hinge {
 public:
  Hinge(const Vec3& edge, const Vec3& from_normal, const Vec3& to_normal)
      : edge_(unit(edge)),
        from_{cross(edge_, from_normal), from_normal},
        to_{cross(edge_, to_normal), to_normal} {}

  [[nodiscard]] Vec3 turned(const Vec3& v) const {
    return dot(v, edge_) * edge_ + dot(v, from_[0]) * to_[0] + dot(v, from_[1]) * to_[1];
  }

 private:
  Vec3 edge_;
  std::array<Vec3, 2> from_, to_;
};

}  // namespace

SurfaceWalk::SurfaceWalk(Surface surface, std::size_t triangles)
    : surface_(std::move(surface)), face_of_(triangles, kNone) {
  for (std::uint32_t face = 0; face < surface_.face_count(); ++face) {
    face_of_[surface_.face_source[face]] = face;
  }
}

Result<SurfaceWalk> SurfaceWalk::build(const Mesh& triangles) {
  auto surface = build_surface(triangles);
  if (!surface) return surface.error();
  return SurfaceWalk(*std::move(surface), triangles.face_count());
}

Triangle SurfaceWalk::corners(std::uint32_t face) const {
  const std::uint32_t* vertex = surface_.corner_vertex.data() + std::size_t{3} * face;
  return {surface_.points[vertex[0]], surface_.points[vertex[1]], surface_.points[vertex[2]]};
}

WalkEnd SurfaceWalk::go(std::uint32_t triangle, const std::array<double, 3>& weights,
                        const Vec3& by) const {
  WalkEnd end;
  end.triangle = triangle;
  end.weights = weights;
  std::uint32_t face = face_of_[triangle];
  if (face == kNone) return end;
  const auto source = [&](std::size_t i) { return surface_.corner_source[3 * face + i] % 3; };
  std::array<double, 3> w;
  for (std::size_t i = 0; i < 3; ++i) w[i] = weights[source(i)];
  Triangle t = corners(face);
  Vec3 left = by;
  std::size_t entered = 3;  // the corner whose edge was come over
  for (int step = 0; step < kMostSteps; ++step) {
    const std::array<double, 3> rate = rates(t, left);
    double share = 1;
    std::size_t out = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t opposite = (i + 1) % 3;  // the edge on which weight i is 0 begins there
      if (opposite == entered || rate[i] >= 0) continue;
      const double until = std::max(w[i], 0.0) / -rate[i];
      if (until >= share) continue;
      share = until;
      out = opposite;
    }
    for (std::size_t i = 0; i < 3; ++i) w[i] = std::max(w[i] + share * rate[i], 0.0);
    if (out == 3) break;
    const std::uint32_t twin = surface_.corner_twin[3 * face + out];
    if (twin == kNone) break;
    const Triangle next = corners(twin / 3);
    const Vec3 normal = normal_of(next);
    if (normal == Vec3{}) break;
    const std::size_t after = (out + 1) % 3, entry = twin % 3;
    const Hinge hinge(t[after] - t[out], normal_of(t), normal);
    left = hinge.turned((1 - share) * left);
    for (Vec3& axis : end.axes) axis = hinge.turned(axis);
    std::array<double, 3> there{};
    there[entry] = w[after];
    there[(entry + 1) % 3] = w[out];
    w = there;
    t = next;
    face = twin / 3;
    entered = entry;
  }
  const double sum = w[0] + w[1] + w[2];
  end.triangle = surface_.face_source[face];
  for (std::size_t i = 0; i < 3; ++i) end.weights[source(i)] = w[i] / sum;
  return end;
}

}  // namespace wrapatlas
