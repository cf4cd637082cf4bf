// The axes a surface is shaded by: those it came with, else normals that are smooth and tangents as
// MikkTSpace makes them.
#pragma once

#include <span>

#include "mesh/triangulate.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {

/// Per corner of the triangles. `given`: per corner of the source, unit, or zero where it has none;
/// may be empty.
CornerVectors corner_normals(const Triangulated& triangles, std::span<const Vec3> given,
                             double hard_angle);

/// Those and the tangents; `given` as above. `v_points_down` as Model has it.
TangentFrames corner_frames(const Triangulated& triangles, CornerVectors normals,
                            std::span<const CornerTangent> given, bool v_points_down);

}  // namespace wrapatlas
