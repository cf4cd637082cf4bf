// From a texel of the new atlas to the triangle on it, and from there to the old texture.
#include "wrapatlas/transfer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>

#include "bake/drawable.h"
#include "bake/texel_samples.h"
#include "bake/triangle_point.h"
#include "mesh/polygon_plane.h"
#include "mesh/triangulate.h"
#include "texture/bicubic.h"
#include "texture/placed.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

/// Where u and v (up) grow on a triangle.
struct Axes {
  Vec3 u, v;
};

Axes axes_of(const Triangle& t, const std::array<Vec2, 3>& uv) {
  const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
  const Vec3 p = t[1] - t[0], q = t[2] - t[0], normal = unit(cross(p, q));
  const double sign = cross(a, b) < 0 ? -1 : 1;
  const Vec3 u = unit(sign * (b.y * p - a.y * q));
  return {u, sign * cross(normal, u)};
}

class Resampler {
 public:
  Resampler(const Triangulated& before, const Triangulated& after,
            std::span<const std::uint32_t> group, const TransferOptions& options,
            const TexelSamples& samples)
      : before_(before.mesh),
        after_(after.mesh),
        faces_(after.face_source),
        group_(group),
        options_(options),
        samples_(samples) {}

  /// false: stopped.
  bool run(const TransferTarget& target, Texture& texture, std::size_t done, std::size_t all) {
    prepare(target);
    TexelMask reached(texture.texel_count(), 0);
    parallel_for(samples_.band_count(), thread_count(options_.threads), [&](std::size_t band) {
      if (stopped_) return;
      fill_band(band, target, texture, reached);
      report(done * samples_.band_count() + ++bands_done_, all * samples_.band_count());
    });
    bands_done_ = 0;
    if (!stopped_) dilate(texture, reached, options_.wrap, options_.threads);
    return !stopped_;
  }

 private:
  /// Mip levels of the sources, in linear light where they are colours.
  void prepare(const TransferTarget& target) {
    maps_.clear();
    for (const TransferSource& source : target.of_group) {
      if (source.texture == nullptr || maps_.count(source.texture) != 0) continue;
      Texture linear = *source.texture;
      if (target.role == TextureRole::color) srgb_to_linear(linear, options_.threads);
      maps_[source.texture] =
          make_mip_maps(std::move(linear),
                        target.role == TextureRole::normals ? MipFilter::normals : MipFilter::mean);
    }
  }

  void fill_band(std::size_t band, const TransferTarget& target, Texture& texture,
                 TexelMask& reached) const {
    std::vector<TexelSample> samples;
    samples_.read_band(band, samples);
    const std::size_t first = band * static_cast<std::size_t>(samples_.rows_per_band()) *
                              static_cast<std::size_t>(options_.width);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const TexelSample& sample = samples[i];
      if (sample.triangle == kNone) continue;
      const TransferSource& source = target.of_group[group_[faces_[sample.triangle]]];
      if (source.texture == nullptr) continue;
      const TextureValue value = value_of(sample, source, target.role);
      float* out = texture.values.data() + (first + i) * static_cast<std::size_t>(target.channels);
      for (int c = 0; c < target.channels; ++c) out[c] = channel(value, c, *source.texture, target);
      reached[first + i] = 1;
    }
  }

  /// Grey sources fill all colours; where a source has no alpha it is opaque.
  static float channel(const TextureValue& value, int c, const Texture& source,
                       const TransferTarget& target) {
    const bool is_alpha = c == 3 || (c == 1 && target.channels == 2);
    if (is_alpha) {
      if (source.channels == 2) return value[1];
      return source.channels == 4 ? value[3] : 1.0F;
    }
    const float found = value[source.channels < 3 ? 0 : static_cast<std::size_t>(c)];
    return target.role == TextureRole::color ? linear_to_srgb(found) : found;
  }

  [[nodiscard]] std::array<Vec2, 3> uvs(const Mesh& mesh, std::uint32_t triangle) const {
    std::array<Vec2, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
      uv[i] = mesh.texcoords[mesh.corner_texcoord[3 * std::size_t{triangle} + i]];
    }
    return uv;
  }

  [[nodiscard]] TextureValue value_of(const TexelSample& sample, const TransferSource& source,
                                      TextureRole role) const {
    const std::array<Vec2, 3> old = uvs(before_, sample.triangle);
    Vec2 uv;
    for (std::size_t i = 0; i < 3; ++i) uv = uv + sample.weights[i] * old[i];
    if (!options_.v_points_down) uv.y = 1 - uv.y;
    const Vec2 place = place_of(source, uv);
    const MipMaps& maps = maps_.at(source.texture);
    const double level = level_of(sample.triangle, old, source);
    const TextureValue value = level > 0.5
                                   ? sample_trilinear(maps, place, level, wrap_of(source))
                                   : sample_bicubic(maps.levels.front(), place, wrap_of(source));
    if (role != TextureRole::normals || keeps_tangents(sample.triangle)) return value;
    return turned(value, sample.triangle, old, source);
  }

  /// By the areas of the triangle on both textures.
  [[nodiscard]] double level_of(std::uint32_t triangle, const std::array<Vec2, 3>& old,
                                const TransferSource& source) const {
    const std::array<Vec2, 3> now = samples_.corners(triangle);
    const double from = std::abs(signed_area2(old[0], old[1], old[2])) * area_scale(source) *
                        static_cast<double>(source.texture->texel_count());
    const double to = std::abs(signed_area2(now[0], now[1], now[2]));
    return from > to && to > 0 ? 0.5 * std::log2(from / to) : 0;
  }

  [[nodiscard]] bool keeps_tangents(std::uint32_t triangle) const {
    return !options_.keeps_tangents.empty() && options_.keeps_tangents[faces_[triangle]] != 0;
  }

  /// Places on a texture with v up, which is what tangent space has.
  [[nodiscard]] std::array<Vec2, 3> upright(std::array<Vec2, 3> uv,
                                            const TransferSource& source) const {
    const auto& m = source.matrix;
    for (Vec2& p : uv) {
      const double down = options_.v_points_down ? p.y : 1 - p.y;
      p = {m[0] * p.x + m[1] * down, -(m[3] * p.x + m[4] * down)};
    }
    return uv;
  }

  /// The direction along the old axes, told along the new ones.
  [[nodiscard]] TextureValue turned(const TextureValue& value, std::uint32_t triangle,
                                    const std::array<Vec2, 3>& old_uv,
                                    const TransferSource& source) const {
    const Triangle t = triangle_of(after_, triangle);
    const std::array<Vec2, 3> old = upright(old_uv, source);
    const std::array<Vec2, 3> now = upright(uvs(after_, triangle), {});
    const Axes from = axes_of(t, old), to = axes_of(t, now);
    const double x = 2.0 * double(value[0]) - 1, y = 2.0 * double(value[1]) - 1;
    const Vec3 flat = x * from.u + y * from.v;
    const Vec3 n = unit({dot(flat, to.u), dot(flat, to.v), 2.0 * double(value[2]) - 1});
    TextureValue result = value;
    result[0] = static_cast<float>(0.5 + 0.5 * n.x);
    result[1] = static_cast<float>(0.5 + 0.5 * n.y);
    result[2] = static_cast<float>(0.5 + 0.5 * n.z);
    return result;
  }

  void report(std::size_t done, std::size_t all) {
    if (!options_.progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock && !options_.progress(double(done) / double(all))) stopped_ = true;
  }

  const Mesh& before_;
  const Mesh& after_;
  const std::vector<std::uint32_t>& faces_;
  std::span<const std::uint32_t> group_;
  const TransferOptions& options_;
  const TexelSamples& samples_;
  std::map<const Texture*, MipMaps> maps_;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::size_t> bands_done_{0};
};

Status check(const Mesh& before, const Mesh& after, std::span<const std::uint32_t> group,
             std::span<const TransferTarget> targets, const TransferOptions& options) {
  const auto usage = [](const char* where, const char* what, const char* remedy) {
    return Error{ErrorKind::usage, where, what, remedy};
  };
  if (Status size = check_texture_size(options.width, options.height); !size) return size;
  if (before.face_begin != after.face_begin || before.corner_position != after.corner_position) {
    return usage("meshes", "they differ in more than their UVs", "pass the same faces");
  }
  if (before.texcoords.empty() || after.texcoords.empty()) {
    return Error{ErrorKind::input, "mesh", "it has no UVs", "unwrap it first"};
  }
  if (!options.keeps_tangents.empty() && options.keeps_tangents.size() != before.face_count()) {
    return usage("tangents", "not one for each face", "pass one for each, or none");
  }
  if (group.size() != before.face_count()) {
    return usage("groups", "not one for each face", "pass one for each");
  }
  for (const TransferTarget& target : targets) {
    if (target.channels < 1 || target.channels > kMostChannels) {
      return usage("channels", "not from 1 to 4", "choose another count");
    }
    if (!group.empty() && *std::max_element(group.begin(), group.end()) >= target.of_group.size()) {
      return usage("groups", "a face's has no entry", "pass an entry for each group");
    }
  }
  return Done{};
}

/// Only triangles that have UVs in both.
void drop_faces_without_uv(const Triangulated& before, Triangulated& after) {
  for (std::size_t c = 0; c < after.mesh.corner_count(); ++c) {
    if (before.mesh.corner_texcoord[c] == kNone) after.mesh.corner_texcoord[c] = kNone;
  }
}

}  // namespace

Result<std::vector<Texture>> transfer(const Mesh& before, const Mesh& after,
                                      std::span<const std::uint32_t> group,
                                      std::span<const TransferTarget> targets,
                                      const TransferOptions& options) {
  if (const Status ok = check(before, after, group, targets, options); !ok) return ok.error();
  const Triangulated from = triangulated(before);
  Triangulated to = triangulated(after);
  drop_faces_without_uv(from, to);
  const TexelSamples samples(to.mesh, options.width, options.height, options.wrap,
                             options.v_points_down, 1);
  std::vector<Texture> textures;
  Resampler resampler(from, to, group, options, samples);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    textures.emplace_back(options.width, options.height, targets[i].channels);
    if (!resampler.run(targets[i], textures.back(), i, targets.size())) {
      return Error{ErrorKind::interrupted, "", "stopped", ""};
    }
  }
  return textures;
}

}  // namespace wrapatlas
