// Wang, Bovik, Sheikh & Simoncelli, Image quality assessment: from error visibility to structural
// similarity (2004): their constants and window; where it reaches over the border of the picture
// the weights that are left are made to add up to 1.
#include <algorithm>
#include <cmath>
#include <limits>

#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

constexpr int kReach = 5;
constexpr double kSigma = 1.5;

double luma(const float* value, int channels) {
  if (channels < 3) return double(value[0]);
  return 0.2126 * double(value[0]) + 0.7152 * double(value[1]) + 0.0722 * double(value[2]);
}

std::array<double, 2 * kReach + 1> window() {
  std::array<double, 2 * kReach + 1> weights{};
  for (int i = -kReach; i <= kReach; ++i) {
    weights[static_cast<std::size_t>(i + kReach)] = std::exp(-i * i / (2 * kSigma * kSigma));
  }
  return weights;
}

/// Blurs rows and then columns.
std::vector<double> blurred(const std::vector<double>& values, int width, int height) {
  const auto weights = window();
  std::vector<double> across(values.size()), result(values.size());
  const auto blur = [&](const std::vector<double>& from, std::vector<double>& to, int count,
                        std::size_t step, int lines, std::size_t line_step) {
    for (int line = 0; line < lines; ++line) {
      for (int i = 0; i < count; ++i) {
        double sum = 0, weight = 0;
        for (int k = std::max(0, i - kReach); k <= std::min(count - 1, i + kReach); ++k) {
          const double w = weights[static_cast<std::size_t>(k - i + kReach)];
          const std::size_t at =
              static_cast<std::size_t>(line) * line_step + static_cast<std::size_t>(k) * step;
          sum += w * from[at];
          weight += w;
        }
        to[static_cast<std::size_t>(line) * line_step + static_cast<std::size_t>(i) * step] =
            sum / weight;
      }
    }
  };
  const auto row = static_cast<std::size_t>(width);
  blur(values, across, width, 1, height, row);
  blur(across, result, height, row, width, 1);
  return result;
}

double mean_ssim(const Texture& a, const Texture& b, std::span<const std::uint8_t> mask) {
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  const std::size_t count = a.texel_count();
  std::vector<double> x(count), y(count), xx(count), yy(count), xy(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * static_cast<std::size_t>(a.channels);
    x[i] = luma(a.values.data() + at, a.channels);
    y[i] = luma(b.values.data() + at, b.channels);
    xx[i] = x[i] * x[i];
    yy[i] = y[i] * y[i];
    xy[i] = x[i] * y[i];
  }
  for (std::vector<double>* values : {&x, &y, &xx, &yy, &xy}) {
    *values = blurred(*values, a.width, a.height);
  }
  double sum = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!mask.empty() && mask[i] == 0) continue;
    const double vx = xx[i] - x[i] * x[i], vy = yy[i] - y[i] * y[i], cov = xy[i] - x[i] * y[i];
    sum += (2 * x[i] * y[i] + kC1) * (2 * cov + kC2) /
           ((x[i] * x[i] + y[i] * y[i] + kC1) * (vx + vy + kC2));
    ++seen;
  }
  return sum / static_cast<double>(seen);
}

}  // namespace

Likeness compare(const Texture& a, const Texture& b, std::span<const std::uint8_t> mask) {
  Likeness likeness;
  double squares = 0;
  const auto channels = static_cast<std::size_t>(a.channels);
  for (std::size_t i = 0; i < a.texel_count(); ++i) {
    if (!mask.empty() && mask[i] == 0) continue;
    ++likeness.pixels;
    for (std::size_t c = i * channels; c < (i + 1) * channels; ++c) {
      const double off = double(a.values[c]) - double(b.values[c]);
      squares += off * off;
    }
  }
  const double mean = squares / static_cast<double>(likeness.pixels * channels);
  likeness.psnr = mean > 0 ? -10 * std::log10(mean) : std::numeric_limits<double>::infinity();
  likeness.ssim = mean_ssim(a, b, mask);
  return likeness;
}

}  // namespace wrapatlas
