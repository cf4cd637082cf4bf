// One triangle, cut along the border lines of the atlas.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// A corner of a triangle or a point on it.
struct CutNode {
  Vec2 uv;                          ///< in the atlas, not yet shifted into [0,1]
  std::array<double, 3> weights{};  ///< of the triangle's corners
  std::uint32_t corner = kNone;     ///< source corner; kNone for a point that is new
  std::uint32_t cut = kNone;        ///< into AtlasMesh::cut_points; kNone: not there yet
};

/// Splits a ring of nodes around a triangle. All crossings of its sides with border lines must be
/// nodes already; nodes where lines cross each other inside are added. Pieces are convex rings,
/// wound as the triangle, each within one period of the atlas.
class TriangleSplitter {
 public:
  using Ring = std::vector<std::uint32_t>;  ///< into nodes

  std::vector<CutNode> nodes;

  std::vector<Ring> split(const Ring& ring, Wrap wrap);
  void clear();

 private:
  std::vector<Ring> split_along(Ring ring, int axis);
  std::uint32_t crossing_node(std::uint32_t a, std::uint32_t b, int axis, double line);

  // Two pieces meet at a cut and ask for the same node.
  std::map<std::tuple<std::uint32_t, std::uint32_t, int, double>, std::uint32_t> crossings_;
};

inline double coordinate(Vec2 uv, int axis) { return axis == 0 ? uv.x : uv.y; }

}  // namespace wrapatlas
