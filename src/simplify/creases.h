// What keeps edges from being collapsed besides topology: UV seams, and places that are no
// manifold.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simplify/collapse_mesh.h"
#include "wrapatlas/mesh.h"
#include "wrapatlas/surface.h"

namespace wrapatlas {

class Creases {
 public:
  /// `triangles` is what the surface was made of, and the surface what the mesh was made of. Seams
  /// are known if UVs are kept. O(n).
  Creases(const Mesh& triangles, const Surface& surface, CollapseMesh& mesh, bool keep_uv_seams);

  /// Per number of an edge; empty if UVs are not kept.
  [[nodiscard]] std::span<const std::uint8_t> is_seam() const { return is_seam_; }
  /// Vertices with two seam edges: both sides have a UV of their own there.
  [[nodiscard]] bool is_on_seam(std::uint32_t v) const { return kind_[v] == Kind::seam; }

  /// Whether the edge's ends may meet: both are free, or the edge is a part of a seam.
  [[nodiscard]] bool allow(const CollapseMesh& mesh, std::uint32_t c) const;
  /// Whether the edge's collapse would make an end of a seam, or a chart of a single triangle
  /// vanish.
  [[nodiscard]] bool closes_chart(const CollapseMesh& mesh, std::uint32_t c) const;
  /// To be called before the edge is collapsed: of two edges that become one, one may be a seam.
  void before_collapse(const CollapseMesh& mesh, std::uint32_t c);

  [[nodiscard]] std::uint32_t fixed_count() const;
  /// Per vertex: the first of those that are the same point in the mesh.
  [[nodiscard]] std::uint32_t first_at_point(std::uint32_t v) const {
    return first_at_point_.empty() ? v : first_at_point_[v];
  }

 private:
  enum class Kind : std::uint8_t { free, seam, fixed };

  void fix_shared_points(const Mesh& triangles, const Surface& surface);
  void fix_double_edges(CollapseMesh& mesh);
  void find_seams(const Mesh& triangles, const Surface& surface, const CollapseMesh& mesh);

  std::vector<Kind> kind_;
  bool all_free_ = false;
  std::vector<std::uint8_t> is_seam_;
  std::vector<std::uint32_t> first_at_point_;  ///< empty: each is alone
};

}  // namespace wrapatlas
