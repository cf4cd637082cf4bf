// The judge's own charts: faces joined where they share an edge by value.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas::validate {

/// Disjoint sets of 0 .. size - 1; the representative is always the smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size);
  std::uint32_t find(std::uint32_t i);
  bool join(std::uint32_t a, std::uint32_t b);  ///< false if they were one already

 private:
  std::vector<std::uint32_t> parent_;
};

/// Has every corner of the face a UV?
bool has_texcoords(const Mesh& mesh, std::size_t face);

struct FaceCharts {
  std::vector<std::uint32_t> of_face;  ///< kNone for a face without UVs
  std::uint32_t count = 0;
};

/// Faces belong to one chart if a chain of shared edges joins them, where position and UV are equal
/// in value at both ends of each edge, within one object. `face_object` says of which object a face
/// is, in place of the mesh's own objects; empty: all are of one. Charts are numbered by their
/// first face. O(n log n).
FaceCharts connect_faces(const Mesh& mesh, std::span<const std::uint32_t> face_object);

}  // namespace wrapatlas::validate
