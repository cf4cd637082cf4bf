#include "atlas/uncut_atlas.h"

#include <numeric>

namespace wrapatlas {

AtlasMesh uncut_atlas(const Mesh& mesh) {
  AtlasMesh atlas;
  atlas.face_begin = mesh.face_begin;
  atlas.face_source.resize(mesh.face_count());
  std::iota(atlas.face_source.begin(), atlas.face_source.end(), 0U);
  atlas.corner_source.resize(mesh.corner_count());
  std::iota(atlas.corner_source.begin(), atlas.corner_source.end(), 0U);
  atlas.corner_cut.assign(mesh.corner_count(), kNone);
  atlas.corner_texcoord.assign(mesh.corner_count(), kNone);
  return atlas;
}

AtlasMesh keep_texcoords(const Mesh& mesh) {
  AtlasMesh atlas = uncut_atlas(mesh);
  atlas.texcoords = mesh.texcoords;
  atlas.corner_texcoord = mesh.corner_texcoord;
  return atlas;
}

void place_part(AtlasMesh& whole, std::span<const std::uint32_t> faces, const AtlasMesh& part) {
  const auto first = static_cast<std::uint32_t>(whole.texcoords.size());
  whole.texcoords.insert(whole.texcoords.end(), part.texcoords.begin(), part.texcoords.end());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::uint32_t to = whole.face_begin[faces[i]];
    for (std::uint32_t c = part.face_begin[i]; c < part.face_begin[i + 1]; ++c, ++to) {
      const std::uint32_t texcoord = part.corner_texcoord[c];
      whole.corner_texcoord[to] = texcoord == kNone ? kNone : first + texcoord;
    }
  }
  whole.wrap =
      wrap_on(wraps_u(whole.wrap) || wraps_u(part.wrap), wraps_v(whole.wrap) || wraps_v(part.wrap));
}

}  // namespace wrapatlas
