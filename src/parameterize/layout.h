// From the shapes of a chart's triangles to its points in the plane.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "parameterize/disc.h"
#include "parameterize/shape.h"

namespace wrapatlas {

/// Points in the plane at which the triangles are, in the least squares, as near to their shapes as
/// they can be, at any size and turn. Nothing, if the system is singular. O(n^1.5).
std::optional<std::vector<Vec2>> lay_out(const Disc& disc, std::span<const std::uint32_t> order,
                                         std::span<const Shape> shapes);

}  // namespace wrapatlas
