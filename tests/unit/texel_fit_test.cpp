// Texels by least squares: against the same equations, written out and solved by elimination.
#include "bake/texel_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace wrapatlas {
namespace {

constexpr std::size_t kChannels = TexelFit::kChannels;

struct Case {
  int width, height, across, rows_per_band;
  Wrap wrap;
};

/// What a sample saw.
struct Seen {
  int x, y;  ///< of its texel
  std::size_t number;
  std::array<float, kChannels> value;
};

/// Two thirds of all samples, in the order of texels.
std::vector<Seen> scattered_samples(const Case& c, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  std::vector<Seen> seen;
  for (int y = 0; y < c.height; ++y) {
    for (int x = 0; x < c.width; ++x) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(c.across * c.across); ++i) {
        const std::array<float, kChannels> at{value(random), value(random), value(random)};
        if (value(random) < 0.667F) seen.push_back({x, y, i, at});
      }
    }
  }
  return seen;
}

/// Of a sample: how much of each texel is read there, by the sampler that textures have.
std::vector<double> weights_of(const Seen& seen, const Case& c) {
  const auto at = [&](int texel, std::size_t part, int texels) {
    return (texel + (double(part) + 0.5) / c.across) / texels;
  };
  const auto across = static_cast<std::size_t>(c.across);
  const Vec2 uv{at(seen.x, seen.number % across, c.width),
                at(seen.y, seen.number / across, c.height)};
  std::vector<double> weights;
  for (int i = 0; i < c.width * c.height; ++i) {
    Texture one(c.width, c.height, 1);
    one.values[static_cast<std::size_t>(i)] = 1;
    weights.push_back(double(sample_bilinear(one, uv, c.wrap)[0]));
  }
  return weights;
}

/// Solves in place, by Gauss. `a` is positive definite.
std::vector<double> solve(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const double times = a[j][i] / a[i][i];
      if (times == 0) continue;
      for (std::size_t k = i; k < n; ++k) a[j][k] -= times * a[i][k];
      b[j] -= times * b[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

/// The channel of the texels that are best for the samples, each held at `start`.
std::vector<double> best_texels(const std::vector<Seen>& samples, const Case& c,
                                std::size_t channel, double start) {
  const auto n = static_cast<std::size_t>(c.width * c.height);
  std::vector<std::vector<double>> a(n, std::vector<double>(n));
  std::vector<double> b(n);
  for (const Seen& seen : samples) {
    const std::vector<double> weights = weights_of(seen, c);
    for (std::size_t i = 0; i < n; ++i) {
      if (weights[i] == 0) continue;
      b[i] += weights[i] * double(seen.value[channel]);
      for (std::size_t j = 0; j < n; ++j) a[i][j] += weights[i] * weights[j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double hold = TexelFit::kHold * a[i][i] + TexelFit::kHoldUnread * c.across * c.across;
    a[i][i] += hold;
    b[i] += hold * start;
  }
  return solve(std::move(a), std::move(b));
}

/// All in place, but for improve().
TexelFit fit_of(const std::vector<Seen>& samples, const Case& c) {
  TexelFit fit(c.width, c.height, c.wrap, c.across, c.rows_per_band, 1);
  for (const Seen& seen : samples) {
    fit.add(static_cast<std::size_t>(seen.y / c.rows_per_band), seen.y % c.rows_per_band, seen.x,
            seen.number, seen.value);
  }
  fit.join_bands();
  return fit;
}

Texture grey(const Case& c) {
  Texture map(c.width, c.height, static_cast<int>(kChannels));
  std::fill(map.values.begin(), map.values.end(), 0.5F);
  return map;
}

bool yes() { return true; }

class TexelFitTest : public testing::TestWithParam<Case> {};

TEST_P(TexelFitTest, ComesNearTheLeastSquares) {
  const Case c = GetParam();
  const std::vector<Seen> samples = scattered_samples(c, 7);
  Texture map = grey(c);
  const TexelMask all(map.texel_count(), 1);
  ASSERT_TRUE(fit_of(samples, c).improve(0, map, all, 2, yes));
  for (std::size_t channel = 0; channel < kChannels; ++channel) {
    const std::vector<double> best = best_texels(samples, c, channel, 0.5);
    double off2 = 0, way2 = 0;
    for (std::size_t i = 0; i < best.size(); ++i) {
      off2 += std::pow(double(map.values[kChannels * i + channel]) - best[i], 2);
      way2 += std::pow(0.5 - best[i], 2);
    }
    EXPECT_LT(std::sqrt(off2), 0.05 * std::sqrt(way2));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TexelFitTest,
                         testing::Values(Case{5, 23, 2, 4, Wrap::uv}, Case{6, 13, 3, 1, Wrap::uv},
                                         Case{7, 9, 2, 16, Wrap::u}, Case{9, 12, 4, 5, Wrap::v},
                                         Case{8, 10, 2, 3, Wrap::none}, Case{1, 1, 2, 1, Wrap::uv},
                                         Case{1, 6, 2, 2, Wrap::none}, Case{2, 2, 5, 1, Wrap::uv},
                                         Case{5, 1, 2, 16, Wrap::v}));

TEST(TexelFit, KeepsWhatIsFilteredExactly) {
  const Case c{8, 8, 2, 3, Wrap::uv};
  std::vector<Seen> samples = scattered_samples(c, 1);
  for (Seen& seen : samples) seen.value = {0.25F, 0.5F, 1};
  Texture map = grey(c);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    map.values[i] = samples[0].value[i % kChannels];
  }
  const Texture before = map;
  ASSERT_TRUE(fit_of(samples, c).improve(0, map, TexelMask(64, 1), 1, yes));
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    EXPECT_NEAR(map.values[i], before.values[i], 1e-6);
  }
}

TEST(TexelFit, LeavesTexelsOutsideTheMask) {
  const Case c{8, 8, 2, 3, Wrap::uv};
  const std::vector<Seen> samples = scattered_samples(c, 2);
  TexelMask mask(64, 1);
  for (std::size_t i = 0; i < mask.size(); i += 3) mask[i] = 0;
  Texture map = grey(c);
  ASSERT_TRUE(fit_of(samples, c).improve(0, map, mask, 1, yes));
  for (std::size_t i = 0; i < mask.size(); ++i) {
    EXPECT_EQ(map.values[kChannels * i] == 0.5F, mask[i] == 0) << i;
  }
}

TEST(TexelFit, ThreadsDoNotMatterAndItStops) {
  const Case c{40, 70, 2, 7, Wrap::uv};
  const std::vector<Seen> samples = scattered_samples(c, 3);
  Texture one = grey(c), four = grey(c);
  const TexelMask all(one.texel_count(), 1);
  ASSERT_TRUE(fit_of(samples, c).improve(0, one, all, 1, yes));
  ASSERT_TRUE(fit_of(samples, c).improve(0, four, all, 4, yes));
  EXPECT_EQ(one.values, four.values);
  EXPECT_FALSE(fit_of(samples, c).improve(0, one, all, 1, [] { return false; }));
}

}  // namespace
}  // namespace wrapatlas
