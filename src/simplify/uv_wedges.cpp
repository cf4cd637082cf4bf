#include "simplify/uv_wedges.h"

#include <algorithm>

namespace wrapatlas {
namespace {

/// Where the point, moved along the triangle's normal, lies in the triangle; their sum is 1.
std::array<double, 3> barycentric(const Vec3& normal, const std::array<Vec3, 3>& corners,
                                  const Vec3& point) {
  const double square = dot(normal, normal);
  const auto share = [&](std::size_t i) {
    const Vec3 a = corners[(i + 1) % 3] - point, b = corners[(i + 2) % 3] - point;
    return dot(normal, cross(a, b)) / square;
  };
  return {share(0), share(1), share(2)};
}

}  // namespace

UvWedges::UvWedges(const Mesh& triangles, const Surface& surface, const CollapseMesh& mesh,
                   const Creases& creases)
    : wedge_(surface.corner_vertex.size(), kNone) {
  for (std::uint32_t v = 0; v < mesh.vertex_numbers(); ++v) {
    number_wedges(triangles, surface, mesh, creases, v);
  }
}

/// Goes around the vertex, from a seam or border if there is one, and begins anew at each seam.
void UvWedges::number_wedges(const Mesh& triangles, const Surface& surface,
                             const CollapseMesh& mesh, const Creases& creases, std::uint32_t v) {
  const auto is_seam = [&](std::uint32_t c) { return creases.is_seam()[mesh.edge(c)] != 0; };
  const std::uint32_t first = mesh.corner_of_vertex(v);
  std::uint32_t start = first;
  while (mesh.twin(start) != kNone && !is_seam(start)) {
    start = CollapseMesh::next(mesh.twin(start));
    if (start == first) break;
  }
  std::uint32_t wedge = kNone, c = start;
  do {
    const std::uint32_t texcoord = triangles.corner_texcoord[surface.corner_source[c]];
    if (texcoord != kNone && (c == start || is_seam(c))) {
      wedge = static_cast<std::uint32_t>(uvs_.size());
      uvs_.push_back(triangles.texcoords[texcoord]);
    }
    wedge_[c] = texcoord == kNone ? kNone : wedge;
    c = mesh.twin(CollapseMesh::previous(c));
  } while (c != start && c != kNone);
}

const UvWedges::Join* UvWedges::join_of(std::uint32_t wedge) const {
  for (const Join& join : joins_) {
    if (wedge != kNone && (wedge == join.kept || wedge == join.gone)) return &join;
  }
  return nullptr;
}

bool UvWedges::prepare(const CollapseMesh& mesh, const PatchGeometry& geometry,
                       const Creases& creases, std::uint32_t c, const Vec3& point) {
  joins_ = {};
  const std::uint32_t a = mesh.vertex(c), b = mesh.vertex(CollapseMesh::next(c));
  if (!creases.is_on_seam(a)) {
    joins_[0] = {wedge_[c], wedge_[CollapseMesh::next(c)], {}};
    if (joins_[0].kept == kNone) return true;
    joins_[0].uv = uv_at(mesh, geometry, c, point);
    return !turns_over(mesh, c);
  }
  const Vec3 edge = geometry.position(b) - geometry.position(a);
  const double along = dot(point - geometry.position(a), edge) / dot(edge, edge);
  const double share = along > 0 ? std::min(along, 1.0) : 0.0;
  const std::uint32_t t = mesh.twin(c);
  joins_[0] = {wedge_[c], wedge_[CollapseMesh::next(c)], {}};
  joins_[1] = {wedge_[CollapseMesh::next(t)], wedge_[t], {}};
  for (Join& join : joins_) {
    if (join.kept != kNone) join.uv = (1 - share) * uvs_[join.kept] + share * uvs_[join.gone];
  }
  return !turns_over(mesh, c);
}

Vec2 UvWedges::uv_at(const CollapseMesh& mesh, const PatchGeometry& geometry, std::uint32_t c,
                     const Vec3& point) const {
  double best = -std::numeric_limits<double>::infinity();
  Vec2 uv = 0.5 * (uvs_[wedge_[c]] + uvs_[wedge_[CollapseMesh::next(c)]]);
  const auto look = [&](std::uint32_t corner) {
    const std::uint32_t f = corner / 3;
    const Vec3& normal = geometry.normal(f);
    if (!(dot(normal, normal) > 0)) return;
    std::array<Vec3, 3> corners;
    for (std::uint32_t i = 0; i < 3; ++i) corners[i] = geometry.position(mesh.vertex(3 * f + i));
    std::array<double, 3> share = barycentric(normal, corners, point);
    const double inside = *std::min_element(share.begin(), share.end());
    if (!(inside > best)) return;
    best = inside;
    double sum = 0;
    for (double& s : share) sum += s = std::max(s, 0.0);
    uv = {};
    for (std::uint32_t i = 0; i < 3; ++i) uv = uv + share[i] / sum * uvs_[wedge_[3 * f + i]];
  };
  mesh.each_corner(mesh.vertex(c), look);
  mesh.each_corner(mesh.vertex(CollapseMesh::next(c)), look);
  return uv;
}

bool UvWedges::turns_over(const CollapseMesh& mesh, std::uint32_t c) const {
  const std::uint32_t gone = c / 3, gone_too = mesh.twin(c) == kNone ? gone : mesh.twin(c) / 3;
  bool turned = false;
  const auto look = [&](std::uint32_t corner) {
    const std::uint32_t f = corner / 3;
    const Join* join = join_of(wedge_[corner]);
    if (f == gone || f == gone_too || join == nullptr) return;
    const Vec2 p = uvs_[wedge_[CollapseMesh::next(corner)]];
    const Vec2 q = uvs_[wedge_[CollapseMesh::previous(corner)]];
    const double before = signed_area2(uvs_[wedge_[corner]], p, q);
    turned = turned || (before != 0 && before * signed_area2(join->uv, p, q) <= 0);
  };
  mesh.each_corner(mesh.vertex(c), look);
  mesh.each_corner(mesh.vertex(CollapseMesh::next(c)), look);
  return turned;
}

void UvWedges::apply(const CollapseMesh& mesh, std::uint32_t c) {
  const auto take = [&](std::uint32_t corner) {
    if (const Join* join = join_of(wedge_[corner])) wedge_[corner] = join->kept;
  };
  mesh.each_corner(mesh.vertex(CollapseMesh::next(c)), take);
  for (const Join& join : joins_) {
    if (join.kept != kNone) uvs_[join.kept] = join.uv;
  }
}

}  // namespace wrapatlas
