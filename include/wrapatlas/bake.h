// Baking: what a detailed mesh looks like, written into the atlas of a simpler one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/result.h"
#include "wrapatlas/tangents.h"
#include "wrapatlas/texture.h"
#include "wrapatlas/transfer.h"

namespace wrapatlas {

enum class BakedMap {
  object_normals,   ///< n in the meshes' own axes, as (n + 1) / 2
  tangent_normals,  ///< n along tangent, bitangent, normal of tangent_frames, as (n + 1) / 2
  positions,        ///< (p - BakeResult::low_corner) / BakeResult::extent
  occlusion,        ///< share of the sky that is seen: 1 is free, 0 is closed in; one channel
  color,            ///< of the BakeSource, averaged as it is
};

/// Whether a map's values are vectors of length 1.
constexpr bool is_direction(BakedMap map) {
  return map == BakedMap::object_normals || map == BakedMap::tangent_normals;
}

struct BakeOptions {
  int width = 1024, height = 1024;  ///< texels, 1 to 65536
  Wrap wrap = Wrap::uv;             ///< axes on which the atlas repeats; elsewhere what is outside
                                    ///< [0, 1] is not baked
  bool v_points_down = false;       ///< of the low mesh's UVs, as Model has it
  int samples = 2;                  ///< of a texel, squared; 1 to 16
  bool fit = true;  ///< texels of normals, if samples > 1, are those that come nearest to all
                    ///< samples when filtered, for some 55 more bytes a texel and map of normals;
                    ///< else each is the mean of its own, as those of all other maps are
  /// Texels by which charts go on over their borders, along the low mesh's surface unfolded, for
  /// mip levels to see; all beyond is dilated.
  double bleed = kDefaultBleed;
  /// How far from the low mesh the high one is looked for along the normal, in the meshes' units;
  /// 0: twice the largest distance of a corner or a middle of a low face to the high mesh.
  double distance = 0;
  /// Of the low mesh, as a renderer has them: per corner, unit, or zero where there is none; may be
  /// empty. Corners without have smooth ones.
  std::span<const Vec3> corner_normals;
  /// Of the low mesh, per corner, as a renderer has them; may be empty. Corners without have those
  /// of tangent_frames.
  std::span<const CornerTangent> corner_tangents;
  double hard_angle = -1;         ///< radians: where the low mesh's normals end, see smooth_normals
  double high_hard_angle = -1;    ///< the same of the high mesh
  int occlusion_rays = 64;        ///< of each sample; 1 to 65536
  double occlusion_distance = 0;  ///< what is farther away hides nothing; 0: no end
  int threads = 0;                ///< 0: as many as there are; the result does not depend on it
  std::function<bool(double)>
      progress;  ///< the share that is done; false: stop. One call at a time
};

/// What is baked from.
struct BakeSource {
  const Mesh* mesh = nullptr;
  const Texture* color = nullptr;  ///< on the mesh's UVs, repeating
  /// In place of `color`, if there are any: colours per group of faces, and per face its group.
  std::span<const GroupColor> group_colors;
  std::span<const std::uint32_t> face_group;
  /// Per corner of the mesh, linear light: of faces that have no texture of these kinds. Without
  /// these too they are white, times the factor of their group.
  std::span<const std::array<float, 3>> corner_color;
  std::span<const Vec3> corner_normals;  ///< as in BakeOptions
  bool v_points_down = false;
};

struct BakeResult {
  std::vector<Texture> maps;    ///< as asked for; every texel has a value, by dilation if need be
  TexelMask inside;             ///< texels that any sample on a chart fell into
  std::size_t texels_used = 0;  ///< of them
  std::size_t texels_nearest = 0;  ///< of them: no ray met the high mesh, so the nearest point did
  bool met = false;                ///< did any ray meet the high mesh?
  std::size_t faces_without_uv = 0;  ///< of the low mesh: none, or of no area
  std::size_t faces_outside = 0;  ///< triangles of it: more than a texel outside [0, 1], on an axis
                                  ///< that does not repeat
  double distance = 0;            ///< BakeOptions::distance in force
  Vec3 low_corner;                ///< of both meshes' box
  double extent = 1;              ///< its longest side
};

/// Each sample of a texel lies on a triangle of the low mesh and looks along its smoothed normal,
/// both ways, for the nearest place of the high mesh that faces the same way; where there is none
/// within the distance, it takes the nearest point. Texels up to one and a half from a chart
/// continue it in the plane of the triangle at its border, those within `bleed` along the
/// surface; all others get the value of the nearest (dilate). Where charts overlap, the first face
/// counts. Both meshes pass validate_mesh. Errors: usage (options, a map
/// without its source), input (no faces, no UVs), output (Embree), interrupted.
Result<BakeResult> bake(const Mesh& low, const BakeSource& high, std::span<const BakedMap> maps,
                        const BakeOptions& options = {});

}  // namespace wrapatlas
