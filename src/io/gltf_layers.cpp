#include "io/gltf_layers.h"

#include <bit>

namespace wrapatlas {

GltfLayer::GltfLayer(std::vector<GltfUv> old_uvs)
    : old_count_(old_uvs.size()), uvs_(std::move(old_uvs)), taken_(old_count_) {}

std::uint32_t GltfLayer::other_vertex(std::uint32_t source, GltfUv uv) {
  if (!taken_[source]) {
    taken_[source] = true;
    uvs_[source] = uv;
    return source;
  }
  next_.resize(uvs_.size(), kNone);
  std::uint32_t at = source;
  for (;; at = next_[at]) {
    if (uvs_[at] == uv) return at;
    if (next_[at] == kNone) break;
  }
  const std::uint32_t copy = append(uv, {source, kNone});
  next_[at] = copy;
  return copy;
}

std::uint32_t GltfLayer::cut_vertex(std::uint32_t position_number, const GltfBlend& blend,
                                    GltfUv uv) {
  const std::array<std::uint32_t, 6> key = {position_number,
                                            blend.vertices[0],
                                            blend.vertices[1],
                                            blend.vertices[2],
                                            std::bit_cast<std::uint32_t>(uv[0] + 0.0F),
                                            std::bit_cast<std::uint32_t>(uv[1] + 0.0F)};
  const auto [found, fresh] = cut_vertices_.try_emplace(key, 0);
  if (fresh) {
    found->second = append(uv, {kNone, static_cast<std::uint32_t>(extra_.blends.size())});
    extra_.blends.push_back(blend);
  }
  return found->second;
}

bool GltfLayer::conflicts(std::uint32_t source, GltfUv uv) const {
  if (!taken_[source]) return false;
  for (std::uint32_t at = source; at != kNone; at = at < next_.size() ? next_[at] : kNone) {
    if (uvs_[at] == uv) return false;
  }
  return true;
}

std::uint32_t GltfLayer::append(GltfUv uv, GltfExtraVertex vertex) {
  const auto number = static_cast<std::uint32_t>(uvs_.size());
  uvs_.push_back(uv);
  extra_.vertices.push_back(vertex);
  return number;
}

}  // namespace wrapatlas
