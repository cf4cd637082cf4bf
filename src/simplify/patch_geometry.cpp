#include "simplify/patch_geometry.h"

#include <algorithm>

namespace wrapatlas {
namespace {

constexpr double kLeastCosine = 0.1;  ///< of a triangle's old normal to its new one
constexpr double kNeedle = 1e-4;      ///< height over longest side

double square(double x) { return x * x; }

/// `normal` is twice the area; a, b, c the corners.
bool is_needle(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return !(dot(normal, normal) > square(kNeedle * longest2));
}

}  // namespace

PatchGeometry::PatchGeometry(const CollapseMesh& mesh, std::span<const Vec3> positions,
                             double scale)
    : mesh_(mesh), vertices_(mesh.vertex_numbers()), normals_(mesh.face_numbers()) {
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) vertices_[v].position = scale * positions[v];
  for (std::uint32_t f = 0; f < normals_.size(); ++f) normals_[f] = normal_of(f);
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) sum(v);
}

Vec3 PatchGeometry::normal_of(std::uint32_t f) const {
  const Vec3& origin = position(mesh_.vertex(3 * f));
  return cross(position(mesh_.vertex(3 * f + 1)) - origin,
               position(mesh_.vertex(3 * f + 2)) - origin);
}

void PatchGeometry::sum(std::uint32_t v) {
  Star star;
  mesh_.each_corner(v, [&](std::uint32_t c) { star.add(normals_[c / 3]); });
  Vertex& vertex = vertices_[v];
  vertex.star = star;
  vertex.changes = 0;
  vertex.largest = star.squares.trace();
}

void PatchGeometry::before_collapse(std::uint32_t c) {
  for (const std::uint32_t side : {c, mesh_.twin(c)}) {
    if (side != kNone) vertices_[mesh_.opposite(side)].star.take(normals_[side / 3]);
  }
}

void PatchGeometry::move(std::uint32_t v, const Vec3& point) {
  vertices_[v].position = point;
  mesh_.each_corner(v, [&](std::uint32_t c) {
    const Vec3 before = normals_[c / 3], now = normal_of(c / 3);
    normals_[c / 3] = now;
    const Symmetric3 squares = Symmetric3::square(now) - Symmetric3::square(before);
    const Vec3 normal = now - before;
    for (const std::uint32_t end : {CollapseMesh::next(c), CollapseMesh::previous(c)}) {
      Star& star = vertices_[mesh_.vertex(end)].star;
      star.squares = star.squares + squares;
      star.normal = star.normal + normal;
    }
  });
  sum(v);
  mesh_.each_edge(v, [&](std::uint32_t u, std::uint32_t) {
    Vertex& vertex = vertices_[u];
    const double trace = vertex.star.squares.trace();
    vertex.largest = std::max(vertex.largest, trace);
    if (++vertex.changes >= vertex.star.faces || !(2 * trace > vertex.largest)) sum(u);
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
    const double along = dot(after, before);
    return along < 0 ||
           square(along) < square(kLeastCosine) * dot(after, after) * dot(before, before);
  };
  const bool a_is_first = star(a).faces <= star(b).faces;
  return mesh_.any_corner(a_is_first ? a : b, is_spoilt) ||
         mesh_.any_corner(a_is_first ? b : a, is_spoilt);
}

}  // namespace wrapatlas
