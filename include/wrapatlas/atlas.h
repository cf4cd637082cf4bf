// From a packing to new UVs of the mesh: whole charts that may cross the border, or cut ones.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/mesh.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// The mesh's faces with their new UVs; what writers need beside the source file. Uncut, face f
/// and corner c are face f and corner c of the source mesh. Cut, a face that crosses the border is
/// several faces in a row, and some corners are new points on it.
struct AtlasMesh {
  /// A point on a source face: sum of weights[i] * (attribute of source corner corners[i]).
  /// Points on an edge have weights[2] == 0 and their two corners ordered by (welded) position, so
  /// that both faces of the edge compute the same bits.
  struct CutPoint {
    std::array<std::uint32_t, 3> corners{};
    std::array<double, 3> weights{};
    std::uint32_t position = 0;  ///< cut points with equal numbers are the same point in space
  };

  std::vector<Vec2> texcoords;                 ///< u = texel x / width, v = texel y / height
  std::vector<std::uint32_t> face_begin{0};    ///< face_count() + 1 entries
  std::vector<std::uint32_t> face_source;      ///< per face: face of the source mesh; ascending
  std::vector<std::uint32_t> corner_source;    ///< per corner: source corner, or kNone: cut point
  std::vector<std::uint32_t> corner_cut;       ///< per corner: index into cut_points, or kNone
  std::vector<std::uint32_t> corner_texcoord;  ///< per corner: into texcoords; kNone without UVs
  std::vector<CutPoint> cut_points;
  std::uint32_t cut_position_count = 0;  ///< cut_points[i].position < this
  Wrap wrap = Wrap::none;                ///< do UVs leave [0,1], so that samplers must repeat
  int pages = 1;                         ///< UV tiles in use; see export_continuous

  [[nodiscard]] std::size_t face_count() const { return face_begin.size() - 1; }
  [[nodiscard]] bool is_cut() const { return !cut_points.empty(); }
};

/// Whole charts, each shifted so that the smallest corner of its box lies in [0,1); its UVs may
/// exceed 1 on axes that wrap. One texcoord per (chart, point), in the order of the charts.
/// Of several pages, those of page p are then moved to its tile: by (p % 10, p / 10), as UDIM
/// numbers tiles. So the floor of a chart's smallest u and v tells its page, also after rounding to
/// float. Tiles go up: in a mesh with `v_points_down` that holds for 1 - v.
AtlasMesh export_continuous(const Mesh& mesh, const ChartSet& charts, const Packing& packing,
                            bool v_points_down = false);

/// Faces split along the border of the atlas: all UVs in [0,1], or of several pages within their
/// tiles. A point new on an edge is also inserted in the other faces of that edge, so that no crack
/// opens in the surface.
AtlasMesh export_cut(const Mesh& mesh, const ChartSet& charts, const Packing& packing,
                     bool v_points_down = false);

/// The mesh with the UVs that it has; faces without UVs stay without.
AtlasMesh keep_texcoords(const Mesh& mesh);

/// Gives the named faces of an uncut atlas the UVs that `part` has: an uncut atlas of a mesh that
/// is these faces alone, in that order.
void place_part(AtlasMesh& whole, std::span<const std::uint32_t> faces, const AtlasMesh& part);

/// Rounds all UVs to the nearest 32-bit float, which is what files and graphics cards hold. What is
/// checked after this is what a renderer will see.
void round_texcoords_to_float(AtlasMesh& atlas);

}  // namespace wrapatlas
