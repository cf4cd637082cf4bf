#include "bake/baker.h"

#include <algorithm>
#include <cmath>

#include "mesh/polygon_plane.h"
#include "texture/directions.h"
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

std::array<double, kMostChannels> values_of(const Vec3& v) { return {v.x, v.y, v.z, 0}; }

}  // namespace

Baker::Baker(const BakeScene& scene) : scene_(scene), reached_(scene.result.inside.size(), 0) {
  std::size_t first_value = 0;
  for (std::size_t m = 0; m < scene.maps.size(); ++m) {
    if (is_direction(scene.maps[m])) directions_.push_back({m, first_value});
    first_value += static_cast<std::size_t>(scene.result.maps[m].channels);
  }
  const BakeOptions& o = scene.options;
  if (!o.fit || o.samples == 1 || directions_.empty()) return;
  fit_steps_ = directions_.size() * TexelFit::kSteps;
  constexpr int kLeastRows = 16;  // of a band of the fit, which has two more
  const int rows = scene.samples.rows_per_band();
  bands_per_job_ = (kLeastRows + rows - 1) / rows;
  fit_.emplace(o.width, o.height, o.wrap, o.samples, bands_per_job_ * rows, directions_.size());
}

bool Baker::run(int threads) {
  const std::size_t bands = scene_.samples.band_count();
  const auto per_job = static_cast<std::size_t>(bands_per_job_);
  parallel_for((bands + per_job - 1) / per_job, threads, [&](std::size_t job) {
    for (std::size_t band = job * per_job; band < std::min((job + 1) * per_job, bands); ++band) {
      if (stopped_) return;
      bake_band(band);
      report();
    }
  });
  if (stopped_) return false;
  const auto bake_beyond = [&](std::size_t texel, const BeyondBorder& place) {
    Values values{};
    look(scene_.low.beyond(place), 256 * texel, values);
    write(texel, values, 1);
  };
  scene_.bleed.for_each(reached_, threads, bake_beyond, [&] {
    report();
    return !stopped_;
  });
  scene_.result.texels_used = used_;
  scene_.result.texels_nearest = nearest_;
  scene_.result.met = met_;
  return !stopped_ && finish_directions(threads);
}

bool Baker::finish_directions(int threads) {
  const auto go_on = [&] {
    report();
    return !stopped_;
  };
  if (fit_) fit_->join_bands();
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    Texture& map = scene_.result.maps[directions_[i].map];
    if (fit_ && !fit_->improve(i, map, reached_, threads, go_on)) return false;
    encode_directions(map, threads);
  }
  fit_.reset();
  return true;
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
  Values sum{};
  int count = 0;
  bool missed = false, met = false;
  for (std::size_t i = 0; i < across * across; ++i) {
    const TexelSample& one = sample(i);
    const bool is_own = one.triangle != kNone && scene_.samples.chart(one.triangle) == chart;
    const bool is_fitted = fit_ && one.is_on();
    if (!is_own && !is_fitted) continue;
    Values seen{};
    const LowPoint from = scene_.low.at(one, scene_.samples.corners(one.triangle));
    const bool hit = look(from, texel * 256 + i, seen, !is_own);
    if (is_fitted) add_to_fit(seen, x, static_cast<int>(y), i);
    if (!is_own) continue;
    for (std::size_t c = 0; c < seen.size(); ++c) sum[c] += seen[c];
    missed |= !hit && one.is_on();
    met |= hit;
    ++count;
  }
  if (met && !met_.load(std::memory_order_relaxed)) met_ = true;
  write(texel, sum, count);
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

void Baker::add_to_fit(const Values& seen, int x, int y, std::size_t sample) {
  std::array<float, 2 * TexelFit::kChannels> vectors{};  // there are two kinds of directions
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    for (std::size_t c = 0; c < TexelFit::kChannels; ++c) {
      vectors[TexelFit::kChannels * i + c] =
          static_cast<float>(seen[directions_[i].first_value + c]);
    }
  }
  fit_->add(x, y, sample, vectors);
}

bool Baker::look(const LowPoint& from, std::size_t number, Values& values,
                 bool directions_alone) const {
  const HighPoint at = scene_.high.find(from.position, from.normal, scene_.result.distance);
  std::size_t next = 0;
  for (std::size_t m = 0; m < scene_.maps.size(); ++m) {
    const auto channels = static_cast<std::size_t>(scene_.result.maps[m].channels);
    if (!directions_alone || is_direction(scene_.maps[m])) {
      const std::array<double, kMostChannels> value = value_of(scene_.maps[m], from, at, number);
      std::copy_n(value.begin(), channels, values.begin() + static_cast<std::ptrdiff_t>(next));
    }
    next += channels;
  }
  return at.by_ray;
}

std::array<double, kMostChannels> Baker::value_of(BakedMap map, const LowPoint& from,
                                                  const HighPoint& at, std::size_t number) const {
  const HighSurface& high = scene_.high;
  switch (map) {
    case BakedMap::object_normals:
      return values_of(high.normal(at));
    case BakedMap::tangent_normals:
      return values_of(unit(in_frame(high.normal(at), from)));
    case BakedMap::positions:
      return values_of((1 / scene_.result.extent) * (high.position(at) - scene_.result.low_corner));
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

void Baker::write(std::size_t texel, const Values& sum, int count) {
  reached_[texel] = 1;
  const double* next = sum.data();
  for (Texture& map : scene_.result.maps) {
    float* value = map.values.data() + texel * static_cast<std::size_t>(map.channels);
    for (int c = 0; c < map.channels; ++c) *value++ = static_cast<float>(*next++ / count);
  }
}

void Baker::report() {
  const std::size_t done = ++done_;
  if (!scene_.options.progress) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const auto all = double(scene_.samples.band_count() + scene_.bleed.band_count() + fit_steps_);
  if (!scene_.options.progress(double(done) / all)) stopped_ = true;
}

}  // namespace wrapatlas
