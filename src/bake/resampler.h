// From a texel of the new atlas to the triangle on it, and from there to the old texture.
#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "bake/bleed.h"
#include "bake/texel_samples.h"
#include "mesh/triangulate.h"
#include "wrapatlas/transfer.h"

namespace wrapatlas {

/// Where u and v (up) grow on a triangle.
struct Axes {
  Vec3 u, v;
};

class Resampler {
 public:
  Resampler(const Triangulated& before, const Triangulated& after,
            std::span<const std::uint32_t> group, const TransferOptions& options,
            const TexelSamples& samples, Bleed& bleed)
      : before_(before.mesh),
        after_(after.mesh),
        faces_(after.face_source),
        group_(group),
        options_(options),
        samples_(samples),
        bleed_(bleed) {}

  /// false: stopped.
  bool run(const TransferTarget& target, Texture& texture, std::size_t done, std::size_t all);

 private:
  /// Mip levels of the sources, in linear light where they are colours.
  void prepare(const TransferTarget& target);

  void fill_band(std::size_t band, const TransferTarget& target, Texture& texture,
                 TexelMask& reached);

  [[nodiscard]] bool has_uvs(std::uint32_t triangle) const;  ///< in both meshes
  /// null: there is none.
  [[nodiscard]] const TransferSource* source_of(std::uint32_t triangle,
                                                const TransferTarget& target) const;

  static void write(std::size_t texel, const TextureValue& value, const TransferSource& source,
                    const TransferTarget& target, Texture& texture);

  /// Grey sources fill all colours; where a source has no alpha it is opaque.
  static float channel(const TextureValue& value, int c, const Texture& source,
                       const TransferTarget& target);

  [[nodiscard]] std::array<Vec2, 3> uvs(const Mesh& mesh, std::uint32_t triangle) const;

  [[nodiscard]] TextureValue value_of(const TexelSample& sample, const TransferSource& source,
                                      TextureRole role) const;

  [[nodiscard]] TextureValue value_beyond(const BeyondBorder& place, const TransferSource& source,
                                          TextureRole role) const;

  [[nodiscard]] TextureValue read(std::uint32_t triangle, const std::array<double, 3>& weights,
                                  const TransferSource& source) const;

  /// By the areas of the triangle on both textures.
  [[nodiscard]] double level_of(std::uint32_t triangle, const std::array<Vec2, 3>& old,
                                const TransferSource& source) const;

  [[nodiscard]] bool keeps_tangents(std::uint32_t triangle) const;

  /// Places on a texture with v up, which is what tangent space has.
  [[nodiscard]] std::array<Vec2, 3> upright(std::array<Vec2, 3> uv,
                                            const TransferSource& source) const;

  [[nodiscard]] Axes old_axes(std::uint32_t triangle, const TransferSource& source) const;

  [[nodiscard]] Axes new_axes(std::uint32_t triangle) const;

  /// The direction along the old axes, told along the new ones.
  static TextureValue turned(const TextureValue& value, const Axes& from, const Axes& to);

  /// One more band of the texture after `done` of `all`.
  void report(std::size_t done, std::size_t all);

  const Mesh& before_;
  const Mesh& after_;
  const std::vector<std::uint32_t>& faces_;
  std::span<const std::uint32_t> group_;
  const TransferOptions& options_;
  const TexelSamples& samples_;
  Bleed& bleed_;
  std::map<const Texture*, MipMaps> maps_;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::size_t> bands_done_{0};
};

}  // namespace wrapatlas
