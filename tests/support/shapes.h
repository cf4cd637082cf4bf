// Random and hand-made charts for tests. Everything follows from the seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "wrapatlas/charts.h"

namespace wrapatlas::test {

/// A uniform number in [low, high), the same on every platform (unlike std::*_distribution).
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11U) * 0x1.0p-53);
}

inline Chart rectangle(double width, double height) {
  return chart_from_triangles({{0, 0}, {width, 0}, {width, height}, {0, height}},
                              {{0, 1, 2}, {0, 2, 3}});
}

/// A star-shaped polygon around its centre with radii in [inner, outer].
inline Chart star(std::mt19937_64& random, int corners, double inner, double outer) {
  std::vector<Vec2> points{{0, 0}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = uniform(random, inner, outer);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    triangles.push_back(
        {0, static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>((i + 1) % corners + 1)});
  }
  return chart_from_triangles(std::move(points), std::move(triangles));
}

/// A band along an arc: C shapes, nearly closed rings.
inline Chart arc(double radius, double thickness, double sweep_radians, int steps) {
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int i = 0; i <= steps; ++i) {
    const double angle = sweep_radians * i / steps;
    const Vec2 along{std::cos(angle), std::sin(angle)};
    points.push_back((radius - thickness / 2) * along);
    points.push_back((radius + thickness / 2) * along);
    if (i == steps) break;
    const auto k = static_cast<std::uint32_t>(2 * i);
    triangles.push_back({k, k + 1, k + 3});
    triangles.push_back({k, k + 3, k + 2});
  }
  return chart_from_triangles(std::move(points), std::move(triangles));
}

/// Triangles thrown at random: folds, overlaps, both windings.
inline Chart soup(std::mt19937_64& random, int corners, int triangles) {
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    points.push_back({uniform(random, -1, 1), uniform(random, -1, 1)});
  }
  std::vector<std::array<std::uint32_t, 3>> faces;
  while (static_cast<int>(faces.size()) < triangles) {
    std::array<std::uint32_t, 3> face{};
    for (auto& corner : face)
      corner = static_cast<std::uint32_t>(random() % static_cast<unsigned>(corners));
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) faces.push_back(face);
  }
  return chart_from_triangles(std::move(points), std::move(faces));
}

/// A mixed set: stars, arcs, rectangles of widely different sizes.
inline std::vector<Chart> mixed_charts(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  std::vector<Chart> charts;
  for (int i = 0; i < count; ++i) {
    const double size = std::exp(uniform(random, -2, 0.5));
    switch (random() % 3) {
      case 0:
        charts.push_back(star(random, 5 + static_cast<int>(random() % 20), 0.3 * size, size));
        break;
      case 1:
        charts.push_back(arc(size, uniform(random, 0.1, 0.6) * size, uniform(random, 1, 6), 24));
        break;
      default:
        charts.push_back(rectangle(size, uniform(random, 0.05, 1) * size));
        break;
    }
  }
  return charts;
}

}  // namespace wrapatlas::test
