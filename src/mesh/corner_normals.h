// The normals a surface is shaded by: those it came with, else smooth ones.
#pragma once

#include <span>

#include "mesh/triangulate.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {

/// Per corner of the triangles. `given`: per corner of the source, unit, or zero where it has none;
/// may be empty.
CornerVectors corner_normals(const Triangulated& triangles, std::span<const Vec3> given,
                             double hard_angle);

}  // namespace wrapatlas
