// The texels around charts as far as smaller mip levels look: charts go on there along the surface,
// over the edges at which they were cut.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bake/surface_walk.h"
#include "bake/texel_samples.h"
#include "texture/nearest_texels.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {

/// A place beyond the border of a chart.
struct BeyondBorder {
  std::uint32_t chart_triangle = kNone;    ///< at the border, and
  std::array<double, 3> border_weights{};  ///< the point of it that the way began at
  WalkEnd end;
};

class Bleed {
 public:
  /// `texels` around charts; 0: none. Errors: those of build_surface.
  static Result<Bleed> build(const Mesh& triangles, const TexelSamples& samples, int width,
                             int height, Wrap wrap, double texels);

  /// Forgets what was noted.
  void restart() {
    for (std::vector<Outermost>& band : outermost_) band.clear();
  }
  /// A texel that no chart covers, but one reaches: a sample of it, and the way from there to its
  /// centre. In the order of texels within a band, of which one thread has one.
  void note(std::size_t band, std::size_t texel, const TexelSample& sample, Vec2 to_centre) {
    if (walk_) outermost_[band].push_back({texel, sample, to_centre});
  }

  /// Bands that for_each goes through.
  [[nodiscard]] std::size_t band_count() const { return walk_ ? outermost_.size() : 0; }
  /// Calls visit(texel, place) for the texels that are not `reached`, but lie near enough, and
  /// go_on() after each band; false: no further. Threads share them.
  void for_each(const TexelMask& reached, int threads,
                const std::function<void(std::size_t, const BeyondBorder&)>& visit,
                const std::function<bool()>& go_on) const;

 private:
  struct Outermost {
    std::size_t texel;
    TexelSample sample;
    Vec2 to_centre;
  };
  Bleed(const Mesh& triangles, const TexelSamples& samples, int width, int height, Wrap wrap,
        double texels)
      : mesh_(&triangles),
        samples_(&samples),
        width_(width),
        height_(height),
        wrap_(wrap),
        texels_(texels) {}
  [[nodiscard]] const Outermost* outermost(int x, int y) const;
  void visit_row(int y, const std::vector<TexelOffset>& nearest,
                 const std::function<void(std::size_t, const BeyondBorder&)>& visit) const;
  /// false: there is nothing that can be said of the place.
  bool find(const Outermost& from, Vec2 by, BeyondBorder& place) const;

  const Mesh* mesh_;
  const TexelSamples* samples_;
  int width_, height_;
  Wrap wrap_;
  double texels_;
  std::unique_ptr<const SurfaceWalk> walk_;        ///< null: there is no bleed
  std::vector<std::vector<Outermost>> outermost_;  ///< per band
};

}  // namespace wrapatlas
