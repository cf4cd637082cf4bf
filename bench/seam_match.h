// The error at borders of charts beside that inside charts where the surface bends as much.
#pragma once

#include <cstddef>
#include <span>

namespace wrapatlas::bench {

/// In degrees.
struct PixelError {
  double map = 0;       ///< how far off a normal is that is read from a map,
  double seamless = 0;  ///< and one that filtering alone leaves (Seamless)
  double spread = 0;    ///< of the surface's normals over the texels that are read
};

struct SeamMatch {
  double border = 0;              ///< mean error of the map at borders,
  double inside = 0;              ///< inside charts, class by class,
  double seamless = 0;            ///< and of filtering alone at borders
  std::size_t pixels = 0;         ///< at borders, that have a match
  std::size_t without_match = 0;  ///< at borders
};

/// Pixels are put into classes by the spread of normals, a class being a quarter of an octave.
/// `inside` is the mean over the pixels at borders of what the class of each has inside charts. A
/// class with fewer than ten pixels inside is no match.
SeamMatch match_borders(std::span<const PixelError> at_borders,
                        std::span<const PixelError> inside_charts);

}  // namespace wrapatlas::bench
