// After Lindstrom & Turk 1998; with n = (p1 - p0) x (p2 - p0) and L = det[p0 p1 p2] of the
// triangles at the edge's ends, and e1 = v1 - v0, e2 = v0 x v1 of the border edges there:
//   boundary preservation  |Σ e1 x v + Σ e2|² is least: two planes
//   volume preservation    Σ n·v = Σ L
//   optimisation           w/36 Σ (n·v - L)² + (1 - w)/4 |e|² Σ |e1 x v + e2|² is least, w = 1/2
//   triangle shape         Σ |v - link vertex|² is least
// in this order, until there are three planes; the cost is what optimisation makes least.
// We depart in this:
// - The two planes of boundary preservation hold the same line, but stand on two directions at a
//   right angle to Σ e1: the paper's vanish where the line goes through the origin, as it does if a
//   straight border does and the origin lies on it.
// - UV seams, if they are kept, are lines to optimisation only. A closed surface keeps its volume.
// - Costs of 0, as in a plane, are ordered by length of the edge: the paper does not say how.
// - A hub stands for the link vertices around it, as if it were in their middle.
// - Sums over triangles come from two vertices' stars (see Star), each seen from its own vertex.
#include "simplify/placement.h"

#include <algorithm>

#include "mesh/perpendicular.h"
#include "simplify/constraints.h"

namespace wrapatlas {
namespace {

constexpr double kVolumeWeight = 0.5, kLineWeight = 0.5;
constexpr double kOrderOfEqualCosts = 1e-9;  ///< times length^6 / 36
/// Of the sum of squares: sums whose square is less cancel but for rounding.
constexpr double kNoNormal2 = 1e-16, kNoDirection2 = 1e-8;

/// vᵀHv + 2cᵀv + k
struct Quadratic {
  Symmetric3 h;
  Vec3 c;
  double k = 0;

  [[nodiscard]] double at(const Vec3& v) const { return dot(v, h * v) + 2 * dot(c, v) + k; }
};

/// Sums over the edges of borders and seams at the ends of an edge.
struct Lines {
  Vec3 direction, moment;  ///< of borders alone: Σ e1, Σ e2
  double squares = 0;      ///< of borders alone: Σ |e1|²
  Quadratic error;         ///< Σ |e1 x v + e2|²

  void add(const Vec3& from, const Vec3& to, bool is_border) {
    const Vec3 e1 = to - from, e2 = cross(from, to);
    const double square = dot(e1, e1);
    if (is_border) {
      direction = direction + e1;
      moment = moment + e2;
      squares += square;
    }
    error.h = error.h + Symmetric3{square, 0, 0, square, 0, square} - Symmetric3::square(e1);
    error.c = error.c + cross(e2, e1);
    error.k += dot(e2, e2);
  }

  /// The line in which the borders' directed area stays what it is.
  void preserve(Constraints& constraints) const {
    const double square = dot(direction, direction);
    if (!(square > kNoDirection2 * squares)) return;
    const Vec3 on_line = 1 / square * cross(direction, moment);
    const Vec3 side = perpendicular(direction), other = cross(direction, side);
    constraints.add(side, dot(side, on_line));
    constraints.add(other, dot(other, on_line));
  }
};

/// An edge and the triangles at its ends, seen from its first vertex.
class EdgePatch {
 public:
  EdgePatch(const CollapseMesh& mesh, const PatchGeometry& geometry, std::uint32_t c)
      : mesh_(mesh),
        geometry_(geometry),
        corner_(c),
        a_(mesh.vertex(c)),
        b_(mesh.vertex(CollapseMesh::next(c))),
        origin_(geometry.position(a_)),
        edge_(geometry.position(b_) - origin_) {
    const Star &at_a = geometry.star(a_), &at_b = geometry.star(b_);
    error_.h = at_a.squares + at_b.squares;
    normal_ = at_a.normal + at_b.normal;
    for (const std::uint32_t side : {c, mesh.twin(c)}) {  // counted twice
      if (side == kNone) continue;
      const Vec3& n = geometry.normal(side / 3);
      error_.h = error_.h - Symmetric3::square(n);
      normal_ = normal_ - n;
    }
    const Vec3 moment = at_b.squares * edge_;  // L = n·edge for triangles at b, 0 at a
    error_.c = -1 * moment;
    error_.k = dot(edge_, moment);
    determinant_ = dot(at_b.normal, edge_);
  }

  [[nodiscard]] EdgePlacement place(std::span<const std::uint8_t> is_seam) const {
    const double edge2 = dot(edge_, edge_);
    Constraints constraints;
    Quadratic error = error_;
    if (may_have_lines(is_seam)) {
      const Lines lines = lines_of(is_seam);
      const double line_share = 9 * kLineWeight / kVolumeWeight * edge2;  // of 1/36: 1/4
      lines.preserve(constraints);
      error.h = error.h + line_share * lines.error.h;
      error.c = error.c + line_share * lines.error.c;
      error.k += line_share * lines.error.k;
    }
    constraints.add(normal_, determinant_, kNoNormal2 * error_.h.trace());
    constraints.minimise(error.h, error.c);
    if (!constraints.complete()) {
      const Quadratic shape = shape_of_triangles();
      constraints.minimise(shape.h, shape.c);
    }
    const Vec3 v = constraints.point();
    return {origin_ + v, kVolumeWeight / 36 * std::max(0.0, error.at(v)) +
                             kOrderOfEqualCosts / 36 * edge2 * edge2 * edge2};
  }

 private:
  [[nodiscard]] Vec3 seen(std::uint32_t v) const { return geometry_.position(v) - origin_; }

  [[nodiscard]] bool may_have_lines(std::span<const std::uint8_t> is_seam) const {
    return !is_seam.empty() || mesh_.is_border(a_) || mesh_.is_border(b_);
  }

  [[nodiscard]] Lines lines_of(std::span<const std::uint8_t> is_seam) const {
    Lines lines;
    const std::uint32_t own = mesh_.edge(corner_);
    for (const std::uint32_t v : {a_, b_}) {
      if (is_seam.empty() && !mesh_.is_border(v)) continue;
      mesh_.each_edge(v, [&](std::uint32_t, std::uint32_t c) {
        const bool is_border = mesh_.twin(c) == kNone;
        if (!is_border && (is_seam.empty() || is_seam[mesh_.edge(c)] == 0)) return;
        if (v == b_ && mesh_.edge(c) == own) return;
        lines.add(seen(mesh_.vertex(c)), seen(mesh_.vertex(CollapseMesh::next(c))), is_border);
      });
    }
    return lines;
  }

  [[nodiscard]] Quadratic shape_of_triangles() const {
    double count = 0;
    Vec3 sum;
    for (const std::uint32_t v : {a_, b_}) {
      const Star& star = geometry_.star(v);
      if (star.is_hub()) {
        count += star.faces;
        sum = sum + star.faces * seen(v);
        continue;
      }
      mesh_.each_edge(v, [&](std::uint32_t u, std::uint32_t) {
        if (u == a_ || u == b_) return;
        count += 1;
        sum = sum + seen(u);
      });
    }
    return {{count, 0, 0, count, 0, count}, -1 * sum, 0};
  }

  const CollapseMesh& mesh_;
  const PatchGeometry& geometry_;
  std::uint32_t corner_, a_, b_;
  Vec3 origin_, edge_;
  Quadratic error_;  ///< Σ (n·v - L)²
  Vec3 normal_;      ///< Σ n
  double determinant_ = 0;
};

}  // namespace

EdgePlacement place(const CollapseMesh& mesh, const PatchGeometry& geometry, std::uint32_t c,
                    std::span<const std::uint8_t> is_seam) {
  return EdgePatch(mesh, geometry, c).place(is_seam);
}

}  // namespace wrapatlas
