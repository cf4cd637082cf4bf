// The nearest of a set of texels, for every texel, in linear time: first within columns, then along
// rows by the lower envelope of parabolas (Felzenszwalb & Huttenlocher, Distance transforms of
// sampled functions, 2012). On an axis that wraps the line is gone along more than once.
#pragma once

#include <vector>

#include "wrapatlas/texture.h"

namespace wrapatlas {

/// Columns and rows from a texel to another; may lead over the border of axes that wrap.
struct TexelOffset {
  int across = 0, down = 0;
};

class NearestTexels {
 public:
  NearestTexels(int width, int height, const TexelMask& inside, Wrap wrap);

  /// Per texel of a row the way to the nearest one inside (Euclidean, from centre to centre; which
  /// of equals is not said, but always the same). false: none is inside. Thread safe.
  bool find_row(int y, std::vector<TexelOffset>& nearest) const;

 private:
  int width_;
  bool wraps_;               ///< along rows
  std::vector<int> offset_;  ///< per texel: rows to the nearest inside of its column, or kNowhere
};

}  // namespace wrapatlas
