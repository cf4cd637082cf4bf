#include "bake/baker.h"

#include <algorithm>
#include <cmath>

#include "threads/parallel.h"

namespace wrapatlas {
namespace {

/// Two numbers from 0 to 1 that differ from texel to texel.
std::array<double, 2> scattered(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  x ^= x >> 31U;
  return {double(x >> 32U) / 4294967296.0, double(x & 0xffffffffU) / 4294967296.0};
}

/// The weights of tangent, bitangent and normal that add up to `n`. The first two need not be
/// perpendicular to the normal, where it is interpolated.
Vec3 in_frame(const Vec3& n, const LowPoint& frame) {
  const Vec3& t = frame.tangent;
  const Vec3& b = frame.bitangent;
  const Vec3& up = frame.normal;
  const double volume = dot(t, cross(b, up));
  if (!(std::abs(volume) > 1e-6)) return {0, 0, 1};
  return (1 / volume) * Vec3{dot(n, cross(b, up)), dot(n, cross(up, t)), dot(n, cross(t, b))};
}

}  // namespace

Baker::Baker(const BakeScene& scene) : scene_(scene), reached_(scene.result.inside.size(), 0) {}

bool Baker::run(int threads) {
  parallel_for(scene_.samples.band_count(), threads, [&](std::size_t band) {
    if (stopped_) return;
    bake_band(band);
    report(++done_);
  });
  if (stopped_) return false;
  const auto bake_beyond = [&](std::size_t texel, const BeyondBorder& place) {
    Sums sums{};
    add_sample(scene_.low.beyond(place), 256 * texel, sums);
    write(texel, sums, 1);
  };
  scene_.bleed.for_each(reached_, threads, bake_beyond, [&] {
    report(++done_);
    return !stopped_;
  });
  scene_.result.texels_used = used_;
  scene_.result.texels_nearest = nearest_;
  scene_.result.met = met_;
  return !stopped_;
}

void Baker::bake_band(std::size_t band) {
  std::vector<TexelSample> samples;
  scene_.samples.read_band(band, samples);
  for (int row = 0; row < scene_.samples.band_rows(band); ++row) {
    for (int x = 0; x < scene_.options.width; ++x) bake_texel(samples, band, row, x);
  }
}

// Samples beyond the border of the texel's chart count as well: its centre would move else.
void Baker::bake_texel(const std::vector<TexelSample>& samples, std::size_t band, int row, int x) {
  const auto across = static_cast<std::size_t>(scene_.options.samples);
  const auto width = static_cast<std::size_t>(scene_.options.width);
  const std::size_t first = static_cast<std::size_t>(row) * across * width * across +
                            static_cast<std::size_t>(x) * across;
  const auto sample = [&](std::size_t i) -> const TexelSample& {
    return samples[first + i / across * width * across + i % across];
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < across * across; ++i) {
    if (sample(i).distance < sample(nearest).distance) nearest = i;
  }
  const TexelSample& best = sample(nearest);
  if (best.triangle == kNone) return;
  const std::uint32_t chart = scene_.samples.chart(best.triangle);
  const auto y = static_cast<std::size_t>(scene_.samples.rows_per_band()) * band +
                 static_cast<std::size_t>(row);
  const std::size_t texel = y * width + static_cast<std::size_t>(x);
  Sums sums{};
  int count = 0;
  bool missed = false, met = false;
  for (std::size_t i = 0; i < across * across; ++i) {
    const TexelSample& one = sample(i);
    if (one.triangle == kNone || scene_.samples.chart(one.triangle) != chart) continue;
    const LowPoint from = scene_.low.at(one, scene_.samples.corners(one.triangle));
    const bool hit = add_sample(from, texel * 256 + i, sums);
    missed |= !hit && one.is_on();
    met |= hit;
    ++count;
  }
  if (met && !met_.load(std::memory_order_relaxed)) met_ = true;
  write(texel, sums, count);
  if (best.is_on()) {
    scene_.result.inside[texel] = 1;
    ++used_;
    if (missed) ++nearest_;
  } else {
    const auto off_centre = [&](std::size_t i) { return (double(i) + 0.5) / double(across) - 0.5; };
    const Vec2 to_centre{-off_centre(nearest % across), -off_centre(nearest / across)};
    scene_.bleed.note(band, texel, best, to_centre);
  }
}

// false: no ray met the high mesh.
bool Baker::add_sample(const LowPoint& from, std::size_t number, Sums& sums) const {
  const HighPoint at = scene_.high.find(from.position, from.normal, scene_.result.distance);
  for (std::size_t m = 0; m < scene_.maps.size(); ++m) {
    const std::array<double, kMostChannels> value = value_of(scene_.maps[m], from, at, number);
    for (std::size_t c = 0; c < kMostChannels; ++c) sums[m][c] += value[c];
  }
  return at.by_ray;
}

std::array<double, kMostChannels> Baker::value_of(BakedMap map, const LowPoint& from,
                                                  const HighPoint& at, std::size_t number) const {
  const HighSurface& high = scene_.high;
  const auto of = [](const Vec3& v) { return std::array<double, kMostChannels>{v.x, v.y, v.z, 0}; };
  switch (map) {
    case BakedMap::object_normals:
      return of(high.normal(at));
    case BakedMap::tangent_normals:
      return of(in_frame(high.normal(at), from));
    case BakedMap::positions:
      return of((1 / scene_.result.extent) * (high.position(at) - scene_.result.low_corner));
    case BakedMap::occlusion:
      return {high.openness(at, scene_.options.occlusion_rays, scene_.options.occlusion_distance,
                            scattered(number)),
              0, 0, 0};
    case BakedMap::color:
      break;
  }
  const TextureValue color = high.color(at);
  return {color[0], color[1], color[2], color[3]};
}

void Baker::write(std::size_t texel, const Sums& sums, int count) {
  reached_[texel] = 1;
  for (std::size_t m = 0; m < scene_.maps.size(); ++m) {
    const BakedMap map = scene_.maps[m];
    const std::array<double, kMostChannels>& sum = sums[m];
    Texture& texture = scene_.result.maps[m];
    const auto channels = static_cast<std::size_t>(texture.channels);
    float* value = texture.values.data() + texel * channels;
    const bool directions = map == BakedMap::object_normals || map == BakedMap::tangent_normals;
    const double size = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (std::size_t c = 0; c < channels; ++c) {
      const double direction = size > 0 ? sum[c] / size : c == 2;
      value[c] = static_cast<float>(directions ? 0.5 + 0.5 * direction : sum[c] / count);
    }
  }
}

void Baker::report(std::size_t done) {
  if (!scene_.options.progress) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const auto all = double(scene_.samples.band_count() + scene_.bleed.band_count());
  if (!scene_.options.progress(double(done) / all)) stopped_ = true;
}

}  // namespace wrapatlas
