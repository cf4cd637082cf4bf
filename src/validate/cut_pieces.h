// Pieces of charts that were cut at the border of the atlas, found without the mesh they came from.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "validate/connectivity.h"

namespace wrapatlas::validate {

struct CutCharts {
  FaceCharts charts;  ///< the charts as they were before the cut, numbered by first faces
  /// Per face: whole periods to add to its UVs to put its chart together again.
  std::vector<std::array<std::int32_t, 2>> face_shift;
};

/// Joins pieces that share an edge in space whose UVs lie on opposite sides of [0,1]^2 and differ
/// by one whole period. Where they can be put together in several ways (a band around a cylinder),
/// one of them is taken. O(n log n).
CutCharts join_cut_pieces(const Mesh& mesh, const FaceCharts& pieces);

}  // namespace wrapatlas::validate
