// Textures of a mesh whose UVs have changed: resampled, so that it looks as before.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/result.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {

/// Texels around charts that mip levels up to the fourth see.
inline constexpr double kDefaultBleed = 32;

enum class TextureRole {
  color,    ///< sRGB: resampled in linear light
  normals,  ///< (n + 1) / 2 in tangent space, green up: turned with the chart, made unit again
  data,     ///< as it is
};

/// What a texture does outside [0, 1], per axis.
enum class Repeat { repeat, mirror, clamp };

/// A texture as one group of faces uses it.
struct TransferSource {
  const Texture* texture = nullptr;
  Repeat across = Repeat::repeat, down = Repeat::repeat;
  /// Place on the texture, v from the top: (m[0] u + m[1] v + m[2], m[3] u + m[4] v + m[5]).
  std::array<double, 6> matrix{1, 0, 0, 0, 1, 0};
};

inline constexpr std::array<float, 3> kNoFactor{1, 1, 1};

/// The colours of one group of faces.
struct GroupColor {
  const MipMaps* maps = nullptr;  ///< linear light; null: there are none
  TransferSource source;          ///< how they are read; its texture does not matter
  std::array<float, 3> factor =
      kNoFactor;  ///< linear light: of their values, or a colour without maps
};

/// A texture to be made. Texels of groups without a source stay 0, but for dilation.
struct TransferTarget {
  TextureRole role = TextureRole::data;
  int channels = 3;
  std::vector<TransferSource> of_group;  ///< texture: null, if the group has none
};

struct TransferOptions {
  int width = 1024, height = 1024;  ///< texels
  Wrap wrap = Wrap::uv;             ///< axes on which the new atlas repeats
  bool v_points_down = false;       ///< of both meshes' UVs, as Model has it
  /// Per face: whether it has tangents of its own that stay what they are, so that values of normal
  /// maps are not turned; empty: no face has. Else tangents are along the places on the textures.
  std::span<const std::uint8_t> keeps_tangents;
  double bleed = kDefaultBleed;          ///< as BakeOptions has it
  int threads = 0;                       ///< 0: as many as there are
  std::function<bool(double)> progress;  ///< the share that is done; false: stop
};

/// `before` and `after` have the same faces and corners, but for their UVs. `group`: per face, an
/// index into each target's of_group. A texel takes the value at its centre by the bicubic filter
/// of Catmull & Rom, cut to the range of the texels around, or where the old texture is finer than
/// the new by trilinear mip levels. Around charts they go on as in bake. Errors: usage (sizes, a
/// face without its group), input (no UVs), interrupted.
Result<std::vector<Texture>> transfer(const Mesh& before, const Mesh& after,
                                      std::span<const std::uint32_t> group,
                                      std::span<const TransferTarget> targets,
                                      const TransferOptions& options);

}  // namespace wrapatlas
