// Is each chart of the reference in the atlas as it was: turned, moved, scaled, and nothing else?
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "validate/face_match.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::validate {

struct ChartFit {
  enum class Verdict { similar, mirrored, distorted } verdict = Verdict::similar;
  double residual = 0;  ///< texels, the worst corner beyond what rounding allows it
  std::uint32_t worst_face = kNone;
  bool untold = false;         ///< places in space do not tell its corners apart: not compared
  double scale = 0;            ///< texels per reference UV unit; 0 where size is unknown
  double scale_doubt = 0;      ///< relative, from rounding and what the fit leaves over
  double weight = 0;           ///< how much of the reference this chart is
  Vec2 middle, placed_middle;  ///< of the chart in the reference, and where that came to lie
  Vec2 factor;                 ///< scale and rotation as a complex number

  /// Where a point of the reference lies if it moved with this chart.
  [[nodiscard]] Vec2 placed(Vec2 p) const {
    const Vec2 d = p - middle;
    return placed_middle + Vec2{factor.x * d.x - factor.y * d.y, factor.x * d.y + factor.y * d.x};
  }
};

struct Fits {
  std::vector<ChartFit> charts;
  /// Per face of the atlas: whole periods to add to its UVs to put its chart together again.
  std::vector<std::array<std::int32_t, 2>> face_shift;
  double scale = 0;        ///< the common one: weighted median; 0 if no chart has a size
  double scale_doubt = 0;  ///< relative: that of the chart in the middle
};

struct FitInput {
  const Mesh& atlas;
  const FaceMatch& match;
  const std::vector<std::uint32_t>& face_chart;  ///< per face of the atlas, of the reference
  const std::vector<std::uint32_t>& face_piece;  ///< per face of the atlas: connected in it
  std::size_t charts;                            ///< of the reference; later numbers are skipped
  Vec2 size;                                     ///< texels
  std::array<bool, 2> may_shift;                 ///< by whole periods, per axis
  const std::vector<double>& rounding;           ///< per chart, texels
  double tolerance;
};

/// Least-squares similarities of all charts. O(corners log corners).
Fits fit_charts(const FitInput& input);

}  // namespace wrapatlas::validate
