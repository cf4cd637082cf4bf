#include <algorithm>

#include "texture/nearest_texels.h"
#include "threads/parallel.h"

namespace wrapatlas {

void dilate(Texture& texture, const TexelMask& inside, Wrap wrap, int threads) {
  const int width = texture.width, height = texture.height;
  const NearestTexels nearest(width, height, inside, wrap);
  constexpr int kBand = 64;  // rows that share memory
  parallel_for(static_cast<std::size_t>((height + kBand - 1) / kBand), thread_count(threads),
               [&](std::size_t band) {
                 std::vector<TexelOffset> row;
                 const int begin = static_cast<int>(band) * kBand;
                 for (int y = begin; y < std::min(height, begin + kBand); ++y) {
                   if (!nearest.find_row(y, row)) return;
                   for (int x = 0; x < width; ++x) {
                     if (inside[std::size_t{1} * y * width + static_cast<std::size_t>(x)] != 0) {
                       continue;
                     }
                     const TexelOffset by = row[static_cast<std::size_t>(x)];
                     const float* from = texture.at((x + by.across + width) % width,
                                                    (y + by.down + height) % height);
                     std::copy_n(from, texture.channels, texture.at(x, y));
                   }
                 }
               });
}

}  // namespace wrapatlas
