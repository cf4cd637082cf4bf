#include "vertices.h"

#include <algorithm>

#include "io/cut_vertices.h"

namespace wrapatlas::python {
namespace {

/// Numbers corners by what they are: equal keys, equal numbers, in the order of first corners.
/// Returns the first corner of each number.
std::vector<std::uint32_t> number_keys(const std::vector<std::uint64_t>& keys,
                                       std::vector<std::uint32_t>& number) {
  std::vector<std::uint32_t> order(keys.size());
  for (std::uint32_t c = 0; c < order.size(); ++c) order[c] = c;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  std::vector<std::uint32_t> first(keys.size());  // per corner: the first of its key
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_new = i == 0 || keys[order[i]] != keys[order[i - 1]];
    first[order[i]] = is_new ? order[i] : first[order[i - 1]];
  }
  std::vector<std::uint32_t> firsts;
  number.resize(keys.size());
  for (std::uint32_t c = 0; c < keys.size(); ++c) {
    if (first[c] == c) {
      number[c] = static_cast<std::uint32_t>(firsts.size());
      firsts.push_back(c);
    } else {
      number[c] = number[first[c]];
    }
  }
  return firsts;
}

}  // namespace

Vertices split_vertices(const Mesh& mesh, const AtlasMesh& atlas) {
  const CutVertices cut = number_cut_vertices(mesh, atlas);
  const auto source_vertices = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<std::uint64_t> keys(atlas.corner_source.size());
  for (std::size_t c = 0; c < keys.size(); ++c) {
    const std::uint32_t corner = atlas.corner_source[c];
    const std::uint32_t place = corner != kNone
                                    ? mesh.corner_position[corner]
                                    : source_vertices + cut.of_point[atlas.corner_cut[c]];
    keys[c] = std::uint64_t{atlas.corner_texcoord[c]} << 32U | place;
  }
  Vertices vertices;
  const std::vector<std::uint32_t> firsts = number_keys(keys, vertices.of_corner);
  vertices.uv.reserve(2 * firsts.size());
  vertices.sources.reserve(firsts.size());
  vertices.weights.reserve(firsts.size());
  vertices.mapping.reserve(firsts.size());
  for (const std::uint32_t c : firsts) {
    const std::uint32_t texcoord = atlas.corner_texcoord[c], corner = atlas.corner_source[c];
    const Vec2 uv = texcoord == kNone ? Vec2{} : atlas.texcoords[texcoord];
    vertices.uv.push_back(static_cast<float>(uv.x));
    vertices.uv.push_back(static_cast<float>(uv.y));
    std::array<std::uint32_t, 3> sources{};
    std::array<double, 3> weights{1, 0, 0};
    if (corner != kNone) {
      sources.fill(mesh.corner_position[corner]);
    } else {
      const AtlasMesh::CutPoint& point = atlas.cut_points[atlas.corner_cut[c]];
      weights = point.weights;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t used = weights[i] != 0 ? i : 0;
        sources[i] = mesh.corner_position[point.corners[used]];
      }
    }
    const auto heaviest = std::max_element(weights.begin(), weights.end()) - weights.begin();
    vertices.mapping.push_back(sources[static_cast<std::size_t>(heaviest)]);
    vertices.sources.push_back(sources);
    vertices.weights.push_back(weights);
  }
  return vertices;
}

}  // namespace wrapatlas::python
