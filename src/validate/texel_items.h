// A mesh as the judge sees it: triangles in texels, and how exactly they are known.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "validate/divide.h"
#include "validate/tiles.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas::validate {

struct TexelItems {
  std::vector<Item> items;                    ///< stack and group are the chart's number
  std::vector<std::uint32_t> crossing_faces;  ///< they count as their convex hulls
};

/// Triangles of all faces that belong to a chart, UVs multiplied by `size`. `rounding`: per chart,
/// see below.
TexelItems items_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_chart, Vec2 size,
                    const std::vector<double>& rounding);

/// Per chart: the distance in units of `size` by which storing may have moved a corner: `Stored`
/// says how exactly the UVs are kept. UVs beyond 4 (counted from the face's tile, if `face_tile` is
/// not empty) get no more than those at 4.
std::vector<double> rounding_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_chart,
                                std::size_t charts, Vec2 size,
                                std::span<const Tile> face_tile = {});

}  // namespace wrapatlas::validate
