// What pictures of a model show of an atlas: places of it, and what the high mesh has there.
#pragma once

#include <array>
#include <vector>

#include "bake/high_surface.h"
#include "bake/surface_walk.h"
#include "chart_borders.h"
#include "wrapatlas/render.h"

namespace wrapatlas::bench {

/// What one pixel shows.
struct Pixel {
  Vec2 uv;
  std::uint32_t face = kNone;       ///< of the low mesh, and
  std::array<double, 3> weights{};  ///< the place on it
  Vec3 truth;                       ///< the high mesh's normal there
  double to_border = 0;             ///< of its chart, in texels of level 0
  double to_atlas_border = 0;
};

double degrees_between(const Vec3& a, const Vec3& b);

/// Corners of a face of an atlas of so many texels a side.
std::array<Vec2, 3> texels_of(const Mesh& mesh, std::uint32_t face, int side);
Vec2 uv_at(const Mesh& mesh, std::uint32_t face, const std::array<double, 3>& weights);

/// A place of the low mesh, and what the high one shows there.
class Projection {
 public:
  Projection(const Mesh& low, const HighSurface& high, double distance);

  [[nodiscard]] HighPoint find(std::uint32_t face, const std::array<double, 3>& weights) const;
  [[nodiscard]] Vec3 normal(const HighPoint& point) const { return high_.normal(point); }

 private:
  const Mesh& low_;
  const HighSurface& high_;
  double distance_;
  CornerVectors normals_;
};

/// What the texels that are read for a pixel have of a surface.
struct Filtered {
  Vec3 normal;        ///< the mean, unit
  double spread = 0;  ///< of the normals around it, degrees: arc cosine of the mean's length
};

/// What filtering alone leaves of the truth: the mean over the texels that are read for a pixel,
/// each of them where the surface has it, whatever chart that is on.
class Seamless {
 public:
  Seamless(const Mesh& low, const Projection& projection, const SurfaceWalk& walk, int side)
      : low_(low), projection_(projection), walk_(walk), side_(side) {}

  [[nodiscard]] Filtered at(const Pixel& pixel, int level) const;

 private:
  /// `by` in texels.
  [[nodiscard]] Vec3 seen_from(const Pixel& pixel, Vec2 by) const;

  const Mesh& low_;
  const Projection& projection_;
  const SurfaceWalk& walk_;
  int side_;
};

/// What pictures from around the low mesh, triangles, show of it where a ray meets the high one; on
/// an atlas of `side` texels.
std::vector<Pixel> visible_pixels(const Mesh& low, const Projection& projection, int side,
                                  const RenderOptions& view);

}  // namespace wrapatlas::bench
