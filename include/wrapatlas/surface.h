// The surface of a mesh as an oriented manifold, made of whatever faces a file holds.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"
#include "wrapatlas/mesh.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// Where a surface is parted although its faces meet.
struct SurfaceOptions {
  double hard_angle = -1;  ///< radians: edges whose faces' normals differ by more; < 0: none
  bool uv_seams = false;   ///< edges at which the mesh's UVs differ, or one face has none
  std::span<const std::uint32_t> face_labels;  ///< edges between faces of unequal labels; or empty
};

/// What was found in the mesh, and how it was mended. No face is lost.
struct SurfaceReport {
  std::uint32_t folded_faces = 0;  ///< use a point twice: left out of the surface
  std::uint32_t flat_faces = 0;    ///< of no area; part of the surface
  std::uint32_t turned_faces = 0;  ///< wound against most of their component: taken the other way
  std::uint32_t one_sided_edges = 0;  ///< where the surface came back turned round: parted
  std::uint32_t crowded_edges =
      0;  ///< of more than two faces: these go on in pairs, the flattest first
  std::uint32_t shared_points = 0;    ///< at which several sheets of the mesh meet
  std::uint32_t duplicate_faces = 0;  ///< of the same points as an earlier face
  std::uint32_t components = 0;
  std::uint32_t border_edges = 0;  ///< of one face, after all that is said above
};

/// Polygons joined along edges. Each edge is of one or two faces, which walk it in opposite
/// directions, and the faces around a vertex are one fan or one ring.
/// Corner c of a face is also its edge from c to the next corner of the face.
struct Surface {
  std::vector<Vec3> points;                   ///< per vertex
  std::vector<std::uint32_t> face_begin{0};   ///< as in Mesh
  std::vector<std::uint32_t> corner_vertex;   ///< per corner
  std::vector<std::uint32_t> corner_twin;     ///< per corner: the other face's, or kNone: border
  std::vector<std::uint32_t> corner_face;     ///< per corner
  std::vector<std::uint32_t> corner_source;   ///< per corner: the mesh's
  std::vector<std::uint32_t> face_source;     ///< per face: the mesh's; ascending
  std::vector<std::uint32_t> triangle_begin;  ///< per face; face_count() + 1 entries
  /// Corners; of a face size - 2 of them: a fan from its first corner in the mesh where that lies
  /// within it, or else by ear clipping.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> folded_faces;  ///< faces of the mesh that are no part of this
  SurfaceReport report;

  [[nodiscard]] std::size_t face_count() const { return face_source.size(); }
  [[nodiscard]] std::uint32_t next(std::uint32_t corner) const {
    return corner + 1 == face_begin[corner_face[corner] + 1] ? face_begin[corner_face[corner]]
                                                             : corner + 1;
  }
};

/// The mesh must pass validate_mesh. Faces are of one surface if they share an edge by position and
/// are of one object. Errors: usage (labels for some faces alone). O(n log n).
Result<Surface> build_surface(const Mesh& mesh, const SurfaceOptions& options = {});

}  // namespace wrapatlas
