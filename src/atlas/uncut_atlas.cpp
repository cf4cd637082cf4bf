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

}  // namespace wrapatlas
