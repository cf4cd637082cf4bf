#include <algorithm>
#include <cmath>

#include "render/colors.h"
#include "render/samples.h"
#include "wrapatlas/view.h"

namespace wrapatlas {
namespace {

constexpr Color kNoValue{128, 128, 128};

/// Lighter from end to end, so that it can be read in grey too.
Color color_of_value(double share) {
  return from_oklch(0.32 + 0.58 * share, 0.1, 0.77 - 0.47 * share);
}

}  // namespace

std::vector<Color> colors_of_charts(std::span<const std::uint32_t> face_chart) {
  std::vector<Color> colors;
  colors.reserve(face_chart.size());
  for (const std::uint32_t chart : face_chart) {
    colors.push_back(chart == kNone ? kNoValue : chart_colors(chart).fill);
  }
  return colors;
}

std::vector<Color> colors_of_values(std::span<const double> values, double low, double high) {
  constexpr std::size_t kSteps = 256;
  std::vector<Color> ramp;
  for (std::size_t i = 0; i < kSteps; ++i) ramp.push_back(color_of_value(double(i) / (kSteps - 1)));
  std::vector<Color> colors;
  colors.reserve(values.size());
  for (const double value : values) {
    const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
    colors.push_back(std::isfinite(value) ? ramp[static_cast<std::size_t>(share * (kSteps - 1))]
                                          : kNoValue);
  }
  return colors;
}

Image image_of_samples(const std::vector<Color>& samples, int width, int height) {
  Image image{width, height, {}};
  image.rgb.reserve(std::size_t{3} * width * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::array<int, 3> sum{};
      for (int j = 0; j < kSamplesAcross; ++j) {
        for (int i = 0; i < kSamplesAcross; ++i) {
          const std::size_t row = static_cast<std::size_t>(y * kSamplesAcross + j);
          const Color& sample = samples[row * width * kSamplesAcross + x * kSamplesAcross + i];
          for (std::size_t k = 0; k < 3; ++k) sum[k] += sample[k];
        }
      }
      constexpr int kCount = kSamplesAcross * kSamplesAcross;
      for (const int value : sum) {
        image.rgb.push_back(static_cast<std::uint8_t>((value + kCount / 2) / kCount));
      }
    }
  }
  return image;
}

}  // namespace wrapatlas
