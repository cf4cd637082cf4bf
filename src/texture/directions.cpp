#include "texture/directions.h"

#include <cmath>

#include "threads/parallel.h"

namespace wrapatlas {

void make_unit(Texture& texture, int threads) {
  parallel_for(static_cast<std::size_t>(texture.height), thread_count(threads), [&](std::size_t y) {
    float* value = texture.at(0, static_cast<int>(y));
    for (int x = 0; x < texture.width; ++x, value += texture.channels) {
      std::array<double, 3> n{};
      double size2 = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        n[i] = 2.0 * double(value[i]) - 1;
        size2 += n[i] * n[i];
      }
      if (size2 < 1e-12) continue;  // opposite directions: none
      for (std::size_t i = 0; i < 3; ++i) {
        value[i] = static_cast<float>(0.5 + 0.5 * n[i] / std::sqrt(size2));
      }
    }
  });
}

}  // namespace wrapatlas
