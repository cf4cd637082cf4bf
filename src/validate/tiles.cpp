#include "validate/tiles.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas::validate {
namespace {

/// A chart on its tile's side may lie below it by this much, by rounding.
constexpr double kBelow = 0x1p-22;
constexpr double kFarthest = 1e6;

std::int32_t tile_at(double smallest) {
  return static_cast<std::int32_t>(
      std::clamp(std::floor(smallest + kBelow), -kFarthest, kFarthest));
}

}  // namespace

std::vector<Tile> tiles_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_group,
                           std::size_t groups, bool v_points_down) {
  std::vector<Box2> boxes(groups);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (face_group[f] == kNone) continue;
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      const Vec2 uv = mesh.texcoords[mesh.corner_texcoord[c]];
      boxes[face_group[f]].add({uv.x, v_points_down ? 1 - uv.y : uv.y});
    }
  }
  std::vector<Tile> tiles(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (face_group[f] == kNone) continue;
    const Vec2 smallest = boxes[face_group[f]].min;
    tiles[f] = {tile_at(smallest.y), tile_at(smallest.x)};
  }
  return tiles;
}

void move_to_first_tile(Mesh& mesh, const std::vector<Tile>& face_tile, bool v_points_down) {
  std::vector<Vec2> texcoords(mesh.corner_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto [row, column] = face_tile[f];
    const Vec2 tile{double(column), v_points_down ? -double(row) : double(row)};
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      std::uint32_t& texcoord = mesh.corner_texcoord[c];
      if (texcoord == kNone) continue;
      texcoords[c] = mesh.texcoords[texcoord] - tile;
      texcoord = c;
    }
  }
  mesh.texcoords = std::move(texcoords);
}

}  // namespace wrapatlas::validate
