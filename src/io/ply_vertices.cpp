#include "io/ply_vertices.h"

#include <map>
#include <utility>

namespace wrapatlas {
namespace {

constexpr std::uint32_t kUnset = kNone - 1;

bool is_same_uv(const AtlasMesh& atlas, std::uint32_t a, std::uint32_t b) {
  if (a == b) return true;
  return a < kUnset && b < kUnset && atlas.texcoords[a] == atlas.texcoords[b];
}

}  // namespace

PlyVertices number_ply_vertices(const Mesh& mesh, const AtlasMesh& atlas, bool uvs_on_vertices) {
  PlyVertices vertices;
  const auto old_count = static_cast<std::uint32_t>(mesh.positions.size());
  const CutVertices cut = number_cut_vertices(mesh, atlas);
  for (const std::uint32_t point : cut.first_point) vertices.added.push_back({kNone, point, kNone});

  // What each vertex, old or cut, has as its own UV; others go to repeats of it.
  std::vector<std::uint32_t> own(old_count + cut.first_point.size(), kUnset);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> repeats;
  vertices.corner_vertex.reserve(atlas.corner_source.size());
  for (std::size_t c = 0; c < atlas.corner_source.size(); ++c) {
    const std::uint32_t corner = atlas.corner_source[c];
    const std::uint32_t vertex = corner != kNone ? mesh.corner_position[corner]
                                                 : old_count + cut.of_point[atlas.corner_cut[c]];
    const std::uint32_t texcoord = atlas.corner_texcoord[c];
    if (own[vertex] == kUnset) own[vertex] = texcoord;
    if (!uvs_on_vertices || is_same_uv(atlas, own[vertex], texcoord)) {
      vertices.corner_vertex.push_back(vertex);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(old_count + vertices.added.size());
    const auto [entry, is_new] = repeats.try_emplace({vertex, texcoord}, next);
    if (is_new) {
      PlyVertices::Added repeat{vertex, kNone, texcoord};
      if (vertex >= old_count) repeat = {kNone, cut.first_point[vertex - old_count], texcoord};
      vertices.added.push_back(repeat);
    }
    vertices.corner_vertex.push_back(entry->second);
  }
  vertices.texcoord.assign(old_count, kNone);
  if (!uvs_on_vertices) return vertices;
  for (std::uint32_t i = 0; i < own.size(); ++i) {
    if (own[i] == kUnset) continue;
    (i < old_count ? vertices.texcoord[i] : vertices.added[i - old_count].texcoord) = own[i];
  }
  return vertices;
}

}  // namespace wrapatlas
