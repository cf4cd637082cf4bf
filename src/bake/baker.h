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
  /// All channels of all maps, one after the other.
  using Values = std::array<float, kMapKinds * kMostChannels>;
  static constexpr std::size_t kMostDirections = 2 * TexelFit::kChannels;  // two kinds of maps

  struct DirectionMap {
    std::size_t map, first_value;
  };

  void bake_band(std::size_t band);
  /// Of all samples together, what baking texel by texel leaves to do: directions. false: stopped.
  bool finish_directions(int threads);
  void bake_texel(const std::vector<TexelSample>& samples, std::size_t band, int row, int x);
  [[nodiscard]] std::array<float, kMostDirections> directions_of(const Values& values) const;
  /// false: no ray met the high mesh. `number` differs from sample to sample.
  bool look(const LowPoint& from, std::size_t number, Values& values) const;
  [[nodiscard]] std::array<double, kMostChannels> value_of(BakedMap map, const LowPoint& from,
                                                           const HighPoint& at,
                                                           std::size_t number) const;
  /// The sum of as many samples.
  void write(std::size_t texel, const Values& sum, int count);
  /// `done`: of all bands, each of which comes a second time for what lies beyond borders.
  void report(std::size_t done);

  BakeScene scene_;
  std::vector<DirectionMap> directions_;
  TexelMask reached_;
  std::optional<TexelFit> fit_;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::atomic<std::size_t> done_{0}, used_{0}, nearest_{0};
  std::atomic<bool> met_{false};
};

}  // namespace wrapatlas
