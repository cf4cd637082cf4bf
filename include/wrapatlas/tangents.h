// Smooth normals and the tangents that normal maps are stored along.
#pragma once

#include <cstdint>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// Per corner of a mesh; each is a unit vector, or zero where the faces around have no area.
using CornerVectors = std::vector<Vec3>;

/// Normals shared by all faces around a point of the surface (weld_corners), each weighted with its
/// angle there. Where two faces differ by more than `hard_angle` (radians) across an edge, normals
/// end at that edge; < 0: nowhere. O(n log n).
CornerVectors smooth_normals(const Mesh& mesh, double hard_angle = -1);

/// The u axis of tangent space at a corner, and whether UVs are mirrored there (-1).
struct CornerTangent {
  Vec3 direction;  ///< unit, or zero: none
  float sign = 1;
};

/// The axes of tangent space at each corner: u, bitangent = sign * cross(normal, tangent), normal.
struct TangentFrames {
  CornerVectors normal, tangent;
  std::vector<float> sign;  ///< 1 or -1 (UVs mirrored)
};

/// Tangents as MikkTSpace defines them (Mikkelsen 2008): within corners of equal position, normal,
/// UV and orientation that hang together by edges, the mean of the faces' tangents, weighted with
/// angles. Those a renderer uses that follows glTF's rule. `v_points_down` as Model has it: tangent
/// space has v up. Corners without UVs, or on faces whose UVs have no area, have some tangent that
/// is perpendicular to the normal, their group's if there is one. Preconditions: triangles alone; a
/// normal per corner. O(n log n).
TangentFrames tangent_frames(const Mesh& mesh, CornerVectors normals, bool v_points_down);

}  // namespace wrapatlas
