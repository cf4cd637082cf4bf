// Where the edges of a mesh are cut by the border of the atlas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// Closer than this (in atlas UV, or in parameters of an edge) two places are taken for one.
inline constexpr double kSamePlace = 1e-12;

/// A place where the line u = line (axis 0) or v = line (axis 1) crosses an edge from a to b.
struct Crossing {
  double t = 0;  ///< in (0,1), from a to b
  int axis = 0;
  double line = 0;
};

/// Adds the crossings of the edge a-b with all border lines of the axes that wrap.
void find_crossings(Vec2 a, Vec2 b, Wrap wrap, std::vector<Crossing>& crossings);

/// A point to be inserted in an edge.
struct EdgePoint {
  double t = 0;                ///< from the canonically first end
  std::uint32_t position = 0;  ///< AtlasMesh::CutPoint::position
};

/// For every side of every face the points to be inserted in it: those where the side itself is
/// cut, and those where another face of the same edge in space, and of the same object, is.
class EdgeCuts {
 public:
  /// `corner_uv`: per corner of the mesh its (shifted) UV in the atlas; ignored without a chart.
  EdgeCuts(const Mesh& mesh, const ChartSet& charts, const std::vector<Vec2>& corner_uv, Wrap wrap);

  /// Points on the side from corner c to the next of its face, in canonical order.
  [[nodiscard]] std::span<const EdgePoint> on_side(std::size_t corner) const;

  /// Whether corner a comes before b in the canonical direction of their edge: by welded position,
  /// so that all faces of an edge agree; by UV where an edge has no length in space.
  [[nodiscard]] bool canonical(std::uint32_t a, std::uint32_t b) const;

  [[nodiscard]] std::uint32_t position_count() const { return position_count_; }

 private:
  [[nodiscard]] std::uint32_t welded(std::uint32_t corner) const {
    return welded_.of_corner[corner];
  }
  void cut_edge(std::span<const std::uint32_t> sides, const std::vector<double>& ts);

  const Mesh& mesh_;
  WeldedCorners welded_;
  std::vector<std::uint32_t> begin_, end_;  // per corner, into points_; empty if nothing is cut
  std::vector<EdgePoint> points_;
  std::uint32_t position_count_ = 0;
};

}  // namespace wrapatlas
