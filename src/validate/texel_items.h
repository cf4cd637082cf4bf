// A mesh as the judge sees it: triangles in texels, and how exactly they are known.
#pragma once

#include <cstdint>
#include <vector>

#include "validate/divide.h"
#include "validate/tiles.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas::validate {

/// Triangles of all faces that belong to a chart, UVs multiplied by `size`; stack and group are
/// the chart's number.
std::vector<Item> items_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_chart,
                           Vec2 size);

/// Per chart: the distance in units of `size` by which storing may have moved a corner. Where all
/// UVs of the mesh are floats that is half a float's last bit; where they are the shortest text of
/// floats, a whole one; else half a unit of the ninth
/// decimal digit; UVs beyond 4 (counted from the face's tile, if `face_tile` is not empty) get no
/// more than those at 4.
std::vector<double> rounding_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_chart,
                                std::size_t charts, Vec2 size,
                                std::span<const Tile> face_tile = {});

}  // namespace wrapatlas::validate
