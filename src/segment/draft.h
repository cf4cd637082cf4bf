// A chart as it is tried: faces, cut to a disc, flattened and judged.
#pragma once

#include <cstdint>
#include <vector>

#include "segment/cut_chart.h"
#include "wrapatlas/parameterize.h"
#include "wrapatlas/unwrap.h"

namespace wrapatlas {

struct Draft {
  std::vector<std::uint32_t> faces;  ///< of the surface
  std::vector<std::uint32_t> seams;  ///< corners of the surface, as cut_to_disc takes them
  CutChart disc;
  std::vector<Vec2> uv;  ///< per point of the disc; empty: not flattened
  Distortion distortion;
  bool used_lscm = false;
  double flatten_seconds = 0;  ///< of all the times it was flattened
  bool is_good = false;        ///< within the stretch asked for, no triangle flipped, no overlap
};

/// Cuts, flattens and judges the region, with more seams if that helps. `draft.seams` to begin
/// with; they may be none.
Draft make_draft(const Surface& surface, const Region& region, const FaceShapes& shapes,
                 std::vector<std::uint32_t> seams, const UnwrapOptions& options);

/// Is it flat, without flips, and stretched beyond options.max_stretch?
bool is_stretched(const Draft& draft, const UnwrapOptions& options);

}  // namespace wrapatlas
