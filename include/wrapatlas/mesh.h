// The mesh that everything starts from: polygons with a position and, maybe, a UV at each corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "wrapatlas/geometry.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// Polygons in the order of the file. Corner c of face f is one of the flat indices
/// [face_begin[f], face_begin[f + 1]); every per-corner array is indexed by it.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<Vec2> texcoords;                 ///< input UV units, raw values of the file
  std::vector<std::uint32_t> face_begin{0};    ///< face_count() + 1 entries, first 0
  std::vector<std::uint32_t> corner_position;  ///< index into positions
  std::vector<std::uint32_t> corner_texcoord;  ///< index into texcoords, or kNone
  /// Per face: the number of its object. Faces of different objects are never neighbours, wherever
  /// they lie. Empty: all are of one object.
  std::vector<std::uint32_t> face_object;

  [[nodiscard]] std::size_t face_count() const { return face_begin.size() - 1; }
  [[nodiscard]] std::size_t corner_count() const { return corner_position.size(); }
  [[nodiscard]] std::uint32_t face_size(std::size_t face) const {
    return face_begin[face + 1] - face_begin[face];
  }
  [[nodiscard]] std::uint32_t object_of(std::size_t face) const {
    return face_object.empty() ? 0 : face_object[face];
  }
};

/// Checks what the rest of the library relies on: monotone face_begin, at least three corners a
/// face, an object for all faces or for none, indices in range, finite coordinates of magnitude
/// below 1e30 (so that products stay finite). O(corners). The error names the first offending face
/// or vertex.
Status validate_mesh(const Mesh& mesh);

/// Gives each position the index of the first position with bit-equal coordinates (-0 == 0).
/// Files split vertices along normal and UV seams; this finds the surface again. O(n log n).
std::vector<std::uint32_t> weld_positions(std::span<const Vec3> positions);

/// The points of a surface that its faces share.
struct WeldedCorners {
  std::vector<std::uint32_t> of_corner;  ///< the number of each corner's point
  std::uint32_t count = 0;               ///< the numbers are below it; not all need be in use
};

/// Corners get equal numbers if their faces are of one object and their positions are bit-equal
/// (-0 == 0): what two faces must share to be neighbours. O(n log n).
WeldedCorners weld_corners(const Mesh& mesh);

/// Cuts a face into face_size - 2 triangles of corner offsets (0 .. face_size - 1), by ear
/// clipping in the plane of `points` (the face's corners in order; its orientation may be either).
/// Degenerate faces get a fan. O(k^2) for k corners of most faces, O(k^3) at worst.
void triangulate_polygon(std::span<const Vec2> points,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace wrapatlas
