// Atlases made by hand: for tests and fuzzers of the writers, without charts or packing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "wrapatlas/atlas.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// The mesh's own faces and UVs.
inline AtlasMesh identity_atlas(const Mesh& mesh) {
  AtlasMesh atlas;
  atlas.texcoords = mesh.texcoords;
  atlas.face_begin = mesh.face_begin;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) atlas.face_source.push_back(f);
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) atlas.corner_source.push_back(c);
  atlas.corner_cut.assign(mesh.corner_count(), kNone);
  atlas.corner_texcoord = mesh.corner_texcoord;
  return atlas;
}

/// Each corner has a UV of its own, (corner, face) / 16, whether it had one or not.
inline AtlasMesh torn_atlas(const Mesh& mesh) {
  AtlasMesh atlas = identity_atlas(mesh);
  atlas.texcoords.clear();
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      atlas.corner_texcoord[c] = static_cast<std::uint32_t>(atlas.texcoords.size());
      atlas.texcoords.push_back({c / 16.0, f / 16.0});
    }
  }
  return atlas;
}

/// Every face is cut in two from the middle of its first edge to its last corner. `weight` is that
/// of the end of the edge whose position comes first. UVs are interpolated where there are any.
inline AtlasMesh halved_atlas(const Mesh& mesh, double weight = 0.5) {
  AtlasMesh atlas;
  atlas.texcoords = mesh.texcoords;
  const std::vector<std::uint32_t> welded = weld_positions(mesh.positions);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
    std::uint32_t a = begin, b = begin + 1;
    std::uint32_t key_a = welded[mesh.corner_position[a]], key_b = welded[mesh.corner_position[b]];
    if (key_b < key_a) {
      std::swap(a, b);
      std::swap(key_a, key_b);
    }
    const auto next = static_cast<std::uint32_t>(edges.size());
    const std::uint32_t number = edges.try_emplace({key_a, key_b}, next).first->second;
    const auto cut = static_cast<std::uint32_t>(atlas.cut_points.size());
    atlas.cut_points.push_back({{a, b, 0}, {weight, 1 - weight, 0}, number});
    std::uint32_t texcoord = kNone;
    const std::uint32_t uv_a = mesh.corner_texcoord[a], uv_b = mesh.corner_texcoord[b];
    if (uv_a != kNone && uv_b != kNone) {
      texcoord = static_cast<std::uint32_t>(atlas.texcoords.size());
      atlas.texcoords.push_back(weight * mesh.texcoords[uv_a] +
                                (1 - weight) * mesh.texcoords[uv_b]);
    }
    const auto add = [&](std::uint32_t corner) {
      atlas.corner_source.push_back(corner);
      atlas.corner_cut.push_back(corner == kNone ? cut : kNone);
      atlas.corner_texcoord.push_back(corner == kNone ? texcoord : mesh.corner_texcoord[corner]);
    };
    const auto close = [&] {
      atlas.face_begin.push_back(static_cast<std::uint32_t>(atlas.corner_source.size()));
      atlas.face_source.push_back(f);
    };
    add(begin);
    add(kNone);
    add(end - 1);
    close();
    add(kNone);
    for (std::uint32_t c = begin + 1; c < end; ++c) add(c);
    close();
  }
  atlas.cut_position_count = static_cast<std::uint32_t>(edges.size());
  return atlas;
}

}  // namespace wrapatlas
