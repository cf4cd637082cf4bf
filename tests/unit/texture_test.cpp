// Sampling, mip levels, dilation and comparison against slow and obvious ways to the same.
#include "wrapatlas/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "io/image_codecs.h"
#include "support/jpeg_bytes.h"

namespace wrapatlas {
namespace {

Texture noise(int width, int height, int channels, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  Texture texture(width, height, channels);
  for (float& v : texture.values) v = value(random);
  return texture;
}

/// A tent over each texel, summed over all of them and their repetitions.
double slow_sample(const Texture& texture, Vec2 uv, int channel, Wrap wrap) {
  double sum = 0, weights = 0;
  const auto tent = [](double place, int texel, int count, bool wraps) {
    double at = place * count - 0.5;
    if (!wraps) at = std::clamp(at, 0.0, count - 1.0);
    double off = at - texel;
    if (wraps) off -= count * std::round(off / count);
    if (wraps && count == 1) return 1.0;
    double weight = std::max(0.0, 1 - std::abs(off));
    if (wraps && count == 2) weight = 1 - std::abs(off);  // it meets itself on both sides
    return weight;
  };
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      const double weight = tent(uv.x, x, texture.width, wraps_u(wrap)) *
                            tent(uv.y, y, texture.height, wraps_v(wrap));
      sum += weight * double(texture.at(x, y)[channel]);
      weights += weight;
    }
  }
  EXPECT_NEAR(weights, 1, 1e-9);
  return sum;
}

TEST(SampleBilinear, IsTheSumOfTents) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-2.5, 3.5);
  for (const auto& [w, h] : {std::pair{7, 5}, {8, 3}, {1, 6}, {16, 16}}) {
    const Texture texture = noise(w, h, 3, 9);
    for (const Wrap wrap : {Wrap::uv, Wrap::u, Wrap::v, Wrap::none}) {
      for (int i = 0; i < 200; ++i) {
        const Vec2 uv{place(random), place(random)};
        const TextureValue value = sample_bilinear(texture, uv, wrap);
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(value[std::size_t(c)], slow_sample(texture, uv, c, wrap), 1e-5);
        }
        EXPECT_EQ(value[3], 0);
      }
    }
  }
}

TEST(SampleBilinear, TexelCentresAreExactFarAway) {
  const Texture texture = noise(8, 4, 1, 2);
  for (const double away : {0.0, -3.0, 1000.0, -1e6}) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 8; ++x) {
        const Vec2 uv{away + (x + 0.5) / 8, (y + 0.5) / 4 - away};
        EXPECT_FLOAT_EQ(sample_bilinear(texture, uv, Wrap::uv)[0], *texture.at(x, y));
      }
    }
  }
  for (const double extreme : {1e300, -1e300}) {  // no value but no harm
    EXPECT_TRUE(std::isfinite(sample_bilinear(texture, {extreme, extreme}, Wrap::uv)[0]));
    EXPECT_TRUE(std::isfinite(sample_bilinear(texture, {extreme, extreme}, Wrap::none)[0]));
  }
}

TEST(MipMaps, HalveDownToOneTexelAndKeepTheMean) {
  for (const auto& [w, h] : {std::pair{16, 16}, {13, 7}, {1, 9}, {5, 1}}) {
    const Texture texture = noise(w, h, 2, 3);
    const MipMaps maps = make_mip_maps(texture, MipFilter::mean);
    const auto mean = [](const Texture& t) {
      double sum = 0;
      for (std::size_t i = 0; i < t.texel_count(); ++i) sum += double(t.values[2 * i]);
      return sum / double(t.texel_count());
    };
    for (std::size_t k = 0; k < maps.levels.size(); ++k) {
      EXPECT_EQ(maps.levels[k].width, std::max(1, w >> k));
      EXPECT_EQ(maps.levels[k].height, std::max(1, h >> k));
      EXPECT_NEAR(mean(maps.levels[k]), mean(texture), 1e-5);
    }
    EXPECT_EQ(maps.levels.back().texel_count(), 1U);
  }
}

TEST(MipMaps, OfNormalsAreUnit) {
  Texture two(2, 2, 3);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      const float value[] = {x == 0 ? 1.0F : 0.5F, 0.5F, x == 0 ? 0.5F : 1.0F};
      std::copy_n(value, 3, two.at(x, y));
    }
  }
  const MipMaps maps = make_mip_maps(two, MipFilter::normals);
  const Texture& level = maps.levels[1];
  EXPECT_NEAR(level.values[0], 0.5 + 0.5 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(level.values[1], 0.5, 1e-6);
  EXPECT_NEAR(level.values[2], 0.5 + 0.5 * std::sqrt(0.5), 1e-6);
}

TEST(SampleTrilinear, GoesFromLevelToLevel) {
  const MipMaps maps = make_mip_maps(noise(16, 8, 1, 4), MipFilter::mean);
  const Vec2 uv{0.3, 0.6};
  const float one = sample_bilinear(maps.levels[1], uv, Wrap::uv)[0];
  const float two = sample_bilinear(maps.levels[2], uv, Wrap::uv)[0];
  EXPECT_FLOAT_EQ(sample_trilinear(maps, uv, 1, Wrap::uv)[0], one);
  EXPECT_NEAR(sample_trilinear(maps, uv, 1.25, Wrap::uv)[0], 0.75F * one + 0.25F * two, 1e-6);
  EXPECT_FLOAT_EQ(sample_trilinear(maps, uv, 99, Wrap::uv)[0], maps.levels.back().values[0]);
  EXPECT_FLOAT_EQ(sample_trilinear(maps, uv, -1, Wrap::uv)[0],
                  sample_bilinear(maps.levels[0], uv, Wrap::uv)[0]);
}

TEST(Dilate, TakesTheNearest) {
  std::mt19937 random(6);
  for (int round = 0; round < 60; ++round) {
    const int w = 1 + int(random() % 20), h = 1 + int(random() % 20);
    const Texture before = noise(w, h, 2, unsigned(round));
    TexelMask inside(before.texel_count(), 0);
    for (std::uint8_t& bit : inside) bit = random() % unsigned(1 + round / 2) == 0;
    for (const Wrap wrap : {Wrap::uv, Wrap::u, Wrap::v, Wrap::none}) {
      Texture after = before;
      dilate(after, inside, wrap);
      for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
          int least = std::numeric_limits<int>::max();
          bool found = false;
          const auto visit = [&](auto&& look) {
            for (int j = 0; j < h; ++j) {
              for (int i = 0; i < w; ++i) {
                if (inside[std::size_t(j) * w + i] == 0) continue;
                int dx = std::abs(x - i), dy = std::abs(y - j);
                if (wraps_u(wrap)) dx = std::min(dx, w - dx);
                if (wraps_v(wrap)) dy = std::min(dy, h - dy);
                look(dx * dx + dy * dy, i, j);
              }
            }
          };
          visit([&](int distance, int, int) { least = std::min(least, distance); });
          visit([&](int distance, int i, int j) {
            found |= distance == least && after.at(x, y)[0] == before.at(i, j)[0] &&
                     after.at(x, y)[1] == before.at(i, j)[1];
          });
          const bool same = after.at(x, y)[0] == before.at(x, y)[0];
          EXPECT_TRUE(found || (least == std::numeric_limits<int>::max() && same));
        }
      }
    }
  }
}

TEST(Srgb, ThereAndBack) {
  EXPECT_FLOAT_EQ(srgb_to_linear(0), 0);
  EXPECT_FLOAT_EQ(srgb_to_linear(1), 1);
  EXPECT_NEAR(srgb_to_linear(0.5F), 0.21404114, 1e-6);
  for (int i = 0; i <= 255; ++i) {
    const float value = float(i) / 255;
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(value)), value, 1e-6);
  }
  Texture colors = noise(3, 3, 4, 5);
  const Texture before = colors;
  srgb_to_linear(colors);
  EXPECT_EQ(colors.values[3], before.values[3]);  // alpha is linear
  EXPECT_EQ(colors.values[2], srgb_to_linear(before.values[2]));
}

TEST(TexturesParallel, RowsDoNotMixUp) {
  Texture texture = noise(40, 300, 3, 12);
  const Texture before = texture;
  srgb_to_linear(texture);
  for (std::size_t i = 0; i < texture.values.size(); ++i) {
    ASSERT_EQ(texture.values[i], srgb_to_linear(before.values[i]));
  }
  TexelMask column(texture.texel_count(), 0);
  for (int y = 0; y < 300; ++y) column[std::size_t(y) * 40 + 7] = 1;
  dilate(texture, column, Wrap::uv);
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 40; ++x) ASSERT_EQ(texture.at(x, y)[1], texture.at(7, y)[1]);
  }
}

/// A window at a time.
double slow_ssim(const Texture& a, const Texture& b, const TexelMask& mask) {
  double sum = 0;
  std::size_t seen = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (mask[std::size_t(y) * std::size_t(a.width) + std::size_t(x)] == 0) continue;
      double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
      for (int j = std::max(0, y - 5); j <= std::min(a.height - 1, y + 5); ++j) {
        for (int i = std::max(0, x - 5); i <= std::min(a.width - 1, x + 5); ++i) {
          const double weight =
              std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * 1.5 * 1.5));
          const auto va = double(*a.at(i, j)), vb = double(*b.at(i, j));
          weights += weight;
          ma += weight * va;
          mb += weight * vb;
          aa += weight * va * va;
          bb += weight * vb * vb;
          ab += weight * va * vb;
        }
      }
      ma /= weights;
      mb /= weights;
      const double va = aa / weights - ma * ma, vb = bb / weights - mb * mb;
      const double both = ab / weights - ma * mb;
      sum += (2 * ma * mb + 1e-4) * (2 * both + 9e-4) /
             ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
      ++seen;
    }
  }
  return sum / double(seen);
}

TEST(Compare, SsimIsTheMeanOverWindows) {
  std::mt19937 random(3);
  for (const auto& [w, h] : {std::pair{30, 20}, {3, 40}, {12, 1}}) {
    const Texture a = noise(w, h, 1, 1), other = noise(w, h, 1, 2);
    Texture b = a;
    for (std::size_t i = 0; i < b.values.size(); ++i) b.values[i] += 0.3F * other.values[i];
    TexelMask mask(a.texel_count(), 1);
    EXPECT_NEAR(compare(a, b).ssim, slow_ssim(a, b, mask), 1e-9);
    for (std::size_t i = 1; i < mask.size(); ++i) mask[i] = random() % 2;
    EXPECT_NEAR(compare(a, b, mask).ssim, slow_ssim(a, b, mask), 1e-9);
  }
}

TEST(Compare, KnownValues) {
  Texture a = noise(40, 30, 3, 8), b = a;
  EXPECT_TRUE(std::isinf(compare(a, b).psnr));
  EXPECT_NEAR(compare(a, b).ssim, 1, 1e-12);
  for (float& value : b.values) value += 0.1F;
  EXPECT_NEAR(compare(a, b).psnr, 20, 1e-4);
  // Two flat pictures: only their means differ.
  for (float& value : a.values) value = 0.2F;
  for (float& value : b.values) value = 0.6F;
  const double expected = (2 * 0.2 * 0.6 + 1e-4) / (0.2 * 0.2 + 0.6 * 0.6 + 1e-4);
  EXPECT_NEAR(compare(a, b).ssim, expected, 1e-6);
  TexelMask mask(a.texel_count(), 0);
  mask[5] = mask[700] = 1;
  b.at(5, 0)[0] = b.at(5, 0)[1] = b.at(5, 0)[2] = 0.2F;
  const Likeness masked = compare(a, b, mask);
  EXPECT_EQ(masked.pixels, 2U);
  EXPECT_NEAR(masked.psnr, -10 * std::log10(0.5 * 0.16), 1e-4);
}

TEST(TextureFiles, PngThereAndBack) {
  for (const int bits : {8, 16}) {
    const float most = bits == 8 ? 255.0F : 65535.0F;
    for (int channels = 1; channels <= 4; ++channels) {
      Texture texture = noise(9, 5, channels, unsigned(channels));
      texture.values[0] = -3;  // cut
      texture.values[1] = 7;
      const auto bytes = encode_texture(texture, bits);
      ASSERT_TRUE(bytes);
      const auto back = decode_texture(*bytes, "x.png");
      ASSERT_TRUE(back) << back.error().message();
      ASSERT_EQ(back->width, 9);
      ASSERT_EQ(back->height, 5);
      ASSERT_EQ(back->channels, channels);
      for (std::size_t i = 0; i < texture.values.size(); ++i) {
        const float value = std::clamp(texture.values[i], 0.0F, 1.0F);
        EXPECT_NEAR(back->values[i], value, 0.5001F / most);
      }
    }
  }
  Texture odd(3, 1, 1);
  odd.values = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                -std::numeric_limits<float>::infinity()};
  EXPECT_EQ(decode_texture(*encode_texture(odd), "x.png")->values, (std::vector<float>{0, 1, 0}));
  EXPECT_FALSE(encode_texture(noise(2, 2, 3, 1), 12));
  EXPECT_FALSE(encode_texture(Texture()));
}

TEST(TextureFiles, Jpeg) {
  const std::string_view bytes(reinterpret_cast<const char*>(test::kJpegBytes),
                               sizeof(test::kJpegBytes));
  const auto texture = decode_texture(bytes, "x.jpg");
  ASSERT_TRUE(texture) << texture.error().message();
  EXPECT_EQ(texture->width, 16);
  EXPECT_EQ(texture->height, 8);
  EXPECT_EQ(texture->channels, 3);
  // Its left half is red, its right half blue.
  EXPECT_GT(texture->at(2, 4)[0], 0.9F);
  EXPECT_LT(texture->at(2, 4)[2], 0.1F);
  EXPECT_LT(texture->at(13, 4)[0], 0.1F);
  EXPECT_GT(texture->at(13, 4)[2], 0.9F);
  for (std::size_t end = 0; end < bytes.size(); end += 7) {
    const auto cut = decode_texture(bytes.substr(0, end), "x.jpg");
    ASSERT_FALSE(cut) << end;
    EXPECT_EQ(cut.error().kind, ErrorKind::input);
    EXPECT_EQ(cut.error().where, "x.jpg");
  }
}

TEST(TextureFiles, BadPngs) {
  const auto whole = encode_texture(noise(20, 20, 3, 1));
  ASSERT_TRUE(whole);
  // Behind the pixels are a checksum and the last chunk: 16 bytes.
  for (std::size_t end = 0; end + 16 < whole->size(); end += 5) {
    EXPECT_FALSE(decode_texture(std::string_view(*whole).substr(0, end), "x.png")) << end;
  }
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {  // a wrong byte: an error, or a picture of the same size
    std::string broken = *whole;
    broken[8 + random() % (broken.size() - 8)] ^= char(1 + random() % 255);
    const auto texture = decode_texture(broken, "x.png");
    EXPECT_TRUE(!texture || texture->values.size() == 1200U);
  }
  EXPECT_FALSE(decode_texture("no picture at all", "x.png"));
  EXPECT_FALSE(load_texture("/nowhere/x.png"));
}

TEST(TextureFiles, KindsOfPng) {
  const auto load = [](const char* name) {
    const auto texture =
        load_texture(std::filesystem::path(WRAPATLAS_SOURCE_DIR) / "fuzz/corpus/texture" / name);
    EXPECT_TRUE(texture) << texture.error().message();
    return texture ? *texture : Texture();
  };
  const Texture bits = load("grey1.png");
  ASSERT_EQ(bits.values.size(), 9U * 2U);
  for (std::size_t i = 0; i < bits.values.size(); ++i)
    EXPECT_EQ(bits.values[i], i % 2 == 0 ? 1 : 0);
  const Texture palette = load("palette.png");  // two colours are transparent in part
  ASSERT_EQ(palette.channels, 4);
  ASSERT_EQ(palette.values.size(), 4U * 4U);
  for (int x = 0; x < 4; ++x) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(palette.at(x, 0)[c], float(3 * x + c) / 255);
    EXPECT_EQ(palette.at(x, 0)[3], x == 0 ? 128.0F / 255 : 1);
  }
  const Texture wide = load("rgba16.png");  // bytes 0 1 2 3 ..., the higher first
  ASSERT_EQ(wide.values.size(), 2U * 2U * 4U);
  EXPECT_EQ(wide.values[0], 1.0F / 65535);
  EXPECT_EQ(wide.values[3], float(256 * 6 + 7) / 65535);
  const Texture grey = load("grey-alpha8.png");
  ASSERT_EQ(grey.channels, 2);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(grey.values[i], float(i + 1) / 255);
  EXPECT_EQ(load("interlaced.png").values, std::vector<float>{64.0F / 255});
}

void set_crc(std::string& png) {  // of the first chunk, the header
  std::uint32_t crc = 0xffffffffU;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<std::uint8_t>(png[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  for (std::size_t i = 0; i < 4; ++i) png[29 + i] = char((~crc >> (24U - 8U * i)) & 0xffU);
}

void expect_refused(const std::string& bytes, const std::string& word) {
  const auto texture = decode_texture(bytes, "x");
  ASSERT_FALSE(texture);
  EXPECT_EQ(texture.error().kind, ErrorKind::input);
  EXPECT_NE(texture.error().what.find(word), std::string::npos) << texture.error().message();
}

TEST(TextureFiles, AFewBytesAreNoLargePicture) {
  // Before any memory is asked for: the first two take a gigabyte and more.
  const auto png = encode_texture(noise(20, 20, 3, 1));
  ASSERT_TRUE(png);
  const auto sized = [&](int width_byte, int height_byte) {
    std::string bytes = *png;  // sides are four bytes each, the highest first
    bytes[18] = char(width_byte);
    bytes[22] = char(height_byte);
    set_crc(bytes);
    return bytes;
  };
  ASSERT_TRUE(decode_texture(sized(0, 0), "x"));
  expect_refused(sized(0x3f, 0x3f), "16148 x 16148 pixels do not fit into");
  std::string jpeg(reinterpret_cast<const char*>(test::kJpegBytes), sizeof(test::kJpegBytes));
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  jpeg[frame + 5] = jpeg[frame + 7] = 0x3f;
  expect_refused(jpeg, "16144 x 16136 pixels do not fit into");
  expect_refused(sized(0x4f, 0x4f), "too many");
  std::string wide = sized(0, 0);
  wide[17] = 1;
  set_crc(wide);
  expect_refused(wide, "65556 x 20 pixels are too many");
}

TEST(TextureFiles, WellPackedPicturesAreNotTakenForCutOnes) {
  for (const int channels : {1, 3, 4}) {
    const Texture plain(900, 700, channels);
    const auto bytes = encode_texture(plain);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(decode_texture(*bytes, "x")->values, plain.values);
  }
}

}  // namespace
}  // namespace wrapatlas
