// The texels that, filtered as graphics cards do it, come nearest to what was seen on the surface:
// least squares over all samples that lie on charts. For directions alone: where a value jumps,
// they overshoot.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "wrapatlas/texture.h"

namespace wrapatlas {

class TexelFit {
 public:
  static constexpr std::size_t kChannels = 3;  ///< of a map

  /// How much a texel is held where it was: this share of how much it is read, so that no texel is
  /// drawn far from its mean for a little less error around it,
  static constexpr double kHold = 1.0 / 4;
  /// and this share of how much it can be read, for those at borders that hardly any sample reads.
  static constexpr double kHoldUnread = 1.0 / 512;

  /// `across`: samples of a texel, along each axis.
  TexelFit(int width, int height, Wrap wrap, int across, int rows_per_band, std::size_t maps);

  /// What a sample of texel (x, row of the band) saw: three values of each map. `number` is its
  /// place in the texel, from left to right, then down. One thread has a band.
  void add(std::size_t band, int row, int x, std::size_t number, std::span<const float> seen);

  /// When all is added, and before improve().
  void join_bands();

  /// Moves the texels of the mask from where they are, to which each is held by a little, towards
  /// the least squares of what was seen for this map. The same for any number of threads. false:
  /// go_on() said so. O(texels).
  bool improve(std::size_t number, Texture& map, const TexelMask& mask, int threads,
               const std::function<bool()>& go_on);

 private:
  /// How often a sample is read from this texel and from a neighbour both: the products of their
  /// weights. The other four are theirs.
  enum Neighbour : std::size_t { self, right, below, below_right, below_left, kNeighbours };
  using Products = std::array<float, kNeighbours>;

  /// A band has a row more above and below: what its samples say of its neighbours' texels.
  [[nodiscard]] std::size_t row_of(std::size_t band, int row) const {
    return static_cast<std::size_t>(rows_per_band_ + 2) * band + static_cast<std::size_t>(row + 1);
  }
  [[nodiscard]] std::size_t row_of(int y) const {
    return row_of(static_cast<std::size_t>(y / rows_per_band_), y % rows_per_band_);
  }
  [[nodiscard]] std::size_t after(std::size_t x) const { return x + 1 == width_ ? 0 : x + 1; }
  [[nodiscard]] float held(const Products& own) const {
    return static_cast<float>(kHold) * own[self] +
           static_cast<float>(kHoldUnread * double(across_ * across_));
  }
  void add_row(std::size_t from, std::size_t to);
  struct Step;
  /// Of one row of a map: the steps by what is left of the equations.
  void find_steps(const Texture& map, const TexelMask& mask, int y, const Step& step) const;

  std::size_t width_;
  int height_;
  bool wraps_u_, wraps_v_;
  std::size_t across_, channels_;
  int rows_per_band_;
  std::size_t bands_;
  std::vector<Products> products_;  ///< per texel of row_of
  std::vector<float> seen_;         ///< the same, of each channel: sums of values times weights
};

}  // namespace wrapatlas
