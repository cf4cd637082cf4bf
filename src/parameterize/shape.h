// What the triangles of a chart should look like in the plane.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "parameterize/disc.h"

namespace wrapatlas {

/// A triangle but for its place, turn and size: with U0, U1, U2 the corners first, first + 1 and
/// first + 2 (modulo 3) in the plane, U2 - U0 = ratio * (U1 - U0). Edge 01 is the longest.
struct Shape {
  std::size_t first = 0;
  std::complex<double> ratio;
};

/// As in space. Triangles of no area keep the place of their middle corner on the longest edge.
std::vector<Shape> shapes_in_space(const Disc& disc);

/// With the given angles, 3 per triangle, between 0 and pi.
std::vector<Shape> shapes_of_angles(std::span<const double> angles);

}  // namespace wrapatlas
