// The same shape in fewer triangles.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/result.h"
#include "wrapatlas/surface.h"

namespace wrapatlas {

/// How far it has come.
struct SimplifyProgress {
  double fraction = 0;    ///< of the triangles that are to go, in [0, 1]
  std::size_t faces = 0;  ///< that are left
};

struct SimplifyOptions {
  std::uint32_t target_faces = 0;  ///< triangles to end with, or one less; 0: as few as can be
  /// UVs are kept, and points on UV seams move along their seam only. Else the result has no UVs.
  bool keep_uv_seams = false;
  /// Called now and then from the calling thread; false: stop.
  std::function<bool(const SimplifyProgress&)> progress;
};

struct SimplifyReport {
  std::uint32_t faces_before = 0;    ///< triangles, after polygons were cut
  std::uint32_t faces_after = 0;     ///< above the target if no collapse is left that may be done
  std::uint32_t dropped_faces = 0;   ///< triangles that use a point twice: no part of the result
  std::uint32_t fixed_vertices = 0;  ///< where the surface is no manifold, or seams meet or end
  std::uint64_t refused = 0;  ///< times that the cheapest edge was not collapsed: topology or flips
  double volume_before = 0;   ///< units of the positions, cubed; of closed meshes only it means one
  double volume_after = 0;
  SurfaceReport surface;  ///< what was found in the mesh
};

struct Simplification {
  /// Triangles, all of a component wound alike, with the objects of their sources. Points that did
  /// not move have the same coordinates as before, to the bit.
  Mesh mesh;
  std::vector<std::uint32_t> face_source;  ///< per face: one of the mesh given; ascending
  SimplifyReport report;
};

/// Collapses edges, cheapest first (costs to an eighth), as Lindstrom & Turk 1998 (memoryless
/// simplification) say, until there are no more triangles than asked for or none can go. Keeps
/// topology: a closed surface stays closed, pieces and handles stay, and where faces do not form a
/// manifold nothing moves. Volume is kept but for rounding, where there is no border. The same bits
/// every time. The mesh must pass validate_mesh. Errors: input (no face has three points),
/// interrupted. O(n log n), and O(d) for each collapse that moves a point of d triangles: in all d²
/// where a cone's flat base, say, is eaten from its middle.
Result<Simplification> simplify(const Mesh& mesh, const SimplifyOptions& options = {});

}  // namespace wrapatlas
