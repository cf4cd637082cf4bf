// Triangles whose edges can be collapsed: a corner table, in which each corner stands for the edge
// that leaves it too.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wrapatlas/geometry.h"
#include "wrapatlas/surface.h"

namespace wrapatlas {

/// A manifold of triangles, maybe with borders. Corner c, of triangle c / 3, is also its edge from
/// c to next(c), as in Surface; an edge inside has two of them, its twins. What is removed keeps
/// its number, which is not used again.
class CollapseMesh {
 public:
  /// All faces of the surface must be triangles. O(n).
  explicit CollapseMesh(const Surface& surface);

  [[nodiscard]] static std::uint32_t next(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
  [[nodiscard]] static std::uint32_t previous(std::uint32_t c) {
    return c % 3 == 0 ? c + 2 : c - 1;
  }

  [[nodiscard]] std::uint32_t vertex(std::uint32_t c) const { return corners_[c].vertex; }
  [[nodiscard]] std::uint32_t twin(std::uint32_t c) const { return corners_[c].twin; }
  [[nodiscard]] std::uint32_t edge(std::uint32_t c) const { return corners_[c].edge; }
  /// Across the edge from c.
  [[nodiscard]] std::uint32_t opposite(std::uint32_t c) const { return vertex(previous(c)); }
  /// One of the edge's corners; kNone if it is gone.
  [[nodiscard]] std::uint32_t corner_of_edge(std::uint32_t e) const { return edge_corner_[e]; }
  [[nodiscard]] std::uint32_t corner_of_vertex(std::uint32_t v) const { return vertex_corner_[v]; }
  [[nodiscard]] bool is_border(std::uint32_t v) const {
    return !is_closed_ && twin(vertex_corner_[v]) == kNone;
  }
  [[nodiscard]] bool has_face(std::uint32_t f) const { return vertex(3 * f) != kNone; }

  [[nodiscard]] std::uint32_t face_count() const { return face_count_; }  ///< that are left
  [[nodiscard]] std::uint32_t face_numbers() const { return std::uint32_t(corners_.size() / 3); }
  [[nodiscard]] std::uint32_t edge_numbers() const { return std::uint32_t(edge_corner_.size()); }
  [[nodiscard]] std::uint32_t vertex_numbers() const {
    return std::uint32_t(vertex_corner_.size());
  }

  /// visit(c) for the corners at v, face by face around it.
  template <typename Visit>
  void each_corner(std::uint32_t v, Visit&& visit) const {
    const std::uint32_t first = vertex_corner_[v];
    std::uint32_t c = first;
    do {
      const std::uint32_t following = twin(previous(c));
      visit(c);
      c = following;
    } while (c != first && c != kNone);
  }

  /// Whether is_it(c) holds for any corner at v; none after it is asked.
  template <typename Test>
  [[nodiscard]] bool any_corner(std::uint32_t v, Test&& is_it) const {
    const std::uint32_t first = vertex_corner_[v];
    std::uint32_t c = first;
    do {
      if (is_it(c)) return true;
      c = twin(previous(c));
    } while (c != first && c != kNone);
    return false;
  }

  /// visit(u, c) for the edges at v: u is the other end, c a corner of the edge.
  template <typename Visit>
  void each_edge(std::uint32_t v, Visit&& visit) const {
    const std::uint32_t first = vertex_corner_[v];
    std::uint32_t c = first;
    while (true) {
      visit(vertex(next(c)), c);
      const std::uint32_t last = previous(c);
      c = twin(last);
      if (c == kNone) visit(vertex(last), last);
      if (c == kNone || c == first) return;
    }
  }

  /// The link condition (Dey et al. 1999), exactly: whether the surface without the edge of c is
  /// again a manifold of the same topology, with at least a triangle, or four if it is closed.
  [[nodiscard]] bool can_collapse(std::uint32_t c);

  /// Takes the edge of c away, with its one or two faces: vertex(next(c)) becomes vertex(c). On
  /// either side two edges become one, which keeps the lower of their numbers: the numbers that are
  /// gone, with that of the edge itself, or kNone. Needs can_collapse(c).
  std::array<std::uint32_t, 3> collapse(std::uint32_t c);

  /// Vertices that some other edge joins to v as well: the triangles are no simplicial complex.
  [[nodiscard]] bool has_double_edge(std::uint32_t v);

 private:
  struct Corner {
    std::uint32_t vertex, twin, edge;
  };

  void number_edges();
  std::uint32_t close_face(std::uint32_t c);
  void anchor(std::uint32_t v, std::uint32_t corner);

  std::vector<Corner> corners_;
  std::vector<std::uint32_t> vertex_corner_;  ///< at a border the one whose edge is border
  std::vector<std::uint32_t> edge_corner_;
  std::vector<std::uint32_t> mark_;  ///< per vertex, the last stamp it got
  std::uint32_t stamp_ = 0;
  std::uint32_t face_count_ = 0;
  bool is_closed_ = true;  ///< from the beginning on, so it stays
};

}  // namespace wrapatlas
