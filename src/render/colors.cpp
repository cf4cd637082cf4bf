// OKLab: Björn Ottosson, "A perceptual color space for image processing", 2020.
#include "render/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

std::array<double, 3> linear_rgb(double lightness, double a, double b) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

std::uint8_t encode(double linear) {
  const float value = linear_to_srgb(static_cast<float>(std::clamp(linear, 0.0, 1.0)));
  return static_cast<std::uint8_t>(std::lround(255 * value));
}

}  // namespace

Rgb from_oklch(double lightness, double chroma, double hue_turns) {
  const double angle = 2 * std::numbers::pi * hue_turns;
  for (;; chroma *= 0.95) {
    const auto rgb = linear_rgb(lightness, chroma * std::cos(angle), chroma * std::sin(angle));
    const auto [low, high] = std::minmax_element(rgb.begin(), rgb.end());
    if ((*low >= 0 && *high <= 1) || chroma < 0.005) {
      return {encode(rgb[0]), encode(rgb[1]), encode(rgb[2])};
    }
  }
}

ChartColors chart_colors(std::size_t number) {
  constexpr std::array<double, 3> kLightness{0.78, 0.66, 0.72};
  constexpr double kGolden = 0.6180339887498949;
  const double lightness = kLightness[number % kLightness.size()];
  const double hue = std::fmod(0.16 + kGolden * static_cast<double>(number), 1.0);
  return {.fill = from_oklch(lightness, 0.125, hue),
          .line = from_oklch(lightness - 0.32, 0.075, hue),
          .text = from_oklch(0.20, 0.04, hue),
          .hatch_light = from_oklch(std::min(0.93, lightness + 0.17), 0.06, hue),
          .hatch_dark = from_oklch(lightness, 0.115, hue)};
}

std::string css(Rgb color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

Rgb mix(Rgb a, Rgb b, double share) {
  Rgb mixed;
  for (std::size_t i = 0; i < 3; ++i) {
    mixed[i] = static_cast<std::uint8_t>(std::lround((1 - share) * a[i] + share * b[i]));
  }
  return mixed;
}

}  // namespace wrapatlas
