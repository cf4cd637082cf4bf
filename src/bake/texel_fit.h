// The texels of directions that, filtered as graphics cards do it, come nearest to what was seen on
// the surface: least squares over all samples that lie on charts, as Kavan, Bargteil & Sloan have
// them for vertices (Least squares vertex baking, 2011); here each texel is held near its mean, and
// inside charts within what is seen around it. By Chebyshev's iteration (Saad, Iterative methods
// for sparse linear systems, 12.3), so that the number of threads does not matter.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "wrapatlas/texture.h"

namespace wrapatlas {

class TexelFit {
 public:
  static constexpr std::size_t kChannels = 3;  ///< of a map
  static constexpr int kSteps = 8;
  /// How much a texel is held at its mean: this share of how much it is read, so that none is drawn
  /// far away for a little less error around it,
  static constexpr double kHold = 1.0 / 4;
  /// and this share of how many samples it has, for those at borders that hardly any reads.
  static constexpr double kHoldUnread = 1.0 / 512;

  /// `across`: samples of a texel, along each axis. Holds 22 bytes a texel, and 18 for each map; of
  /// each band two rows more.
  TexelFit(int width, int height, Wrap wrap, int across, int rows_per_band, std::size_t maps);

  /// What a sample of a texel saw: of each map a vector of length 1. `sample` is its place in the
  /// texel, from left to right, then down. One thread has the rows of a band.
  void add(int x, int y, std::size_t sample, std::span<const float> seen);

  /// When all is added, and before improve().
  void join_bands();

  /// Moves the texels of the mask from their means towards the least squares for this map, once.
  /// Holds 12 bytes a texel more. false: go_on(), called before each step, said so; the texels are
  /// on their way then. O(texels).
  bool improve(std::size_t map_number, Texture& map, const TexelMask& mask, int threads,
               const std::function<bool()>& go_on);

 private:
  /// Sums over samples: the weights by which they are read from this texel, and from a neighbour,
  /// multiplied. The other four neighbours have theirs.
  enum Neighbour : std::size_t { self, right, below, below_right, below_left, kNeighbours };
  using Products = std::array<float, kNeighbours>;
  /// What a texel's own samples are between, by channel; times 127 and rounded outwards.
  struct Range {
    std::int8_t low = 127, high = -128;  ///< none
  };

  /// A band has a row more above and below: what its samples say of its neighbours' texels.
  [[nodiscard]] std::size_t row_of(int band, int row) const {
    return std::size_t{1} * (rows_per_band_ + 2) * band + static_cast<std::size_t>(row + 1);
  }
  [[nodiscard]] std::size_t row_of(int y) const {
    return row_of(y / rows_per_band_, y % rows_per_band_);
  }
  [[nodiscard]] std::size_t before(std::size_t x) const { return x == 0 ? width_ - 1 : x - 1; }
  [[nodiscard]] std::size_t after(std::size_t x) const { return x + 1 == width_ ? 0 : x + 1; }
  [[nodiscard]] int above(int y) const { return y == 0 ? height_ - 1 : y - 1; }
  [[nodiscard]] int under(int y) const { return y + 1 == height_ ? 0 : y + 1; }
  [[nodiscard]] float held(const Products& own) const {
    return static_cast<float>(kHold) * own[self] +
           static_cast<float>(kHoldUnread * double(across_ * across_));
  }
  void add_row(std::size_t from, std::size_t to);
  /// Adds to what was seen in a row that each texel was seen as it is, too.
  void hold_row(const Texture& map, std::size_t first_channel, int y);
  struct Step;
  /// Of one row of a map, by what is left of the equations.
  void find_steps(const Texture& map, const TexelMask& mask, int y, const Step& step) const;
  /// Cuts the texels of a row that lie in the midst of charts to what is seen around them.
  void cut_row(Texture& map, std::size_t first_channel, const TexelMask& mask, int y) const;

  std::size_t width_;
  int height_;
  bool wraps_u_, wraps_v_;
  std::size_t across_, channels_;
  int rows_per_band_;
  int bands_;
  std::vector<Products> products_;     ///< per texel, rows by row_of
  std::vector<float> seen_;            ///< the same, per channel: sums of values times weights
  std::vector<Range> ranges_;          ///< per texel and channel
  std::vector<std::uint16_t> counts_;  ///< per texel: samples added
};

}  // namespace wrapatlas
