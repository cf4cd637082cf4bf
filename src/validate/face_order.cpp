#include "validate/face_order.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "validate/connectivity.h"

namespace wrapatlas::validate {

std::vector<std::uint32_t> order_by_object(const Mesh& mesh) {
  std::unordered_map<std::uint32_t, std::size_t> place_of;
  std::vector<std::size_t> key(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::size_t place =
        place_of.try_emplace(mesh.object_of(f), place_of.size()).first->second;
    key[f] = 2 * place + (has_texcoords(mesh, f) ? 0 : 1);
  }
  std::vector<std::uint32_t> order(mesh.face_count());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
  return order;
}

Mesh reordered(const Mesh& mesh, std::span<const std::uint32_t> order) {
  Mesh result;
  result.positions = mesh.positions;
  result.texcoords = mesh.texcoords;
  for (const std::uint32_t f : order) {
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      result.corner_position.push_back(mesh.corner_position[c]);
      result.corner_texcoord.push_back(mesh.corner_texcoord[c]);
    }
    result.face_begin.push_back(static_cast<std::uint32_t>(result.corner_position.size()));
  }
  return result;
}

}  // namespace wrapatlas::validate
