#include "charts/uv_vertices.h"

#include <bit>

namespace wrapatlas {
namespace {

std::uint64_t mixed(std::uint64_t x) {
  x ^= x >> 32U;
  x *= 0xd6e8feb86659fd93ULL;
  x ^= x >> 32U;
  x *= 0xd6e8feb86659fd93ULL;
  return x ^ (x >> 32U);
}

/// Numbers of distinct keys by open addressing; the keys themselves stay with the caller.
class Numbering {
 public:
  explicit Numbering(std::size_t most_keys)
      : slots_(std::bit_ceil(2 * most_keys + 2), kNone), mask_(slots_.size() - 1) {}

  /// The number for which same(number) holds, or else `next`, which is then taken.
  template <typename Same>
  std::uint32_t find_or_add(std::uint64_t hash, std::uint32_t next, Same&& same) {
    for (std::size_t slot = hash & mask_;; slot = (slot + 1) & mask_) {
      if (slots_[slot] == kNone) slots_[slot] = next;
      if (slots_[slot] == next || same(slots_[slot])) return slots_[slot];
    }
  }

 private:
  std::vector<std::uint32_t> slots_;
  std::size_t mask_;
};

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }

std::vector<std::uint32_t> weld_texcoords(const std::vector<Vec2>& texcoords) {
  Numbering numbering(texcoords.size());
  std::vector<std::uint32_t> first(texcoords.size());
  for (std::uint32_t i = 0; i < texcoords.size(); ++i) {
    const Vec2 uv = texcoords[i];
    first[i] = numbering.find_or_add(mixed(bits(uv.x) + mixed(bits(uv.y))), i,
                                     [&](std::uint32_t j) { return texcoords[j] == uv; });
  }
  return first;
}

}  // namespace

UvVertices find_uv_vertices(const Mesh& mesh) {
  const std::vector<std::uint32_t> position = weld_corners(mesh).of_corner;
  const std::vector<std::uint32_t> texcoord = weld_texcoords(mesh.texcoords);
  UvVertices vertices;
  vertices.of_corner.assign(mesh.corner_count(), kNone);
  std::vector<std::uint32_t> vertex_texcoord;
  Numbering numbering(mesh.corner_count());
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
    bool has_uv = true;
    for (std::uint32_t c = begin; c < end; ++c) has_uv = has_uv && mesh.corner_texcoord[c] != kNone;
    if (!has_uv) {
      ++vertices.faces_without_uv;
      continue;
    }
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t p = position[c];
      const std::uint32_t t = texcoord[mesh.corner_texcoord[c]];
      const auto next = static_cast<std::uint32_t>(vertices.position.size());
      const std::uint32_t vertex = numbering.find_or_add(
          mixed((std::uint64_t{p} << 32U) | t), next,
          [&](std::uint32_t v) { return vertices.position[v] == p && vertex_texcoord[v] == t; });
      if (vertex == next) {
        vertices.position.push_back(p);
        vertices.uv.push_back(mesh.texcoords[t]);
        vertex_texcoord.push_back(t);
      }
      vertices.of_corner[c] = vertex;
    }
  }
  return vertices;
}

}  // namespace wrapatlas
