// Texels by least squares: against the same equations, written out and solved by elimination.
#include "bake/texel_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/dense_solve.h"

namespace wrapatlas {
namespace {

constexpr std::size_t kChannels = TexelFit::kChannels;

struct Case {
  int width, height, across, rows_per_band;
  Wrap wrap;
};

constexpr std::size_t kMaps = 2;

/// What a sample saw.
struct Seen {
  int x, y;  ///< of its texel
  std::size_t number;
  std::array<float, kMaps * kChannels> value;
};

/// Some two thirds of all samples, but never all of a texel's, in the order of texels.
std::vector<Seen> scattered_samples(const Case& c, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1, 1);
  std::vector<Seen> seen;
  for (int y = 0; y < c.height; ++y) {
    for (int x = 0; x < c.width; ++x) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(c.across * c.across); ++i) {
        Seen one{x, y, i, {}};
        for (float& v : one.value) v = value(random);
        if (i != 1 && value(random) < 0.6F) seen.push_back(one);
      }
    }
  }
  return seen;
}

Texture random_map(const Case& c, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1, 1);
  Texture map(c.width, c.height, static_cast<int>(kChannels));
  for (float& v : map.values) v = value(random);
  return map;
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

/// One channel of all texels of a map.
struct Channel {
  std::size_t map, number;
  std::vector<double> start;

  Channel(std::size_t of, std::size_t channel, const Texture& before) : map(of), number(channel) {
    for (std::size_t i = channel; i < before.values.size(); i += kChannels) {
      start.push_back(double(before.values[i]));
    }
  }
};

/// The texels that are best for the samples, each held where it was; those outside the mask fast.
std::vector<double> best_texels(const std::vector<Seen>& samples, const Case& c,
                                const Channel& channel, const TexelMask& mask) {
  const std::size_t n = channel.start.size();
  test::Matrix a(n, std::vector<double>(n));
  std::vector<double> b(n);
  for (const Seen& seen : samples) {
    const std::vector<double> weights = weights_of(seen, c);
    for (std::size_t i = 0; i < n; ++i) {
      if (weights[i] == 0) continue;
      b[i] += weights[i] * double(seen.value[kChannels * channel.map + channel.number]);
      for (std::size_t j = 0; j < n; ++j) a[i][j] += weights[i] * weights[j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double hold = TexelFit::kHold * a[i][i] + TexelFit::kHoldUnread * c.across * c.across;
    a[i][i] += hold;
    b[i] += hold * channel.start[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (mask[i] != 0) continue;
    a[i].assign(n, 0);
    a[i][i] = 1;
    b[i] = channel.start[i];
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      b[j] -= a[j][i] * b[i];
      a[j][i] = 0;
    }
  }
  return test::solve_slowly(std::move(a), std::move(b));
}

/// All in place, but for improve().
TexelFit fit_of(const std::vector<Seen>& samples, const Case& c) {
  TexelFit fit(c.width, c.height, c.wrap, c.across, c.rows_per_band, kMaps);
  for (const Seen& seen : samples) fit.add(seen.x, seen.y, seen.number, seen.value);
  fit.join_bands();
  return fit;
}

bool yes() { return true; }

class TexelFitTest : public testing::TestWithParam<Case> {};

TEST_P(TexelFitTest, ComesNearTheLeastSquares) {
  const Case c = GetParam();
  const std::vector<Seen> samples = scattered_samples(c, 7);
  TexelFit fit = fit_of(samples, c);
  for (const std::size_t number : {1, 0}) {
    const Texture before = random_map(c, 8);
    Texture map = before;
    TexelMask mask(map.texel_count(), 1);
    if (number == 0) {  // some texels stay
      for (std::size_t i = 1; i < mask.size(); i += 3) mask[i] = 0;
    }
    ASSERT_TRUE(fit.improve(number, map, mask, 2, yes));
    for (std::size_t c3 = 0; c3 < kChannels; ++c3) {
      const Channel channel(number, c3, before);
      const std::vector<double> best = best_texels(samples, c, channel, mask);
      double off2 = 0, way2 = 0;
      for (std::size_t i = 0; i < best.size(); ++i) {
        off2 += std::pow(double(map.values[kChannels * i + c3]) - best[i], 2);
        way2 += std::pow(channel.start[i] - best[i], 2);
        if (mask[i] == 0) {
          EXPECT_EQ(map.values[kChannels * i + c3], before.values[kChannels * i + c3]);
        }
      }
      EXPECT_LT(std::sqrt(off2), 0.05 * std::sqrt(way2));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, TexelFitTest,
                         testing::Values(Case{5, 23, 2, 4, Wrap::uv}, Case{6, 13, 3, 1, Wrap::uv},
                                         Case{7, 9, 2, 16, Wrap::u}, Case{9, 12, 4, 5, Wrap::v},
                                         Case{8, 10, 2, 3, Wrap::none}, Case{1, 1, 2, 1, Wrap::uv},
                                         Case{1, 6, 2, 2, Wrap::none}, Case{2, 2, 5, 1, Wrap::uv},
                                         Case{5, 1, 2, 16, Wrap::v}));

/// All samples, of which those left of a line down the middle of the map saw one vector, and the
/// others another.
std::vector<Seen> crease(const Case& c, double line, const std::array<float, 6>& left,
                         const std::array<float, 6>& right) {
  std::vector<Seen> seen;
  for (int y = 0; y < c.height; ++y) {
    for (int x = 0; x < c.width; ++x) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(c.across * c.across); ++i) {
        const double at = x + (double(i % static_cast<std::size_t>(c.across)) + 0.5) / c.across;
        seen.push_back({x, y, i, at < line ? left : right});
      }
    }
  }
  return seen;
}

TEST(TexelFit, FlatFacesStayExactlyAsTheyAre) {
  for (int across = 2; across <= 16; ++across) {
    const Case c{7, 5, across, 3, Wrap::uv};
    const std::array<float, 6> up{0, 0, 1, 0, 0, 1};
    Texture map(7, 5, 3);
    for (std::size_t i = 2; i < map.values.size(); i += 3) map.values[i] = 1;
    ASSERT_TRUE(fit_of(crease(c, 0, up, up), c).improve(1, map, TexelMask(35, 1), 1, yes));
    for (std::size_t i = 0; i < map.values.size(); ++i) {
      if (i % 3 == 2) {
        EXPECT_NEAR(map.values[i], 1, 1e-6);
      } else {
        EXPECT_EQ(map.values[i], 0) << across;
      }
    }
  }
}

TEST(TexelFit, DoesNotOvershootAtACrease) {
  const Case c{12, 4, 4, 2, Wrap::v};
  const std::array<float, 6> left{0.6F, 0, 0.8F, 0.6F, 0, 0.8F},
      right{-0.6F, 0, 0.8F, -0.6F, 0, 0.8F};
  for (const double line : {6.0, 6.25, 6.5}) {
    const std::vector<Seen> samples = crease(c, line, left, right);
    Texture map(12, 4, 3);
    for (const Seen& seen : samples) {
      for (int k = 0; k < 3; ++k) {
        map.at(seen.x, seen.y)[k] += seen.value[static_cast<std::size_t>(k)] / 16;
      }
    }
    const Texture before = map;
    ASSERT_TRUE(fit_of(samples, c).improve(0, map, TexelMask(48, 1), 1, yes));
    EXPECT_NE(map.values, before.values);
    for (int x = 0; x < 12; ++x) {
      EXPECT_LE(std::abs(map.at(x, 1)[0]), 0.6F + 1.0F / 127);
      EXPECT_NEAR(map.at(x, 1)[2], 0.8, 1.0 / 127);
    }
  }
}

TEST(TexelFit, ThreadsDoNotMatterAndItStops) {
  const Case c{40, 70, 2, 7, Wrap::uv};
  const std::vector<Seen> samples = scattered_samples(c, 3);
  Texture one = random_map(c, 4), four = one;
  const TexelMask all(one.texel_count(), 1);
  ASSERT_TRUE(fit_of(samples, c).improve(0, one, all, 1, yes));
  ASSERT_TRUE(fit_of(samples, c).improve(0, four, all, 4, yes));
  EXPECT_EQ(one.values, four.values);
  EXPECT_FALSE(fit_of(samples, c).improve(0, one, all, 1, [] { return false; }));
}

}  // namespace
}  // namespace wrapatlas
