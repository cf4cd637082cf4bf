#include "seam_match.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace wrapatlas::bench {
namespace {

int class_of(const PixelError& pixel) {
  constexpr double kClassesToTwice = 4, kLeast = 1e-3, kMost = 180;  // degrees
  const double spread = std::clamp(pixel.spread, kLeast, kMost);
  return static_cast<int>(std::floor(kClassesToTwice * std::log2(spread)));
}

/// Sums, until divided().
void add(MeanError& to, double map, double bare, double seamless) {
  to.map += map;
  to.bare += bare;
  to.seamless += seamless;
  ++to.pixels;
}

MeanError divided(const MeanError& sum, std::size_t pixels) {
  if (pixels == 0) return sum;
  const auto n = double(pixels);
  return {sum.map / n, sum.bare / n, sum.seamless / n, sum.pixels};
}

}  // namespace

SpreadMatch match_by_spread(std::span<const PixelError> at_borders,
                            std::span<const PixelError> inside_charts) {
  constexpr std::size_t kFewest = 10;  // pixels of a class
  std::map<int, MeanError> classes;
  for (const PixelError& pixel : inside_charts) {
    add(classes[class_of(pixel)], pixel.map, pixel.bare, pixel.seamless);
  }
  for (auto& [number, inside] : classes) inside = divided(inside, inside.pixels);
  SpreadMatch match;
  std::map<int, std::size_t> used;
  for (const PixelError& pixel : at_borders) {
    const auto found = classes.find(class_of(pixel));
    const bool has_match = found != classes.end() && found->second.pixels >= kFewest;
    add(has_match ? match.border : match.without_match, pixel.map, pixel.bare, pixel.seamless);
    if (!has_match) continue;
    const MeanError& inside = found->second;
    add(match.inside, inside.map, inside.bare, inside.seamless);
    used[found->first] = inside.pixels;
  }
  match.border = divided(match.border, match.border.pixels);
  match.without_match = divided(match.without_match, match.without_match.pixels);
  match.inside = divided(match.inside, match.inside.pixels);
  match.inside.pixels = 0;
  for (const auto& [number, pixels] : used) match.inside.pixels += pixels;
  return match;
}

}  // namespace wrapatlas::bench
