// One face of the mesh that an atlas was made from, ready to be asked about points of the atlas.
#pragma once

#include <cstdint>

#include "validate/face_match.h"

namespace wrapatlas::validate {

/// Half the sum of the edges' moments: it adds up over the pieces of any tiling, flat or not.
Vec3 vector_area(const Mesh& mesh, std::size_t face, const Vec3& origin);

inline Vec3 position_of(const Mesh& mesh, std::uint32_t corner) {
  return mesh.positions[mesh.corner_position[corner]];
}

inline Vec2 texcoord_of(const Mesh& mesh, std::uint32_t corner) {
  const std::uint32_t index = mesh.corner_texcoord[corner];
  return index == kNone ? Vec2{} : mesh.texcoords[index];
}

/// How exactly an atlas keeps the places of the reference in space.
struct PositionStore {
  double relative = 0;  ///< a coordinate may be off by this much of its size
  bool exact = false;   ///< corners of the reference have the very same coordinates
};
PositionStore positions_of(const Mesh& atlas, const Mesh& reference);

class ReferenceFace {
 public:
  ReferenceFace(const Mesh& mesh, std::size_t face, PositionStore store);

  /// Its area drowns in the rounding of its positions.
  [[nodiscard]] bool thin() const { return thin_; }
  [[nodiscard]] Vec3 origin() const { return at(0); }

  [[nodiscard]] bool filled_by(const Vec3& area) const {
    return length(area - area_) <= area_rounding_;
  }
  /// As `filled_by`, when there may be more than one reason for a difference.
  [[nodiscard]] bool still_filled_by(const Vec3& area) const {
    return length(area - area_) <= 2 * area_rounding_;
  }
  [[nodiscard]] bool counts_as_flat(const Vec3& area) const {
    return length(area) <= 2 * area_rounding_;
  }

  [[nodiscard]] bool equals(const Mesh& atlas, std::size_t face) const;
  [[nodiscard]] bool contains(const Mesh& atlas, std::size_t face) const;
  [[nodiscard]] FaceMatch::Corner locate(const Vec3& p) const;

 private:
  [[nodiscard]] Vec3 at(std::uint32_t i) const { return position_of(mesh_, begin_ + i); }
  [[nodiscard]] Vec2 uv(std::uint32_t i) const { return texcoord_of(mesh_, begin_ + i); }
  [[nodiscard]] bool is_corner(const Vec3& p, std::uint32_t i) const;
  [[nodiscard]] bool elsewhere_too(const Vec3& p, const FaceMatch::Corner& found) const;
  [[nodiscard]] bool elsewhere_too(const Vec3& p, const FaceMatch::Corner& found, std::uint32_t i,
                                   std::uint32_t j) const;
  [[nodiscard]] FaceMatch::Corner on_outline(const Vec3& p, double& distance) const;
  [[nodiscard]] double steepest() const;
  [[nodiscard]] double doubt_beside(std::uint32_t corner) const;
  [[nodiscard]] FaceMatch::Corner inside(const Vec3& p) const;
  [[nodiscard]] bool on_some_triangle(const Vec3& p) const;
  [[nodiscard]] bool contains(const Vec3& p) const;

  const Mesh& mesh_;
  PositionStore store_;
  std::uint32_t begin_, size_;
  double rounding_ = 0, area_rounding_ = 0, bulge_ = 0;
  Vec3 area_, normal_;
  bool thin_ = false, flat_convex_ = false;
  Vec3 low_, high_;
};

}  // namespace wrapatlas::validate
