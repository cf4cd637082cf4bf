#include "texture/directions.h"

#include <cmath>

#include "threads/parallel.h"

namespace wrapatlas {
namespace {

constexpr double kNothing = 1e-6;  ///< as long as opposite directions together

double length_of(const std::array<double, 3>& n) {
  return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

void write(const std::array<double, 3>& n, double length, float* value) {
  for (std::size_t i = 0; i < 3; ++i) value[i] = static_cast<float>(0.5 + 0.5 * n[i] / length);
}

}  // namespace

void make_unit(Texture& texture) {
  float* value = texture.values.data();
  for (std::size_t t = 0; t < texture.texel_count(); ++t, value += texture.channels) {
    std::array<double, 3> n{};
    for (std::size_t i = 0; i < 3; ++i) n[i] = 2.0 * double(value[i]) - 1;
    const double length = length_of(n);
    if (length >= kNothing) write(n, length, value);
  }
}

void encode_directions(Texture& texture, int threads) {
  parallel_for(static_cast<std::size_t>(texture.height), thread_count(threads), [&](std::size_t y) {
    float* value = texture.at(0, static_cast<int>(y));
    for (int x = 0; x < texture.width; ++x, value += texture.channels) {
      const std::array<double, 3> n{double(value[0]), double(value[1]), double(value[2])};
      const double length = length_of(n);
      if (length >= kNothing) {
        write(n, length, value);
      } else {
        write({0, 0, 1}, 1, value);
      }
    }
  });
}

}  // namespace wrapatlas
