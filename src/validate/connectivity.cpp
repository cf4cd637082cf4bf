#include "validate/connectivity.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace wrapatlas::validate {
namespace {

/// Equal numbers for corners with equal position and UV in faces of one object.
std::vector<std::uint32_t> number_corners(const Mesh& mesh,
                                          std::span<const std::uint32_t> face_object) {
  const std::vector<std::uint32_t> welded = weld_positions(mesh.positions);
  struct Key {
    std::uint32_t position, object, corner;
    Vec2 uv;
    [[nodiscard]] auto value() const { return std::tie(position, object, uv.x, uv.y); }
  };
  std::vector<Key> keys;
  keys.reserve(mesh.corner_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t object = face_object.empty() ? 0 : face_object[face];
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      const std::uint32_t texcoord = mesh.corner_texcoord[c];
      if (texcoord == kNone) continue;
      keys.push_back({welded[mesh.corner_position[c]], object, c, mesh.texcoords[texcoord]});
    }
  }
  std::sort(keys.begin(), keys.end(),
            [](const Key& a, const Key& b) { return a.value() < b.value(); });
  std::vector<std::uint32_t> numbers(mesh.corner_count(), kNone);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0 && keys[i - 1].value() != keys[i].value()) ++next;
    numbers[keys[i].corner] = next;
  }
  return numbers;
}

}  // namespace

DisjointSets::DisjointSets(std::size_t size) : parent_(size) {
  std::iota(parent_.begin(), parent_.end(), 0U);
}

std::uint32_t DisjointSets::find(std::uint32_t i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

bool DisjointSets::join(std::uint32_t a, std::uint32_t b) {
  a = find(a);
  b = find(b);
  parent_[std::max(a, b)] = std::min(a, b);
  return a != b;
}

bool has_texcoords(const Mesh& mesh, std::size_t face) {
  for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
    if (mesh.corner_texcoord[c] == kNone) return false;
  }
  return true;
}

FaceCharts connect_faces(const Mesh& mesh, std::span<const std::uint32_t> face_object) {
  const std::vector<std::uint32_t> numbers = number_corners(mesh, face_object);
  struct Edge {
    std::uint32_t low, high, face;
  };
  std::vector<Edge> edges;
  edges.reserve(mesh.corner_count());
  FaceCharts charts;
  charts.of_face.assign(mesh.face_count(), kNone);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    if (!has_texcoords(mesh, face)) continue;
    const std::uint32_t begin = mesh.face_begin[face], size = mesh.face_size(face);
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = numbers[begin + i], b = numbers[begin + (i + 1) % size];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), face});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  DisjointSets sets(mesh.face_count());
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const Edge &a = edges[i - 1], &b = edges[i];
    if (a.low == b.low && a.high == b.high) sets.join(a.face, b.face);
  }
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    if (!has_texcoords(mesh, face)) continue;
    const std::uint32_t first = sets.find(face);
    charts.of_face[face] = first == face ? charts.count++ : charts.of_face[first];
  }
  return charts;
}

}  // namespace wrapatlas::validate
