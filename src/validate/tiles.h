// Pages of an atlas: UV tiles, ten to a row as UDIM numbers them.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas::validate {

struct Tile {
  std::int32_t row = 0, column = 0;  ///< rows count upwards
  friend auto operator<=>(const Tile&, const Tile&) = default;

  [[nodiscard]] bool is_page(int pages) const {
    return row >= 0 && column >= 0 && column < 10 && page() < pages;
  }
  [[nodiscard]] std::int64_t page() const { return std::int64_t{10} * row + column; }
};

/// Per face the tile of its group, the one that holds the group's smallest u and v (with
/// `v_points_down`: u and 1 - v). `face_group`: kNone for a face without UVs, whose tile is (0, 0).
std::vector<Tile> tiles_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_group,
                           std::size_t groups, bool v_points_down);

/// Moves every face from its tile to tile (0, 0). Each corner then has a texcoord of its own.
void move_to_first_tile(Mesh& mesh, const std::vector<Tile>& face_tile, bool v_points_down);

}  // namespace wrapatlas::validate
