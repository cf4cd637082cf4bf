#include "bake/texel_fit.h"

#include <algorithm>
#include <cmath>

#include "threads/parallel.h"

namespace wrapatlas {
namespace {

// Chebyshev's method, for equations divided by their diagonals. Of those of the samples alone no
// eigenvalue is above 4, as four texels are read at a time, and none below 0; held by a share of
// the diagonal, the bounds are:
constexpr double kLeastEigenvalue = TexelFit::kHold / (1 + TexelFit::kHold);
constexpr double kMostEigenvalue = (4 + TexelFit::kHold) / (1 + TexelFit::kHold);

double off_centre_of(std::size_t sample, std::size_t across) {
  return (double(sample) + 0.5) / double(across) - 0.5;
}

/// Of the texels left and right of a place on an axis: the first, and the share of the second.
struct Between {
  int first;
  double share;
};

Between between(int texel, std::size_t sample, std::size_t across, int texels, bool wraps) {
  const double off_centre = off_centre_of(sample, across);
  const Between place =
      off_centre < 0 ? Between{texel - 1, off_centre + 1} : Between{texel, off_centre};
  const bool is_between = place.first >= 0 && place.first + 1 < texels;
  if (is_between || (wraps && texels > 1)) return place;
  return {std::max(place.first, 0), 0};  // the outermost texel goes on
}

}  // namespace

/// What a step is made of: `keep` of the one before, and `scale` times what is left.
struct TexelFit::Step {
  std::vector<float>& steps;  ///< per texel and channel of the map
  std::size_t first_channel;
  float keep, scale;
};

TexelFit::TexelFit(int width, int height, Wrap wrap, int across, int rows_per_band,
                   std::size_t maps)
    : width_(static_cast<std::size_t>(width)),
      height_(height),
      wraps_u_(wraps_u(wrap)),
      wraps_v_(wraps_v(wrap)),
      across_(static_cast<std::size_t>(across)),
      channels_(kChannels * maps),
      rows_per_band_(rows_per_band),
      bands_((height + rows_per_band - 1) / rows_per_band),
      products_(row_of(bands_, -1) * width_),
      seen_(products_.size() * channels_),
      ranges_(width_ * static_cast<std::size_t>(height) * channels_),
      counts_(width_ * static_cast<std::size_t>(height)) {}

void TexelFit::add(int x, int y, std::size_t sample, std::span<const float> seen) {
  const int band = y / rows_per_band_, first_row = rows_per_band_ * band;
  const Between u = between(x, sample % across_, across_, static_cast<int>(width_), wraps_u_);
  const Between v = between(y, sample / across_, across_, height_, wraps_v_);
  const std::size_t left = u.first < 0 ? width_ - 1 : static_cast<std::size_t>(u.first);
  const std::size_t top = row_of(band, v.first - first_row) * width_;
  const std::array<std::size_t, 4> texel{top + left, top + after(left), top + width_ + left,
                                         top + width_ + after(left)};
  const std::array<double, 4> weight{(1 - u.share) * (1 - v.share), u.share * (1 - v.share),
                                     (1 - u.share) * v.share, u.share * v.share};
  for (std::size_t i = 0; i < 4; ++i) {
    float* sum = seen_.data() + texel[i] * channels_;
    for (std::size_t c = 0; c < channels_; ++c) sum[c] += static_cast<float>(weight[i]) * seen[c];
  }
  const auto product = [&](std::size_t i, std::size_t j, Neighbour neighbour) {
    products_[texel[i]][neighbour] += static_cast<float>(weight[i] * weight[j]);
  };
  for (std::size_t i = 0; i < 4; ++i) product(i, i, self);
  product(0, 1, right);
  product(2, 3, right);
  product(0, 2, below);
  product(1, 3, below);
  product(0, 3, below_right);
  product(1, 2, below_left);
  const std::size_t own = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  ++counts_[own];
  Range* range = ranges_.data() + own * channels_;
  for (std::size_t c = 0; c < channels_; ++c) {
    const float value = std::clamp(127 * seen[c], -127.0F, 127.0F);
    range[c].low = std::min(range[c].low, static_cast<std::int8_t>(std::floor(value)));
    range[c].high = std::max(range[c].high, static_cast<std::int8_t>(std::ceil(value)));
  }
}

void TexelFit::add_row(std::size_t from, std::size_t to) {
  for (std::size_t x = 0; x < width_; ++x) {
    for (std::size_t i = 0; i < kNeighbours; ++i) {
      products_[to * width_ + x][i] += products_[from * width_ + x][i];
    }
  }
  const float* in = seen_.data() + from * width_ * channels_;
  float* out = seen_.data() + to * width_ * channels_;
  for (std::size_t i = 0; i < width_ * channels_; ++i) out[i] += in[i];
}

void TexelFit::join_bands() {
  for (int band = 0; band < bands_; ++band) {
    const int first = rows_per_band_ * band;
    const int rows = std::min(rows_per_band_, height_ - first);
    add_row(row_of(band, -1), row_of(above(first)));
    add_row(row_of(band, rows), row_of(under(first + rows - 1)));
  }
}

void TexelFit::hold_row(const Texture& map, std::size_t first_channel, int y) {
  for (std::size_t x = 0; x < width_; ++x) {
    const std::size_t texel = row_of(y) * width_ + x;
    const float hold = held(products_[texel]);
    float* seen = seen_.data() + texel * channels_ + first_channel;
    const float* value = map.at(static_cast<int>(x), y);
    for (std::size_t c = 0; c < kChannels; ++c) seen[c] += hold * value[c];
  }
}

bool TexelFit::improve(std::size_t map_number, Texture& map, const TexelMask& mask, int threads,
                       const std::function<bool()>& go_on) {
  const auto for_rows = [&](auto job) {
    parallel_for(static_cast<std::size_t>(height_), threads,
                 [&](std::size_t y) { job(static_cast<int>(y)); });
  };
  const std::size_t first_channel = kChannels * map_number;
  for_rows([&](int y) { hold_row(map, first_channel, y); });
  constexpr double kMiddle = (kMostEigenvalue + kLeastEigenvalue) / 2;
  constexpr double kHalf = (kMostEigenvalue - kLeastEigenvalue) / 2;
  std::vector<float> steps(map.values.size());
  double ratio = kHalf / kMiddle, keep = 0, scale = 1 / kMiddle;
  for (int i = 0; i < kSteps; ++i) {
    if (!go_on()) return false;
    const Step step{steps, first_channel, static_cast<float>(keep), static_cast<float>(scale)};
    for_rows([&](int y) { find_steps(map, mask, y, step); });
    for_rows([&](int y) {
      const std::size_t begin = static_cast<std::size_t>(y) * width_ * kChannels;
      for (std::size_t k = begin; k < begin + width_ * kChannels; ++k) map.values[k] += steps[k];
    });
    const double next = 1 / (2 * kMiddle / kHalf - ratio);
    keep = next * ratio;
    scale = 2 * next / kHalf;
    ratio = next;
  }
  for_rows([&](int y) { cut_row(map, first_channel, mask, y); });
  return true;
}

void TexelFit::find_steps(const Texture& map, const TexelMask& mask, int y,
                          const Step& step) const {
  const float *up = map.at(0, above(y)), *here = map.at(0, y), *down = map.at(0, under(y));
  const Products *products = products_.data() + row_of(y) * width_,
                 *products_up = products_.data() + row_of(above(y)) * width_;
  const float* seen = seen_.data() + row_of(y) * width_ * channels_ + step.first_channel;
  const std::size_t first = static_cast<std::size_t>(y) * width_;
  for (std::size_t x = 0; x < width_; ++x) {
    if (mask[first + x] == 0) continue;
    const std::size_t w = before(x), e = after(x);
    const Products& own = products[x];
    const float diagonal = own[self] + held(own);
    for (std::size_t c = 0; c < kChannels; ++c) {
      const auto at = [&](const float* row, std::size_t column) {
        return row[column * kChannels + c];
      };
      const float read =
          diagonal * at(here, x) + own[right] * at(here, e) + products[w][right] * at(here, w) +
          own[below] * at(down, x) + own[below_right] * at(down, e) +
          own[below_left] * at(down, w) + products_up[x][below] * at(up, x) +
          products_up[w][below_right] * at(up, w) + products_up[e][below_left] * at(up, e);
      float& by = step.steps[(first + x) * kChannels + c];
      by = step.keep * by + step.scale * (seen[x * channels_ + c] - read) / diagonal;
    }
  }
}

// At borders texels outside must be free to lead on what is inside.
void TexelFit::cut_row(Texture& map, std::size_t first_channel, const TexelMask& mask,
                       int y) const {
  for (std::size_t x = 0; x < width_; ++x) {
    if (mask[static_cast<std::size_t>(y) * width_ + x] == 0) continue;
    std::array<Range, kChannels> around;
    bool is_amid_charts = true;
    for (const int row : {above(y), y, under(y)}) {
      for (const std::size_t column : {before(x), x, after(x)}) {
        const std::size_t texel = static_cast<std::size_t>(row) * width_ + column;
        is_amid_charts = is_amid_charts && counts_[texel] == across_ * across_;
        const Range* ranges = ranges_.data() + texel * channels_ + first_channel;
        for (std::size_t c = 0; c < kChannels; ++c) {
          around[c].low = std::min(around[c].low, ranges[c].low);
          around[c].high = std::max(around[c].high, ranges[c].high);
        }
      }
    }
    if (!is_amid_charts) continue;
    float* value = map.at(static_cast<int>(x), y);
    for (std::size_t c = 0; c < kChannels; ++c) {
      value[c] = std::clamp(value[c], float(around[c].low) / 127, float(around[c].high) / 127);
    }
  }
}

}  // namespace wrapatlas
