// Surfaces in space for tests: discs to be flattened. Everything follows from the seed.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "support/shapes.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas::test {

struct Surface {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A grid of columns * rows squares, each of two triangles; surface(x, y) for x, y in [0, 1].
template <typename Function>
Surface grid(int columns, int rows, Function surface) {
  Surface made;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      made.points.push_back(surface(double(i) / columns, double(j) / rows));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2 != 0) {
        made.triangles.insert(made.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        made.triangles.insert(made.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return made;
}

/// The part of the unit sphere around its pole up to `angle`, over squares bent into a disc. Of the
/// triangles in the square's corners one side each is almost the sum of the others.
inline Surface cap(int n, double angle) {
  return grid(n, n, [angle](double x, double y) {
    x = 2 * x - 1;
    y = 2 * y - 1;
    const double radius = std::max(std::abs(x), std::abs(y)), bent = std::hypot(x, y);
    if (bent == 0) return Vec3{0, 0, 1};
    const double around = std::sin(angle * radius) / bent;
    return Vec3{around * x, around * y, std::cos(angle * radius)};
  });
}

/// A square that is as bumpy as `height` says, of a jittered grid.
inline Surface bumpy(int n, double height, std::uint64_t seed, double jitter = 0.2) {
  std::mt19937_64 random(seed);
  std::array<double, 6> wave;
  for (double& w : wave) w = uniform(random, -5, 5);
  return grid(n, n, [&](double x, double y) {
    x += jitter / n * uniform(random, -1, 1);
    y += jitter / n * uniform(random, -1, 1);
    const double z = std::sin(wave[0] * x + wave[1] * y + wave[2]) +
                     std::cos(wave[3] * x + wave[4] * y + wave[5]);
    return Vec3{x, y, height * z};
  });
}

/// Point 0 in the middle, others around it.
inline Surface fan(const std::vector<Vec3>& around, const Vec3& middle) {
  Surface made{{middle}, {}};
  made.points.insert(made.points.end(), around.begin(), around.end());
  const auto n = static_cast<std::uint32_t>(around.size());
  for (std::uint32_t i = 0; i < n; ++i) made.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  return made;
}

}  // namespace wrapatlas::test
