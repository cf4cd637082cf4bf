#include "simplify/patch_geometry.h"

#include <algorithm>

namespace wrapatlas {
namespace {

constexpr double kLeastCosine = 0.1;  ///< of a triangle's old normal to its new one
constexpr double kNeedle = 1e-4;      ///< height over longest side

/// `normal` is twice the area; a, b, c the corners.
bool is_needle(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return !(length(normal) > kNeedle * longest2);
}

}  // namespace

void Star::add(const Vec3& n) {
  squares = squares + Symmetric3::square(n);
  normal = normal + n;
  ++faces;
}

void Star::take(const Vec3& n) {
  squares = squares - Symmetric3::square(n);
  normal = normal - n;
  --faces;
}

PatchGeometry::PatchGeometry(const CollapseMesh& mesh, std::span<const Vec3> positions,
                             double scale)
    : mesh_(mesh), vertices_(mesh.vertex_numbers()), normals_(mesh.face_numbers()) {
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) vertices_[v].position = scale * positions[v];
  for (std::uint32_t f = 0; f < normals_.size(); ++f) normals_[f] = normal_of(f);
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) vertices_[v].star = star_of(v);
}

Vec3 PatchGeometry::normal_of(std::uint32_t f) const {
  const Vec3& origin = position(mesh_.vertex(3 * f));
  return cross(position(mesh_.vertex(3 * f + 1)) - origin,
               position(mesh_.vertex(3 * f + 2)) - origin);
}

Star PatchGeometry::star_of(std::uint32_t v) const {
  Star star;
  mesh_.each_corner(v, [&](std::uint32_t c) { star.add(normals_[c / 3]); });
  return star;
}

/// Once its changes are too many, or what is left of the sum is little beside what was in it.
void PatchGeometry::sum_hub(std::uint32_t v) {
  Star& star = vertices_[v].star;
  Hub& hub = hubs_[v];
  hub.largest = std::max(hub.largest, star.squares.trace());
  if (++hub.changes < star.faces && 2 * star.squares.trace() > hub.largest) return;
  star = star_of(v);
  hub = {0, star.squares.trace()};
}

void PatchGeometry::before_collapse(std::uint32_t c) {
  for (const std::uint32_t side : {c, mesh_.twin(c)}) {
    if (side == kNone) continue;
    Star& star = vertices_[mesh_.opposite(side)].star;
    if (star.is_hub()) star.take(normals_[side / 3]);
  }
}

void PatchGeometry::move(std::uint32_t v, const Vec3& point) {
  vertices_[v].position = point;
  Star own;
  mesh_.each_corner(v, [&](std::uint32_t c) {
    const Vec3 before = normals_[c / 3], now = normal_of(c / 3);
    normals_[c / 3] = now;
    own.add(now);
    for (const std::uint32_t end : {CollapseMesh::next(c), CollapseMesh::previous(c)}) {
      Star& star = vertices_[mesh_.vertex(end)].star;
      if (!star.is_hub()) continue;
      star.take(before);
      star.add(now);
    }
  });
  vertices_[v].star = own;
  if (!hubs_.empty()) hubs_.erase(v);
  mesh_.each_edge(v, [&](std::uint32_t u, std::uint32_t) {
    if (vertices_[u].star.is_hub()) {
      sum_hub(u);
    } else {
      vertices_[u].star = star_of(u);
    }
  });
}

double PatchGeometry::volume() const {
  double sum = 0;
  for (std::uint32_t f = 0; f < normals_.size(); ++f) {
    if (mesh_.has_face(f)) sum += dot(normals_[f], position(mesh_.vertex(3 * f)) - position(0));
  }
  return sum / 6;
}

bool PatchGeometry::spoils_triangle(std::uint32_t c, const Vec3& point) const {
  const std::uint32_t a = mesh_.vertex(c), b = mesh_.vertex(CollapseMesh::next(c));
  const std::uint32_t gone = c / 3, gone_too = mesh_.twin(c) == kNone ? gone : mesh_.twin(c) / 3;
  const Vec3 patch_normal = star(a).normal + star(b).normal;
  const auto is_spoilt = [&](std::uint32_t corner) {
    const std::uint32_t f = corner / 3;
    if (f == gone || f == gone_too) return false;
    const Vec3& p = position(mesh_.vertex(CollapseMesh::next(corner)));
    const Vec3& q = position(mesh_.vertex(CollapseMesh::previous(corner)));
    const Vec3& before = normals_[f];
    const Vec3 after = cross(p - point, q - point);
    const bool was_needle = is_needle(before, position(mesh_.vertex(corner)), p, q);
    if (is_needle(after, point, p, q)) return !was_needle;
    if (was_needle) return dot(after, patch_normal) < 0;  // its own normal says little
    return dot(after, before) < kLeastCosine * length(after) * length(before);
  };
  const bool a_is_first = star(a).faces <= star(b).faces;
  return mesh_.any_corner(a_is_first ? a : b, is_spoilt) ||
         mesh_.any_corner(a_is_first ? b : a, is_spoilt);
}

}  // namespace wrapatlas
