// Where the vertices are, and what follows from it for the triangles around each.
#pragma once

#include <span>
#include <vector>

#include "simplify/collapse_mesh.h"
#include "simplify/symmetric3.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// Sums over the triangles around a vertex, n being (p1 - p0) x (p2 - p0). Seen from the vertex the
/// determinants of these triangles are 0, so two stars are all that an edge's cost needs.
struct Star {
  Symmetric3 squares;  ///< of n nᵀ
  Vec3 normal;         ///< of n
  std::uint32_t faces = 0;

  /// Of more triangles than may be looked at whenever something near the vertex changes.
  static constexpr std::uint32_t kMostAtOnce = 32;
  [[nodiscard]] bool is_hub() const { return faces > kMostAtOnce; }
  void add(const Vec3& n) {
    squares = squares + Symmetric3::square(n);
    normal = normal + n;
    ++faces;
  }
  void take(const Vec3& n) {
    squares = squares - Symmetric3::square(n);
    normal = normal - n;
    --faces;
  }
};

class PatchGeometry {
 public:
  /// The positions times the scale. The mesh must outlive this. O(n).
  PatchGeometry(const CollapseMesh& mesh, std::span<const Vec3> positions, double scale = 1);

  [[nodiscard]] const Vec3& position(std::uint32_t v) const { return vertices_[v].position; }
  [[nodiscard]] const Vec3& normal(std::uint32_t f) const { return normals_[f]; }
  [[nodiscard]] const Star& star(std::uint32_t v) const { return vertices_[v].star; }

  /// To be called before the edge of c is collapsed.
  void before_collapse(std::uint32_t c);
  /// Also brings up to date what hangs on it. Its own sums are made anew. Those of a neighbour are
  /// changed, and made anew after as many changes as it has triangles, or when little is left of
  /// what was in them, so none drifts farther than a sum over its triangles is off. O(d) for a
  /// vertex of degree d, whatever its neighbours'.
  void move(std::uint32_t v, const Vec3& point);

  /// Signed, of the faces that are left.
  [[nodiscard]] double volume() const;

  /// Whether a triangle that stays is turned by more than 84 degrees or made a needle when the ends
  /// of the edge of c meet in `point`. Needles that there are may stay needles.
  [[nodiscard]] bool spoils_triangle(std::uint32_t c, const Vec3& point) const;

 private:
  /// Two cache lines.
  struct alignas(64) Vertex {
    Vec3 position;
    Star star;
    std::uint32_t changes = 0;  ///< since its star was summed
    double largest = 0;         ///< trace of the star's squares since then
  };

  [[nodiscard]] Vec3 normal_of(std::uint32_t f) const;
  void sum(std::uint32_t v);

  const CollapseMesh& mesh_;
  std::vector<Vertex> vertices_;
  std::vector<Vec3> normals_;
};

}  // namespace wrapatlas
