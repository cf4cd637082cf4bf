// Flattening a chart: from a disc in space to the plane, and how far that distorts it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

enum class FlattenMethod {
  labf,  ///< linear angle based flattening (Zayer, Lévy & Seidel 2007)
  lscm,  ///< least squares conformal maps on the mesh's own angles (Lévy et al. 2002)
};

struct FlattenOptions {
  FlattenMethod method = FlattenMethod::labf;
  int iterations = 2;  ///< linear solves of labf, 1 to 20; 1 is the publication's
};

struct Flattening {
  std::vector<Vec2> uv;       ///< per point; counter-clockwise as the triangles; area as in space
  FlattenMethod method;       ///< lscm also where labf gave angles that no triangle has
  double wheel_residual = 0;  ///< largest |error| of an interior vertex's wheel row, after labf
};

/// Flattens a disc: connected, oriented triangles, each edge in one or two of them, one border
/// loop. `triangles` index `points`; each point is in use. Zero-area triangles are taken as if
/// their angles were between 3 and 175 degrees. Scaled so that the area in the plane equals that in
/// space. Promises neither that no triangle is flipped nor that the border does not cross itself:
/// see below. Errors: input (not a disc; the system cannot be solved). O(n^1.5) for n triangles.
Result<Flattening> flatten_disc(std::span<const Vec3> points,
                                std::span<const std::array<std::uint32_t, 3>> triangles,
                                const FlattenOptions& options = {});

/// Sander et al. 2001, Texture mapping progressive meshes. Values of 1 are no distortion.
struct Distortion {
  double l2 = 0;  ///< root of the area-weighted mean of L2(T)^2, times root of (A2/A3)
  double linf =
      0;  ///< largest singular value of any triangle's map to space, times root of (A2/A3)
  double angle =
      0;  ///< area-weighted mean of (s/t + t/s)/2 for singular values s, t: 1 = conformal
  double area =
      0;  ///< area-weighted mean of max(r, 1/r), r = area in the plane / in space, normalised
  std::uint32_t flipped =
      0;  ///< triangles of no or negative area in the plane (of positive area in space)
};
/// l2 and linf are infinite if a triangle is flipped. Triangles of no area in space count for
/// `flipped` alone, and only if their area in the plane is negative.
Distortion measure_distortion(std::span<const Vec3> points, std::span<const Vec2> uv,
                              std::span<const std::array<std::uint32_t, 3>> triangles);

/// Does the border of a flattened disc cross or touch itself? With no triangle flipped, a border
/// that does not is enough for a map without any overlap. Exact for the coordinates as given (no
/// rounding decides). O(E log E) for E border edges that are spread out.
bool border_crosses(std::span<const Vec2> uv,
                    std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace wrapatlas
