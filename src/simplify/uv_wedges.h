// UVs at the corners of triangles while edges are collapsed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simplify/collapse_mesh.h"
#include "simplify/creases.h"
#include "simplify/patch_geometry.h"
#include "wrapatlas/mesh.h"
#include "wrapatlas/surface.h"

namespace wrapatlas {

/// The corners at a vertex between two seams, a wedge, have one UV, or none.
class UvWedges {
 public:
  UvWedges(const Mesh& triangles, const Surface& surface, const CollapseMesh& mesh,
           const Creases& creases);

  /// Finds the UVs for the edge's ends met in `point`. Away from seams: what the triangle has there
  /// in whose prism the point lies. On a seam, whose sides go together: what either side has at the
  /// place of the edge that is nearest. False if a triangle would be turned over in the texture.
  bool prepare(const CollapseMesh& mesh, const PatchGeometry& geometry, const Creases& creases,
               std::uint32_t c, const Vec3& point);
  /// Takes over what prepare() found; to be called before the edge is collapsed.
  void apply(const CollapseMesh& mesh, std::uint32_t c);

  [[nodiscard]] std::size_t count() const { return uvs_.size(); }
  /// Of a corner: kNone, or the number of its UV.
  [[nodiscard]] std::uint32_t wedge(std::uint32_t c) const { return wedge_[c]; }
  [[nodiscard]] const Vec2& uv(std::uint32_t number) const { return uvs_[number]; }

 private:
  /// Of the ends of an edge, what becomes one.
  struct Join {
    std::uint32_t kept = kNone, gone = kNone;
    Vec2 uv;
  };

  void number_wedges(const Mesh& triangles, const Surface& surface, const CollapseMesh& mesh,
                     const Creases& creases, std::uint32_t v);
  [[nodiscard]] Vec2 uv_at(const CollapseMesh& mesh, const PatchGeometry& geometry, std::uint32_t c,
                           const Vec3& point) const;
  [[nodiscard]] bool turns_over(const CollapseMesh& mesh, std::uint32_t c) const;
  [[nodiscard]] const Join* join_of(std::uint32_t wedge) const;

  std::vector<std::uint32_t> wedge_;  ///< per corner
  std::vector<Vec2> uvs_;
  std::array<Join, 2> joins_;  ///< of the edge that was prepared last; one per side of a seam
};

}  // namespace wrapatlas
