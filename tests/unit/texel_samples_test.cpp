// Which triangle a texel's sample lies on: against a look at every triangle.
#include "bake/texel_samples.h"

#include <gtest/gtest.h>

#include <random>

#include "bake/triangle_point.h"

namespace wrapatlas {
namespace {

/// Loose triangles with UVs in [-reach, 1 + reach].
Mesh loose_triangles(int count, double size, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-reach, 1 + reach), side(-size, size);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec2 at{place(random), place(random)};
    for (int k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::uint32_t>(mesh.texcoords.size());
      mesh.texcoords.push_back(at + Vec2{side(random), side(random)});
      mesh.positions.push_back({mesh.texcoords.back().x, mesh.texcoords.back().y, 0});
      mesh.corner_position.push_back(corner);
      mesh.corner_texcoord.push_back(corner);
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  return mesh;
}

double distance_to(const std::array<Vec2, 3>& corner, Vec2 p) {
  Triangle flat;
  for (std::size_t i = 0; i < 3; ++i) flat[i] = {corner[i].x, corner[i].y, 0};
  const Vec3 at{p.x, p.y, 0};
  return length(point_at(flat, nearest_weights(flat, at)) - at);
}

struct Case {
  Wrap wrap;
  int across;
};

class TexelSamplesTest : public testing::TestWithParam<Case> {};

TEST_P(TexelSamplesTest, AreThoseOfTheNearestTriangle) {
  constexpr int kWidth = 24, kHeight = 37;
  const auto [wrap, across] = GetParam();
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Mesh mesh = loose_triangles(12, 0.2, 0.4, seed);
    const TexelSamples samples(mesh, kWidth, kHeight, wrap, seed % 2 == 0, across);
    std::vector<TexelSample> band;
    for (std::size_t b = 0; b < samples.band_count(); ++b) {
      samples.read_band(b, band);
      ASSERT_EQ(band.size(), std::size_t{1} * samples.band_rows(b) * kWidth * across * across);
      for (std::size_t i = 0; i < band.size(); ++i) {
        const int columns = kWidth * across;
        const double x = (double(i % columns) + 0.5) / across;
        const double y = (double(i / columns) + 0.5) / across + double(b) * samples.rows_per_band();
        double least = 1e9;
        for (std::uint32_t t = 0; t < mesh.face_count(); ++t) {
          for (int sx = -3; sx <= 3; ++sx) {
            for (int sy = -3; sy <= 3; ++sy) {
              if ((sx != 0 && !wraps_u(wrap)) || (sy != 0 && !wraps_v(wrap))) continue;
              least = std::min(
                  least, distance_to(samples.corners(t), {x + sx * kWidth, y + sy * kHeight}));
            }
          }
        }
        if (std::abs(least - TexelSamples::kReach) < 1e-5) continue;  // rounding decides
        if (least > TexelSamples::kReach) {
          EXPECT_EQ(band[i].triangle, kNone);
          continue;
        }
        ASSERT_NE(band[i].triangle, kNone);
        EXPECT_NEAR(band[i].distance, least, 2e-6);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Wraps, TexelSamplesTest,
                         testing::Values(Case{Wrap::uv, 1}, Case{Wrap::uv, 3}, Case{Wrap::u, 2},
                                         Case{Wrap::v, 1}, Case{Wrap::none, 2}));

TEST(TexelSamples, WeightsLeadToTheSample) {
  const Mesh mesh = loose_triangles(20, 0.3, 0, 7);
  const TexelSamples samples(mesh, 40, 40, Wrap::none, false, 2);
  std::vector<TexelSample> band;
  int seen = 0;
  for (std::size_t b = 0; b < samples.band_count(); ++b) {
    samples.read_band(b, band);
    for (std::size_t i = 0; i < band.size(); ++i) {
      if (band[i].triangle == kNone) continue;
      const auto corner = samples.corners(band[i].triangle);
      Vec2 p;
      for (std::size_t k = 0; k < 3; ++k) p = p + band[i].weights[k] * corner[k];
      EXPECT_NEAR(p.x, (double(i % 80) + 0.5) / 2, 1e-9);
      EXPECT_NEAR(p.y, (double(i / 80) + 0.5) / 2 + double(b) * samples.rows_per_band(), 1e-9);
      ++seen;
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(TexelSamples, CountsFacesWithoutArea) {
  Mesh mesh = loose_triangles(3, 0.3, 0, 1);
  mesh.corner_texcoord[0] = kNone;
  mesh.texcoords[4] = mesh.texcoords[3];
  EXPECT_EQ(TexelSamples(mesh, 8, 8, Wrap::uv, false, 1).faces_without_uv(), 2U);
}

}  // namespace
}  // namespace wrapatlas
