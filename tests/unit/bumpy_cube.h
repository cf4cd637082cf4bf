// A closed surface with charts on it, and what an exported atlas makes of a mesh.
#pragma once

#include <array>
#include <map>
#include <random>

#include "uv_mesh.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas::test {

/// The atlas as a mesh of its own: source positions, then one per cut position.
inline Mesh applied(const Mesh& mesh, const AtlasMesh& atlas) {
  Mesh out;
  out.positions = mesh.positions;
  out.positions.resize(mesh.positions.size() + atlas.cut_position_count);
  out.texcoords = atlas.texcoords;
  out.face_begin = atlas.face_begin;
  out.corner_texcoord = atlas.corner_texcoord;
  for (std::size_t c = 0; c < atlas.corner_source.size(); ++c) {
    if (atlas.corner_cut[c] == kNone) {
      out.corner_position.push_back(mesh.corner_position[atlas.corner_source[c]]);
      continue;
    }
    const AtlasMesh::CutPoint& cut = atlas.cut_points[atlas.corner_cut[c]];
    Vec3 p;
    for (std::size_t i = 0; i < 3; ++i) {
      p = p + cut.weights[i] * mesh.positions[mesh.corner_position[cut.corners[i]]];
    }
    const std::size_t index = mesh.positions.size() + cut.position;
    out.positions[index] = p;
    out.corner_position.push_back(static_cast<std::uint32_t>(index));
  }
  return out;
}

/// The surface of a cube, n x n faces a side, each side a chart; bumpy, so no quad is plane.
/// `kind` 0: triangles, 1: quads, 2: both, 3: quads with some of them bent in (not convex).
inline Mesh cube(std::uint32_t n, int kind, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  MeshBuilder b;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> position;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    std::map<std::array<std::uint32_t, 2>, MeshBuilder::Corner> corner;
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t j = 0; j <= n; ++j) {
        std::array<std::uint32_t, 3> at{};
        at[axis] = side % 2 ? n : 0;
        at[(axis + 1) % 3] = side % 2 ? i : j;
        at[(axis + 2) % 3] = side % 2 ? j : i;
        if (!position.count(at)) {
          position[at] =
              b.position({at[0] + noise(random), at[1] + noise(random), at[2] + noise(random)});
        }
        const double bend = kind == 3 && i % 2 && j % 2 && i < n && j < n ? 0.8 : 0.2;
        const Vec2 d{bend * (0.9 + noise(random)), bend * (0.9 + noise(random))};
        corner[{i, j}] = {position[at], b.texcoord(Vec2{double(i), double(j)} + d)};
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const auto p = corner[{i, j}], q = corner[{i + 1, j}], r = corner[{i + 1, j + 1}],
                   s = corner[{i, j + 1}];
        if (kind == 0 || (kind == 2 && (i + j) % 2)) {
          b.face({p, q, r});
          b.face({p, r, s});
        } else {
          b.face({p, q, r, s});
        }
      }
    }
  }
  return b.mesh;
}

}  // namespace wrapatlas::test
