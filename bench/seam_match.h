// The error at borders of charts beside that inside charts where the surface bends as much.
#pragma once

#include <cstddef>
#include <span>

namespace wrapatlas::bench {

/// How far normals are off at a pixel, in degrees.
struct PixelError {
  double map = 0;       ///< read from a map,
  double bare = 0;      ///< from one with nothing beyond the charts,
  double seamless = 0;  ///< and what filtering alone leaves (Seamless)
  double spread = 0;    ///< of the surface's normals over the texels that are read
};

/// Means over pixels.
struct MeanError {
  double map = 0, bare = 0, seamless = 0;
  std::size_t pixels = 0;
};

struct SpreadMatch {
  MeanError border;         ///< at borders, of pixels that have a match,
  MeanError inside;         ///< what their classes have inside charts; `pixels` of these classes,
  MeanError without_match;  ///< and at the borders that have none
};

/// Pixels are put into classes by their spread, a class being a quarter of an octave. A class with
/// fewer than ten pixels inside charts is no match.
SpreadMatch match_by_spread(std::span<const PixelError> at_borders,
                            std::span<const PixelError> inside_charts);

}  // namespace wrapatlas::bench
