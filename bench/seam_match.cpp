#include "seam_match.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace wrapatlas::bench {
namespace {

int class_of(const PixelError& pixel) {
  constexpr double kClassesToTwice = 4, kLeast = 1e-3;  // degrees
  return static_cast<int>(std::floor(kClassesToTwice * std::log2(std::max(pixel.spread, kLeast))));
}

}  // namespace

SeamMatch match_borders(std::span<const PixelError> at_borders,
                        std::span<const PixelError> inside_charts) {
  constexpr std::size_t kFewest = 10;  // pixels of a class
  struct Inside {
    double sum = 0;
    std::size_t pixels = 0;
  };
  std::map<int, Inside> classes;
  for (const PixelError& pixel : inside_charts) {
    Inside& inside = classes[class_of(pixel)];
    inside.sum += pixel.map;
    ++inside.pixels;
  }
  SeamMatch match;
  for (const PixelError& pixel : at_borders) {
    const auto found = classes.find(class_of(pixel));
    if (found == classes.end() || found->second.pixels < kFewest) {
      ++match.without_match;
      continue;
    }
    ++match.pixels;
    match.border += pixel.map;
    match.inside += found->second.sum / double(found->second.pixels);
    match.seamless += pixel.seamless;
  }
  if (match.pixels > 0) {
    for (double* mean : {&match.border, &match.inside, &match.seamless}) {
      *mean /= double(match.pixels);
    }
  }
  return match;
}

}  // namespace wrapatlas::bench
