#pragma once

#include <cstdint>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// Whether two corners have equal UVs, or both have none.
inline bool same_uv(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t i = mesh.corner_texcoord[a], j = mesh.corner_texcoord[b];
  if (i == kNone || j == kNone) return i == j;
  return mesh.texcoords[i] == mesh.texcoords[j];
}

}  // namespace wrapatlas
