// Where the charts of an atlas end.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas::bench {

/// Per face its chart, and per chart the edges that bound it, in texels.
class ChartBorders {
 public:
  /// Of triangles with UVs, on a square of so many texels a side.
  ChartBorders(const Mesh& mesh, int side);

  /// From a place, in texels, to the border of the chart of a face.
  [[nodiscard]] double distance(std::uint32_t face, Vec2 place) const;

 private:
  std::vector<std::uint32_t> chart_;
  std::map<std::uint32_t, std::vector<std::pair<Vec2, Vec2>>> edges_;
};

}  // namespace wrapatlas::bench
