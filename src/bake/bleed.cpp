#include "bake/bleed.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "threads/parallel.h"

namespace wrapatlas {

Result<Bleed> Bleed::build(const Mesh& triangles, const TexelSamples& samples, int width,
                           int height, Wrap wrap, double texels) {
  Bleed bleed(triangles, samples, width, height, wrap, texels);
  if (!(texels > TexelSamples::kReach)) return bleed;
  auto walk = SurfaceWalk::build(triangles);
  if (!walk) return walk.error();
  bleed.walk_ = std::make_unique<const SurfaceWalk>(*std::move(walk));
  bleed.outermost_.resize(samples.band_count());
  return bleed;
}

const Bleed::Outermost* Bleed::outermost(int x, int y) const {
  const std::size_t texel = std::size_t{1} * y * width_ + static_cast<std::size_t>(x);
  const auto& band = outermost_[static_cast<std::size_t>(y / samples_->rows_per_band())];
  const auto found =
      std::lower_bound(band.begin(), band.end(), texel,
                       [](const Outermost& one, std::size_t other) { return one.texel < other; });
  return found != band.end() && found->texel == texel ? &*found : nullptr;
}

bool Bleed::find(const Outermost& from, Vec2 by, BeyondBorder& place) const {
  const std::array<Vec2, 3> corner = samples_->corners(from.sample.triangle);
  const auto at = [&](const std::array<double, 3>& weights) {
    return weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
  };
  const Vec2 start = at(from.sample.weights);
  place.chart_triangle = from.sample.triangle;
  place.border_weights = nearest_weights(corner, start);
  const Vec2 way = start + from.to_centre + by - at(place.border_weights);
  const Triangle t = triangle_of(*mesh_, place.chart_triangle);
  const Vec3 in_space = along_surface(t, corner, way);
  if (!(length(in_space) <= farthest_along(t, corner, length(way)))) return false;
  place.end = walk_->go(place.chart_triangle, place.border_weights, in_space);
  return true;
}

void Bleed::visit_row(int y, const std::vector<TexelOffset>& nearest,
                      const std::function<void(std::size_t, const BeyondBorder&)>& visit) const {
  BeyondBorder place;
  for (int x = 0; x < width_; ++x) {
    const TexelOffset by = nearest[static_cast<std::size_t>(x)];
    const double distance = std::hypot(by.across, by.down);
    if (distance == 0 || distance + TexelSamples::kReach > texels_) continue;
    const Outermost* from =
        outermost((x + by.across + width_) % width_, (y + by.down + height_) % height_);
    if (from == nullptr) continue;
    if (!find(*from, {-double(by.across), -double(by.down)}, place)) continue;
    visit(std::size_t{1} * y * width_ + static_cast<std::size_t>(x), place);
  }
}

void Bleed::for_each(const TexelMask& reached, int threads,
                     const std::function<void(std::size_t, const BeyondBorder&)>& visit,
                     const std::function<bool()>& go_on) const {
  if (!walk_) return;
  const NearestTexels nearest(width_, height_, reached, wrap_);
  std::atomic<bool> stopped{false};
  parallel_for(outermost_.size(), threads, [&](std::size_t band) {
    if (stopped) return;
    std::vector<TexelOffset> row;
    const int first = samples_->rows_per_band() * static_cast<int>(band);
    for (int y = first; y < first + samples_->band_rows(band); ++y) {
      if (nearest.find_row(y, row)) visit_row(y, row, visit);
    }
    if (!go_on()) stopped = true;
  });
}

}  // namespace wrapatlas
