// IEC 61966-2-1.
#include <cmath>

#include "threads/parallel.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

template <typename Change>
void change_colors(Texture& texture, int threads, Change&& change) {
  const int colors = texture.channels < 3 ? 1 : 3;
  parallel_for(static_cast<std::size_t>(texture.height), thread_count(threads), [&](std::size_t y) {
    for (int x = 0; x < texture.width; ++x) {
      float* value = texture.at(x, static_cast<int>(y));
      for (int i = 0; i < colors; ++i) value[i] = change(value[i]);
    }
  });
}

}  // namespace

float srgb_to_linear(float value) {
  if (value < 0) return -srgb_to_linear(-value);
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

float linear_to_srgb(float value) {
  if (value < 0) return -linear_to_srgb(-value);
  return value <= 0.0031308F ? value * 12.92F : 1.055F * std::pow(value, 1 / 2.4F) - 0.055F;
}

void srgb_to_linear(Texture& texture, int threads) {
  change_colors(texture, threads, [](float value) { return srgb_to_linear(value); });
}

void linear_to_srgb(Texture& texture, int threads) {
  change_colors(texture, threads, [](float value) { return linear_to_srgb(value); });
}

}  // namespace wrapatlas
