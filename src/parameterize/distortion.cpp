// Sander, Snyder, Gortler & Hoppe 2001, Texture mapping progressive meshes (SIGGRAPH 2001).
// a, b, c, L2 and Linf are the paper's; sums are scaled so that 1 is no distortion at any size.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/polygon_plane.h"
#include "wrapatlas/parameterize.h"

namespace wrapatlas {
namespace {

/// A triangle in space, its image, and the map from there to here.
struct Pair {
  double space = 0, plane = 0;  ///< areas; that in the plane is signed
  double a = 0, b = 0, c = 0;   ///< the products of the map's derivatives Ss and St
};

Pair make_pair(const std::array<Vec3, 3>& q, const std::array<Vec2, 3>& p) {
  // Ss and St as in the paper, but from edges, which are shorter than coordinates.
  const Vec3 q2 = q[1] - q[0], q3 = q[2] - q[0], q23 = q[2] - q[1];
  const Vec2 p2 = p[1] - p[0], p3 = p[2] - p[0];
  const double twice_space = length(cross(q2, q3)), twice_plane = cross(p2, p3);
  const double longest2 = std::max({dot(q2, q2), dot(q3, q3), dot(q23, q23)});
  if (!(twice_space > kNoArea * longest2)) return {0, twice_plane / 2};
  const Vec3 s = (1 / twice_plane) * (p3.y * q2 - p2.y * q3);
  const Vec3 t = (1 / twice_plane) * (p2.x * q3 - p3.x * q2);
  return {twice_space / 2, twice_plane / 2, dot(s, s), dot(s, t), dot(t, t)};
}

/// All triangles of a chart, and its area in the plane over that in space.
struct Pairs {
  std::vector<Pair> pairs;
  double plane = 0, density = 0;

  Pairs(std::span<const Vec3> points, std::span<const Vec2> uv,
        std::span<const std::array<std::uint32_t, 3>> triangles) {
    pairs.reserve(triangles.size());
    double space = 0;
    for (const auto& [i, j, k] : triangles) {
      pairs.push_back(make_pair({points[i], points[j], points[k]}, {uv[i], uv[j], uv[k]}));
      space += pairs.back().space;
      plane += std::abs(pairs.back().plane);
    }
    density = plane / space;
  }
};

}  // namespace

std::vector<double> triangle_stretch(std::span<const Vec3> points, std::span<const Vec2> uv,
                                     std::span<const std::array<std::uint32_t, 3>> triangles) {
  const Pairs all(points, uv, triangles);
  std::vector<double> stretch;
  stretch.reserve(triangles.size());
  for (const Pair& pair : all.pairs) {
    if (pair.space == 0) {
      stretch.push_back(1);
    } else if (pair.plane > 0) {
      stretch.push_back(std::sqrt(all.density * (pair.a + pair.c) / 2));
    } else {
      stretch.push_back(std::numeric_limits<double>::infinity());
    }
  }
  return stretch;
}

Distortion measure_distortion(std::span<const Vec3> points, std::span<const Vec2> uv,
                              std::span<const std::array<std::uint32_t, 3>> triangles) {
  const Pairs all(points, uv, triangles);
  const auto& [pairs, plane, density] = all;
  Distortion sum{.l2 = 0, .linf = 0, .angle = 0, .area = 0};
  double counted = 0;
  for (const Pair& pair : pairs) {
    if (!(pair.plane > 0)) {
      const bool counts = pair.space > 0 || pair.plane < -kNoArea * plane;
      sum.flipped += counts ? 1 : 0;
      continue;
    }
    if (pair.space == 0) continue;
    const double both = pair.a + pair.c;  // the sum of the singular values' squares
    const double product = pair.space / pair.plane, growth = pair.plane / (density * pair.space);
    sum.l2 += pair.space * both / 2;
    sum.linf = std::max(sum.linf, (both + std::hypot(pair.a - pair.c, 2 * pair.b)) / 2);
    sum.angle += pair.space * both / (2 * product);
    sum.area += pair.space * std::max(growth, 1 / growth);
    counted += pair.space;
  }
  if (counted > 0) {
    sum.l2 = std::sqrt(density * sum.l2 / counted);
    sum.linf = std::sqrt(density * sum.linf);
    sum.angle /= counted;
    sum.area /= counted;
  } else {
    sum = {.flipped = sum.flipped};
  }
  if (sum.flipped > 0) sum.l2 = sum.linf = std::numeric_limits<double>::infinity();
  return sum;
}

}  // namespace wrapatlas
