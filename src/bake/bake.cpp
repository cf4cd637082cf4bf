// From a texel to a place of the low mesh, from there to the high one, and back with what is there.
#include "wrapatlas/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "bake/drawable.h"
#include "bake/high_surface.h"
#include "bake/low_surface.h"
#include "bake/texel_samples.h"
#include "mesh/triangulate.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

Error usage(const char* where, const char* what, const char* remedy) {
  return {ErrorKind::usage, where, what, remedy};
}

/// What comes beside the meshes, one entry for each of their parts.
Status check_arrays(const Mesh& low, const BakeSource& high, const BakeOptions& o) {
  const auto fits = [](std::size_t size, std::size_t wanted) {
    return size == 0 || size == wanted;
  };
  if (high.mesh == nullptr) return usage("high mesh", "there is none", "pass one");
  if (!fits(o.corner_normals.size(), low.corner_count()) ||
      !fits(high.corner_normals.size(), high.mesh->corner_count())) {
    return usage("corner normals", "not one for each corner", "pass one for each, or none");
  }
  if (!fits(high.corner_color.size(), high.mesh->corner_count())) {
    return usage("corner colours", "not one for each corner", "pass one for each, or none");
  }
  if (high.group_colors.empty()) return Done{};
  if (high.face_group.size() != high.mesh->face_count() ||
      *std::max_element(high.face_group.begin(), high.face_group.end()) >=
          high.group_colors.size()) {
    return usage("face groups", "not one of the groups for each face", "pass one for each");
  }
  return Done{};
}

Status check_options(const BakeSource& high, std::span<const BakedMap> maps, const BakeOptions& o) {
  if (Status size = check_texture_size(o.width, o.height); !size) return size;
  if (o.samples < 1 || o.samples > 16) return usage("samples", "not from 1 to 16", "2 is usual");
  if (!(o.distance >= 0) || !(o.occlusion_distance >= 0)) {
    return usage("distance", "less than 0", "0 chooses one");
  }
  if (o.occlusion_rays < 1 || o.occlusion_rays > 65536) {
    return usage("occlusion rays", "not from 1 to 65536", "64 is usual");
  }
  if (maps.empty()) return usage("maps", "there are none to bake", "name one");
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (std::find(maps.begin(), maps.begin() + static_cast<std::ptrdiff_t>(i), maps[i]) !=
        maps.begin() + static_cast<std::ptrdiff_t>(i)) {
      return usage("maps", "one is asked for twice", "name each once");
    }
  }
  const bool color = std::find(maps.begin(), maps.end(), BakedMap::color) != maps.end();
  const bool textured = high.color != nullptr || !high.group_colors.empty();
  if (color && textured && high.mesh->texcoords.empty()) {
    return usage("color", "the high mesh has no UVs for its texture", "give both");
  }
  if (color && !textured && high.corner_color.empty()) {
    return usage("color", "the high mesh has no colours", "give a texture, or some per corner");
  }
  return Done{};
}

int channels_of(BakedMap map, const BakeSource& high) {
  if (map == BakedMap::occlusion) return 1;
  return map == BakedMap::color && high.color != nullptr ? high.color->channels : 3;
}

/// Two numbers from 0 to 1 that differ from texel to texel.
std::array<double, 2> scattered(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  x ^= x >> 31U;
  return {double(x >> 32U) / 4294967296.0, double(x & 0xffffffffU) / 4294967296.0};
}

constexpr std::size_t kMapKinds = 5;

class Baker {
 public:
  Baker(const LowSurface& low, const HighSurface& high, const TexelSamples& samples,
        std::span<const BakedMap> maps, const BakeOptions& options, BakeResult& result)
      : low_(low),
        high_(high),
        samples_(samples),
        maps_(maps),
        options_(options),
        result_(result) {}

  /// false: stopped.
  bool run(int threads) {
    reached_.assign(result_.inside.size(), 0);
    parallel_for(samples_.band_count(), threads, [&](std::size_t band) {
      if (stopped_) return;
      bake_band(band);
      report(++done_);
    });
    result_.texels_used = used_;
    result_.texels_nearest = nearest_;
    return !stopped_;
  }

  /// Texels that have a value: those inside and those just beyond a border.
  [[nodiscard]] const TexelMask& reached() const { return reached_; }

 private:
  using Sums = std::array<std::array<double, kMostChannels>, kMapKinds>;  // of a texel's samples

  void bake_band(std::size_t band) {
    std::vector<TexelSample> samples;
    samples_.read_band(band, samples);
    const int first = samples_.rows_per_band() * static_cast<int>(band);
    for (int row = 0; row < samples_.band_rows(band); ++row) {
      for (int x = 0; x < options_.width; ++x) bake_texel(samples, row, x, first + row);
    }
  }

  /// Samples beyond the border of the texel's chart count as well: its centre would move else.
  void bake_texel(const std::vector<TexelSample>& samples, int row, int x, int y) {
    const auto across = static_cast<std::size_t>(options_.samples);
    const auto width = static_cast<std::size_t>(options_.width);
    const std::size_t first = static_cast<std::size_t>(row) * across * width * across +
                              static_cast<std::size_t>(x) * across;
    const auto sample = [&](std::size_t i) -> const TexelSample& {
      return samples[first + i / across * width * across + i % across];
    };
    const TexelSample* nearest = &sample(0);
    for (std::size_t i = 1; i < across * across; ++i) {
      if (sample(i).distance < nearest->distance) nearest = &sample(i);
    }
    if (nearest->triangle == kNone) return;
    const std::uint32_t chart = samples_.chart(nearest->triangle);
    const std::size_t texel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
    Sums sums{};
    int count = 0;
    bool missed = false;
    for (std::size_t i = 0; i < across * across; ++i) {
      const TexelSample& one = sample(i);
      if (one.triangle == kNone || samples_.chart(one.triangle) != chart) continue;
      missed |= !add_sample(one, texel * 256 + i, sums) && one.is_on();
      ++count;
    }
    reached_[texel] = 1;
    if (nearest->is_on()) {
      result_.inside[texel] = 1;
      ++used_;
      if (missed) ++nearest_;
    }
    for (std::size_t m = 0; m < maps_.size(); ++m) write(m, x, y, sums[m], count);
  }

  /// false: no ray met the high mesh.
  bool add_sample(const TexelSample& sample, std::size_t number, Sums& sums) const {
    const LowPoint from = low_.at(sample, samples_.corners(sample.triangle));
    const HighPoint at = high_.find(from.position, from.normal, result_.distance);
    for (std::size_t m = 0; m < maps_.size(); ++m) {
      const std::array<double, kMostChannels> value = value_of(maps_[m], from, at, number);
      for (std::size_t c = 0; c < kMostChannels; ++c) sums[m][c] += value[c];
    }
    return at.by_ray;
  }

  [[nodiscard]] std::array<double, kMostChannels> value_of(BakedMap map, const LowPoint& from,
                                                           const HighPoint& at,
                                                           std::size_t number) const {
    const auto of = [](const Vec3& v) {
      return std::array<double, kMostChannels>{v.x, v.y, v.z, 0};
    };
    switch (map) {
      case BakedMap::object_normals:
        return of(high_.normal(at));
      case BakedMap::tangent_normals:
        return of(in_frame(high_.normal(at), from));
      case BakedMap::positions:
        return of((1 / result_.extent) * (high_.position(at) - result_.low_corner));
      case BakedMap::occlusion:
        return {high_.openness(at, options_.occlusion_rays, options_.occlusion_distance,
                               scattered(number)),
                0, 0, 0};
      case BakedMap::color:
        break;
    }
    const TextureValue color = high_.color(at);
    return {color[0], color[1], color[2], color[3]};
  }

  /// The weights of tangent, bitangent and normal that add up to `n`. The first two need not be
  /// perpendicular to the normal, where it is interpolated.
  static Vec3 in_frame(const Vec3& n, const LowPoint& frame) {
    const Vec3& t = frame.tangent;
    const Vec3& b = frame.bitangent;
    const Vec3& up = frame.normal;
    const double volume = dot(t, cross(b, up));
    if (!(std::abs(volume) > 1e-6)) return {0, 0, 1};
    return (1 / volume) * Vec3{dot(n, cross(b, up)), dot(n, cross(up, t)), dot(n, cross(t, b))};
  }

  void write(std::size_t map, int x, int y, const std::array<double, kMostChannels>& sum,
             int count) const {
    Texture& texture = result_.maps[map];
    float* value = texture.at(x, y);
    const bool directions =
        maps_[map] == BakedMap::object_normals || maps_[map] == BakedMap::tangent_normals;
    const double size = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (int c = 0; c < texture.channels; ++c) {
      const double mean = sum[static_cast<std::size_t>(c)] / count;
      const double direction = size > 0 ? sum[static_cast<std::size_t>(c)] / size : c == 2;
      value[c] = static_cast<float>(directions ? 0.5 + 0.5 * direction : mean);
    }
  }

  void report(std::size_t done) {
    if (!options_.progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    if (!options_.progress(double(done) / double(samples_.band_count()))) stopped_ = true;
  }

  const LowSurface& low_;
  const HighSurface& high_;
  const TexelSamples& samples_;
  std::span<const BakedMap> maps_;
  const BakeOptions& options_;
  BakeResult& result_;
  TexelMask reached_;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::size_t> done_{0}, used_{0}, nearest_{0};
};

/// Twice the largest distance of a point or a middle of a face to the high mesh.
double search_distance(const Mesh& low, const RayScene& scene) {
  double farthest = 0;
  const auto look = [&](const Vec3& place) {
    if (const auto point = scene.nearest_point(place)) {
      farthest = std::max(farthest, point->distance);
    }
  };
  std::vector<bool> seen(low.positions.size());
  for (const std::uint32_t i : low.corner_position) {
    if (!seen[i]) look(low.positions[i]);
    seen[i] = true;
  }
  for (std::uint32_t face = 0; face < low.face_count(); ++face) {
    look(point_at(triangle_of(low, face), {1.0 / 3, 1.0 / 3, 1.0 / 3}));
  }
  return std::max(2 * farthest, 1e-4 * scene.diagonal());
}

/// Where one mesh is a speck beside the other, numbers of 32 bits tell nothing apart.
Status check_places(const BakeResult& result, const RayScene& scene) {
  constexpr double kMost = 1e6, kLeast = 1e-150;
  const double times = result.extent / scene.diagonal();
  if (scene.diagonal() > kLeast && times < kMost) return Done{};
  return Error{ErrorKind::input, "high mesh",
               fmt::format("both meshes together are {:.2g} times as large", times),
               "bring them to one place and one size"};
}

void set_box(const Mesh& low, const Mesh& high, BakeResult& result) {
  Vec3 least{1e300, 1e300, 1e300}, most{-1e300, -1e300, -1e300};
  for (const Mesh* mesh : {&low, &high}) {
    for (const std::uint32_t i : mesh->corner_position) {
      const Vec3& p = mesh->positions[i];
      least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
  }
  const Vec3 size = most - least;
  const double longest = std::max({size.x, size.y, size.z});
  result.low_corner = least;
  result.extent = longest > 0 ? longest : 1;
}

}  // namespace

Result<BakeResult> bake(const Mesh& low, const BakeSource& high, std::span<const BakedMap> maps,
                        const BakeOptions& options) {
  for (const Mesh* mesh : {&low, high.mesh}) {
    if (mesh != nullptr && mesh->face_count() == 0) {
      return Error{ErrorKind::input, mesh == &low ? "low mesh" : "high mesh", "it has no faces",
                   "export it again"};
    }
  }
  if (const Status ok = check_arrays(low, high, options); !ok) return ok.error();
  if (const Status ok = check_options(high, maps, options); !ok) return ok.error();
  const int threads = thread_count(options.threads);
  const Triangulated low_triangles = triangulated(low), high_triangles = triangulated(*high.mesh);
  BakeResult result;
  const TexelSamples samples(low_triangles.mesh, options.width, options.height, options.wrap,
                             options.v_points_down, options.samples);
  if (Status ok = check_samples(samples, low_triangles, "low mesh"); !ok) return ok.error();
  result.faces_without_uv = samples.faces_without_uv();
  if (result.faces_without_uv == low_triangles.mesh.face_count()) {
    return Error{ErrorKind::input, "low mesh", "no face has UVs to bake on", "unwrap it first"};
  }
  const auto high_surface =
      HighSurface::build(high_triangles, high, options.high_hard_angle, threads);
  if (!high_surface) return high_surface.error();
  const LowSurface low_surface(
      low_triangles.mesh, corner_normals(low_triangles, options.corner_normals, options.hard_angle),
      options.v_points_down);
  set_box(low, *high.mesh, result);
  if (Status ok = check_places(result, high_surface->scene()); !ok) return ok.error();
  result.distance = options.distance > 0
                        ? options.distance
                        : search_distance(low_triangles.mesh, high_surface->scene());
  for (const BakedMap map : maps) {
    result.maps.emplace_back(options.width, options.height, channels_of(map, high));
  }
  result.inside.assign(result.maps.front().texel_count(), 0);
  Baker baker(low_surface, *high_surface, samples, maps, options, result);
  if (!baker.run(threads)) return Error{ErrorKind::interrupted, "", "stopped", ""};
  if (result.texels_used == 0) {
    return Error{ErrorKind::input, "low mesh", "no face lies within the atlas",
                 "move its UVs into [0, 1], or let the atlas wrap"};
  }
  for (Texture& map : result.maps) dilate(map, baker.reached(), options.wrap, options.threads);
  return result;
}

}  // namespace wrapatlas
