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

inline constexpr int kMostIterations = 20;

struct FlattenOptions {
  FlattenMethod method = FlattenMethod::labf;
  int iterations = 2;  ///< linear solves of labf, 1 to kMostIterations; 1 is the publication's
};

struct Flattening {
  std::vector<Vec2> uv;  ///< per point; counter-clockwise as the triangles; area as in space
  FlattenMethod method;  ///< lscm also where labf gave angles that no triangle has
  double wheel_residual =
      0;  ///< largest |error| of an interior point's wheel row, after labf; or 0
};

/// Flattens a disc: connected, oriented triangles, each edge in one or two of them, one border
/// loop. `triangles` index `points`; each point is in use. Flat discs and others that can be
/// unrolled come out as they are. For labf, triangles of no area (an angle below 0.01 degrees) are
/// taken as if their angles were between 3 and 175 degrees. Scaled so that the areas in the plane,
/// each taken as positive, add up to the area in space. Promises neither that no triangle is
/// flipped nor that the border does not cross itself: see below. Errors: usage (iterations); input
/// (an index or a coordinate that is none, not a disc, no area, the system cannot be solved).
/// O(n^1.5) for n triangles, of which there may be 2^22. Thread safe.
Result<Flattening> flatten_disc(std::span<const Vec3> points,
                                std::span<const std::array<std::uint32_t, 3>> triangles,
                                const FlattenOptions& options = {});

/// Sander et al. 2001, Texture mapping progressive meshes. Values of 1 are no distortion.
struct Distortion {
  double l2 = 1;    ///< root of the area-weighted mean of L2(T)^2, times root of (A2/A3)
  double linf = 1;  ///< largest singular value of any map to space, times root of (A2/A3)
  double angle =
      1;  ///< area-weighted mean of (s/t + t/s)/2 for singular values s, t: 1 = conformal
  double area =
      1;  ///< area-weighted mean of max(r, 1/r), r = (area in the plane / in space)/(A2/A3)
  std::uint32_t flipped = 0;  ///< triangles of no or negative area in the plane, but not in space
};
/// A3 is the area in space; A2 that in the plane, each triangle's taken as positive. l2 and linf
/// are infinite if a triangle is flipped; angle and area leave flipped ones out. Triangles of no
/// area in space (but for rounding) count for `flipped` alone, and only if their area in the plane
/// is negative (by more than rounding). Precondition: finite coordinates, indices in range. O(n).
Distortion measure_distortion(std::span<const Vec3> points, std::span<const Vec2> uv,
                              std::span<const std::array<std::uint32_t, 3>> triangles);

/// L2(T) of each triangle, times root of (A2/A3): the values whose mean square l2 is. Infinite
/// where a triangle is flipped, 1 where it has no area in space.
std::vector<double> triangle_stretch(std::span<const Vec3> points, std::span<const Vec2> uv,
                                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Does the border of a flattened disc cross or touch itself? With no triangle flipped, a border
/// that does not is enough for a map without any overlap. The border is the edges of one triangle
/// alone; it may be several loops. True also where more than two border edges share a point, where
/// two points of the border are at one place, and where a coordinate is not finite. Exact for the
/// coordinates as given (no rounding decides), if none but 0 is 1e-290 times the largest or less.
/// Precondition: indices in range. O(E log E) for E border edges that are spread out, and O(n log
/// n) to find them.
bool border_crosses(std::span<const Vec2> uv,
                    std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace wrapatlas
