// From a texel to a place of the low mesh, from there to the high one, and back with what is there.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "bake/bleed.h"
#include "bake/high_surface.h"
#include "bake/low_surface.h"
#include "bake/texel_fit.h"
#include "bake/texel_samples.h"
#include "wrapatlas/bake.h"

namespace wrapatlas {

/// What a Baker works with.
struct BakeScene {
  const LowSurface& low;
  const HighSurface& high;
  const TexelSamples& samples;
  Bleed& bleed;
  std::span<const BakedMap> maps;
  const BakeOptions& options;
  BakeResult& result;  ///< its maps are of the right size; distance and box are known
};

class Baker {
 public:
  explicit Baker(const BakeScene& scene);

  /// Fills all maps but for dilation. false: stopped.
  bool run(int threads);

  /// Texels that have a value: those inside charts and those around them.
  [[nodiscard]] const TexelMask& reached() const { return reached_; }

 private:
  static constexpr std::size_t kMapKinds = 5;
  /// All channels of all maps, one after the other. Directions are vectors until the end.
  using Values = std::array<double, kMapKinds * kMostChannels>;

  struct DirectionMap {
    std::size_t map, first_value;
  };

  void bake_band(std::size_t band);
  /// Of all samples together, what baking texel by texel leaves to do: directions. false: stopped.
  bool finish_directions(int threads);
  void bake_texel(const std::vector<TexelSample>& samples, std::size_t band, int row, int x);
  /// false: no ray met the high mesh. `number` differs from sample to sample.
  bool look(const LowPoint& from, std::size_t number, Values& values,
            bool directions_alone = false) const;
  void add_to_fit(const Values& seen, int x, int y, std::size_t sample);
  [[nodiscard]] std::array<double, kMostChannels> value_of(BakedMap map, const LowPoint& from,
                                                           const HighPoint& at,
                                                           std::size_t number) const;
  /// The sum of as many samples.
  void write(std::size_t texel, const Values& sum, int count);
  /// One more of all steps: a band, a band of what lies beyond borders, or a step of the fit.
  void report();

  BakeScene scene_;
  std::vector<DirectionMap> directions_;
  TexelMask reached_;
  int bands_per_job_ = 1;
  std::size_t fit_steps_ = 0;
  std::optional<TexelFit> fit_;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::size_t> done_{0}, used_{0}, nearest_{0};
  std::atomic<bool> met_{false};
};

}  // namespace wrapatlas
