// What the tests of simplify ask of meshes: obvious and slow.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "support/shapes.h"
#include "support/solids.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas::test {

using Triangle = std::array<std::uint32_t, 3>;

inline std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    EXPECT_EQ(mesh.face_size(f), 3U);
    const std::uint32_t* c = &mesh.corner_position[mesh.face_begin[f]];
    triangles.push_back({c[0], c[1], c[2]});
  }
  return triangles;
}

/// What tells surfaces apart: all of it follows from which triangles share which points.
struct Topology {
  bool is_manifold = true;  ///< oriented, with one fan or ring around each point
  int euler = 0, components = 0, borders = 0;

  friend bool operator==(const Topology&, const Topology&) = default;
};

inline Topology topology_of(const std::vector<Triangle>& triangles) {
  Topology topology;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> third;  // of directed edges
  std::set<std::uint32_t> points;
  std::set<std::set<std::uint32_t>> sets, edges;
  for (const Triangle& t : triangles) {
    topology.is_manifold = topology.is_manifold && sets.insert({t[0], t[1], t[2]}).second;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      topology.is_manifold = topology.is_manifold && a != b;
      topology.is_manifold =
          third.emplace(std::pair(a, b), t[(i + 2) % 3]).second && topology.is_manifold;
      points.insert(a);
      edges.insert({a, b});
    }
  }
  topology.euler = int(points.size()) - int(edges.size()) + int(triangles.size());
  // Around each point: from a border if there is one, or from anywhere; all must be met.
  std::map<std::uint32_t, std::uint32_t> border_next;
  for (const std::uint32_t p : points) {
    std::vector<std::uint32_t> around, starts;
    for (auto at = third.lower_bound({p, 0}); at != third.end() && at->first.first == p; ++at) {
      around.push_back(at->first.second);
      if (third.count({at->first.second, p}) == 0) starts.push_back(at->first.second);
    }
    std::uint32_t at = starts.empty() ? around.front() : starts.front();
    if (!starts.empty()) border_next[p] = at;
    std::size_t met = 0;
    while (met < around.size() && third.count({p, at}) > 0) {
      at = third[{p, at}];
      ++met;
    }
    const bool closes = !starts.empty() || at == around.front();
    topology.is_manifold =
        topology.is_manifold && starts.size() <= 1 && met == around.size() && closes;
  }
  while (!border_next.empty()) {
    ++topology.borders;
    std::uint32_t at = border_next.begin()->first;
    while (border_next.count(at) > 0) {
      const std::uint32_t following = border_next[at];
      border_next.erase(at);
      at = following;
    }
  }
  std::map<std::uint32_t, std::uint32_t> parent;
  const auto root = [&](std::uint32_t p) {
    while (parent[p] != p) p = parent[p];
    return p;
  };
  for (const std::uint32_t p : points) parent[p] = p;
  for (const Triangle& t : triangles) {
    parent[root(t[0])] = root(t[1]);
    parent[root(t[1])] = root(t[2]);
  }
  for (const std::uint32_t p : points) topology.components += parent[p] == p ? 1 : 0;
  return topology;
}

inline double volume_of(const Mesh& mesh) {
  double sum = 0;
  const Vec3 origin = mesh.positions[0];
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const auto at = [&](std::uint32_t i) {
      return mesh.positions[mesh.corner_position[mesh.face_begin[f] + i]] - origin;
    };
    for (std::uint32_t i = 1; i + 1 < mesh.face_size(f); ++i) {
      sum += dot(at(0), cross(at(i), at(i + 1))) / 6;
    }
  }
  return sum;
}

/// A sphere whose radius varies with a few waves of the seed's.
inline Mesh bumpy_ball(std::uint32_t n, double height, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Vec3> waves;
  for (int i = 0; i < 5; ++i) {
    waves.push_back({uniform(random, -6, 6), uniform(random, -6, 6), uniform(random, -6, 6)});
  }
  Mesh mesh = ball(n);
  for (Vec3& p : mesh.positions) {
    double radius = 1;
    for (const Vec3& wave : waves) radius += height * std::sin(dot(wave, p) + wave.x);
    p = radius * p;
  }
  return mesh;
}

/// A tube along a trefoil.
inline Mesh knot(std::uint32_t n) {
  return grid_mesh(12 * n, n, {true, true}, false, [](double u, double v) {
    const auto path = [](double t) {
      return Vec3{std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                  -std::sin(3 * t)};
    };
    const double t = 2 * std::numbers::pi * u, a = 2 * std::numbers::pi * v;
    const Vec3 along = path(t + 1e-4) - path(t - 1e-4), side = cross(along, {0, 0, 1});
    const Vec3 up = cross(side, along);
    return path(t) + 0.35 * (std::cos(a) / length(side) * side + std::sin(a) / length(up) * up);
  });
}

}  // namespace wrapatlas::test
