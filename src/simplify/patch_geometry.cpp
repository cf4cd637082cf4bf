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
  mesh_.each_corner(v, [&](std::uint32_t c) {
    const Vec3& n = normals_[c / 3];
    star.squares = star.squares + Symmetric3::square(n);
    star.normal = star.normal + n;
  });
  return star;
}

void PatchGeometry::move(std::uint32_t v, const Vec3& point) {
  vertices_[v].position = point;
  mesh_.each_corner(v, [&](std::uint32_t c) { normals_[c / 3] = normal_of(c / 3); });
  vertices_[v].star = star_of(v);
  mesh_.each_edge(v, [&](std::uint32_t u, std::uint32_t) { vertices_[u].star = star_of(u); });
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
  bool spoils = false;
  const auto look = [&](std::uint32_t corner) {
    const std::uint32_t f = corner / 3;
    if (spoils || f == gone || f == gone_too) return;
    const Vec3& p = position(mesh_.vertex(CollapseMesh::next(corner)));
    const Vec3& q = position(mesh_.vertex(CollapseMesh::previous(corner)));
    const Vec3& before = normals_[f];
    const Vec3 after = cross(p - point, q - point);
    const bool was_needle = is_needle(before, position(mesh_.vertex(corner)), p, q);
    if (is_needle(after, point, p, q)) {
      spoils = !was_needle;
    } else if (was_needle) {  // its own normal says little
      spoils = dot(after, patch_normal) < 0;
    } else {
      spoils = dot(after, before) < kLeastCosine * length(after) * length(before);
    }
  };
  mesh_.each_corner(a, look);
  mesh_.each_corner(b, look);
  return spoils;
}

}  // namespace wrapatlas
