#include "bake/resampler.h"

#include <algorithm>
#include <cmath>

#include "mesh/polygon_plane.h"
#include "texture/bicubic.h"
#include "texture/placed.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

Axes axes_of(const Triangle& t, const std::array<Vec2, 3>& uv) {
  const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
  const Vec3 p = t[1] - t[0], q = t[2] - t[0], normal = unit(cross(p, q));
  const double sign = cross(a, b) < 0 ? -1 : 1;
  const Vec3 u = unit(sign * (b.y * p - a.y * q));
  return {u, sign * cross(normal, u)};
}

}  // namespace

bool Resampler::run(const TransferTarget& target, Texture& texture, std::size_t done,
                    std::size_t all) {
  prepare(target);
  bleed_.restart();
  TexelMask reached(texture.texel_count(), 0);
  const int threads = thread_count(options_.threads);
  parallel_for(samples_.band_count(), threads, [&](std::size_t band) {
    if (stopped_) return;
    fill_band(band, target, texture, reached);
    report(done, all);
  });
  const auto fill_beyond = [&](std::size_t texel, const BeyondBorder& place) {
    const std::uint32_t triangle = place.end.triangle;
    const TransferSource* source = has_uvs(triangle) ? source_of(triangle, target) : nullptr;
    if (source != nullptr) {
      write(texel, value_beyond(place, *source, target.role), *source, target, texture);
      reached[texel] = 1;
    }
  };
  if (!stopped_) {
    bleed_.for_each(reached, threads, fill_beyond, [&] {
      report(done, all);
      return !stopped_;
    });
  }
  bands_done_ = 0;
  if (!stopped_) dilate(texture, reached, options_.wrap, options_.threads);
  return !stopped_;
}

void Resampler::prepare(const TransferTarget& target) {
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

void Resampler::fill_band(std::size_t band, const TransferTarget& target, Texture& texture,
                          TexelMask& reached) {
  std::vector<TexelSample> samples;
  samples_.read_band(band, samples);
  const std::size_t first = band * static_cast<std::size_t>(samples_.rows_per_band()) *
                            static_cast<std::size_t>(options_.width);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TexelSample& sample = samples[i];
    if (sample.triangle == kNone) continue;
    const TransferSource* source = source_of(sample.triangle, target);
    if (source == nullptr) continue;
    write(first + i, value_of(sample, *source, target.role), *source, target, texture);
    reached[first + i] = 1;
    if (!sample.is_on()) bleed_.note(band, first + i, sample, {});
  }
}

const TransferSource* Resampler::source_of(std::uint32_t triangle,
                                           const TransferTarget& target) const {
  const TransferSource& source = target.of_group[group_[faces_[triangle]]];
  return source.texture == nullptr ? nullptr : &source;
}

void Resampler::write(std::size_t texel, const TextureValue& value, const TransferSource& source,
                      const TransferTarget& target, Texture& texture) {
  float* out = texture.values.data() + texel * static_cast<std::size_t>(target.channels);
  for (int c = 0; c < target.channels; ++c) out[c] = channel(value, c, *source.texture, target);
}

float Resampler::channel(const TextureValue& value, int c, const Texture& source,
                         const TransferTarget& target) {
  const bool is_alpha = c == 3 || (c == 1 && target.channels == 2);
  if (is_alpha) {
    if (source.channels == 2) return value[1];
    return source.channels == 4 ? value[3] : 1.0F;
  }
  const float found = value[source.channels < 3 ? 0 : static_cast<std::size_t>(c)];
  return target.role == TextureRole::color ? linear_to_srgb(found) : found;
}

bool Resampler::has_uvs(std::uint32_t triangle) const {
  const std::uint32_t* texcoord = after_.corner_texcoord.data() + 3 * std::size_t{triangle};
  return std::none_of(texcoord, texcoord + 3, [](std::uint32_t i) { return i == kNone; });
}

std::array<Vec2, 3> Resampler::uvs(const Mesh& mesh, std::uint32_t triangle) const {
  std::array<Vec2, 3> uv;
  for (std::size_t i = 0; i < 3; ++i) {
    uv[i] = mesh.texcoords[mesh.corner_texcoord[3 * std::size_t{triangle} + i]];
  }
  return uv;
}

TextureValue Resampler::value_of(const TexelSample& sample, const TransferSource& source,
                                 TextureRole role) const {
  const std::uint32_t triangle = sample.triangle;
  const TextureValue value = read(triangle, sample.weights, source);
  if (role != TextureRole::normals || keeps_tangents(triangle)) return value;
  return turned(value, old_axes(triangle, source), new_axes(triangle));
}

TextureValue Resampler::value_beyond(const BeyondBorder& place, const TransferSource& source,
                                     TextureRole role) const {
  const WalkEnd& end = place.end;
  const TextureValue value = read(end.triangle, end.weights, source);
  if (role != TextureRole::normals || keeps_tangents(end.triangle)) return value;
  const Axes border = new_axes(place.chart_triangle);
  return turned(value, old_axes(end.triangle, source),
                {end.carried(border.u), end.carried(border.v)});
}

TextureValue Resampler::read(std::uint32_t triangle, const std::array<double, 3>& weights,
                             const TransferSource& source) const {
  const std::array<Vec2, 3> old = uvs(before_, triangle);
  Vec2 uv;
  for (std::size_t i = 0; i < 3; ++i) uv = uv + weights[i] * old[i];
  if (!options_.v_points_down) uv.y = 1 - uv.y;
  const Vec2 place = place_of(source, uv);
  const MipMaps& maps = maps_.at(source.texture);
  const double level = level_of(triangle, old, source);
  return level > 0.5 ? sample_trilinear(maps, place, level, wrap_of(source))
                     : sample_bicubic(maps.levels.front(), place, wrap_of(source));
}

double Resampler::level_of(std::uint32_t triangle, const std::array<Vec2, 3>& old,
                           const TransferSource& source) const {
  const std::array<Vec2, 3> now = samples_.corners(triangle);
  const double from = std::abs(signed_area2(old[0], old[1], old[2])) * area_scale(source) *
                      static_cast<double>(source.texture->texel_count());
  const double to = std::abs(signed_area2(now[0], now[1], now[2]));
  return from > to && to > 0 ? 0.5 * std::log2(from / to) : 0;
}

bool Resampler::keeps_tangents(std::uint32_t triangle) const {
  return !options_.keeps_tangents.empty() && options_.keeps_tangents[faces_[triangle]] != 0;
}

std::array<Vec2, 3> Resampler::upright(std::array<Vec2, 3> uv, const TransferSource& source) const {
  const auto& m = source.matrix;
  for (Vec2& p : uv) {
    const double down = options_.v_points_down ? p.y : 1 - p.y;
    p = {m[0] * p.x + m[1] * down, -(m[3] * p.x + m[4] * down)};
  }
  return uv;
}

Axes Resampler::old_axes(std::uint32_t triangle, const TransferSource& source) const {
  return axes_of(triangle_of(after_, triangle), upright(uvs(before_, triangle), source));
}

Axes Resampler::new_axes(std::uint32_t triangle) const {
  return axes_of(triangle_of(after_, triangle), upright(uvs(after_, triangle), {}));
}

TextureValue Resampler::turned(const TextureValue& value, const Axes& from, const Axes& to) {
  const double x = 2.0 * double(value[0]) - 1, y = 2.0 * double(value[1]) - 1;
  const Vec3 flat = x * from.u + y * from.v;
  const Vec3 n = unit({dot(flat, to.u), dot(flat, to.v), 2.0 * double(value[2]) - 1});
  TextureValue result = value;
  result[0] = static_cast<float>(0.5 + 0.5 * n.x);
  result[1] = static_cast<float>(0.5 + 0.5 * n.y);
  result[2] = static_cast<float>(0.5 + 0.5 * n.z);
  return result;
}

// What lies beyond borders is filled later, band by band.
void Resampler::report(std::size_t done, std::size_t all) {
  const auto bands = double(samples_.band_count() + bleed_.band_count());
  const double share = double(++bands_done_) / bands;
  if (!options_.progress) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock && !options_.progress((double(done) + share) / double(all))) stopped_ = true;
}

}  // namespace wrapatlas
