#include "parameterize/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wrapatlas {
namespace {

/// Corners nearer to each other (relative to the longest edge) are as good as one, and would say
/// nothing of the third corner; they are taken to be as far apart as this.
constexpr double kSamePlace = 1e-6;

std::size_t largest_of(const std::array<double, 3>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

}  // namespace

std::vector<Shape> shapes_in_space(const Disc& disc) {
  std::vector<Shape> shapes;
  shapes.reserve(disc.triangles.size());
  for (const Triangle& triangle : disc.triangles) {
    std::array<double, 3> length2;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 edge = disc.points[triangle[next3(i)]] - disc.points[triangle[i]];
      length2[i] = dot(edge, edge);
    }
    const std::size_t first = largest_of(length2);
    const Vec3& p = disc.points[triangle[first]];
    const Vec3 a = disc.points[triangle[next3(first)]] - p;
    const Vec3 b = disc.points[triangle[prev3(first)]] - p;
    std::complex<double> ratio = std::polar(1.0, std::numbers::pi / 3);  // if all are one point
    if (length2[first] > 0) {
      ratio = {dot(a, b) / length2[first], length(cross(a, b)) / length2[first]};
      if (std::min(std::abs(ratio), std::abs(ratio - 1.0)) < kSamePlace) ratio.imag(kSamePlace);
    }
    shapes.push_back({first, ratio});
  }
  return shapes;
}

std::vector<Shape> shapes_of_angles(std::span<const double> angles) {
  std::vector<Shape> shapes;
  shapes.reserve(angles.size() / 3);
  for (std::size_t c = 0; c < angles.size(); c += 3) {
    const std::array<double, 3> sine{std::sin(angles[c]), std::sin(angles[c + 1]),
                                     std::sin(angles[c + 2])};
    const std::size_t last = largest_of(sine), first = next3(last);
    shapes.push_back({first, std::polar(sine[next3(first)] / sine[last], angles[c + first])});
  }
  return shapes;
}

}  // namespace wrapatlas
