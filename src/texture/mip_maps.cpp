#include <algorithm>

#include "texture/directions.h"

namespace wrapatlas {
namespace {

/// The texels that one of the next level covers along an axis, and by how much.
struct Cover {
  int first = 0;
  std::array<float, 3> shares{};  ///< half a side covers at most three
  int count = 0;
};

std::vector<Cover> covers(int from, int to) {
  std::vector<Cover> result(static_cast<std::size_t>(to));
  const double step = double(from) / to;
  for (int i = 0; i < to; ++i) {
    Cover& cover = result[static_cast<std::size_t>(i)];
    const double low = i * step, high = (i + 1) * step;
    cover.first = static_cast<int>(low);
    for (int texel = cover.first; texel < from && texel < high && cover.count < 3; ++texel) {
      const double share = (std::min(high, texel + 1.0) - std::max<double>(low, texel)) / step;
      cover.shares[static_cast<std::size_t>(cover.count++)] = static_cast<float>(share);
    }
  }
  return result;
}

/// The mean of the texels covered. No filter reaches farther, so none crosses the border.
Texture half(const Texture& texture) {
  Texture result(std::max(1, texture.width / 2), std::max(1, texture.height / 2), texture.channels);
  const std::vector<Cover> across = covers(texture.width, result.width);
  const std::vector<Cover> down = covers(texture.height, result.height);
  for (int y = 0; y < result.height; ++y) {
    const Cover& rows = down[static_cast<std::size_t>(y)];
    for (int x = 0; x < result.width; ++x) {
      const Cover& columns = across[static_cast<std::size_t>(x)];
      float* out = result.at(x, y);
      for (int j = 0; j < rows.count; ++j) {
        for (int i = 0; i < columns.count; ++i) {
          const float share = rows.shares[static_cast<std::size_t>(j)] *
                              columns.shares[static_cast<std::size_t>(i)];
          const float* in = texture.at(columns.first + i, rows.first + j);
          for (int c = 0; c < texture.channels; ++c) out[c] += share * in[c];
        }
      }
    }
  }
  return result;
}

}  // namespace

MipMaps make_mip_maps(Texture texture, MipFilter filter) {
  MipMaps maps;
  const bool directions = filter == MipFilter::normals && texture.channels >= 3;
  maps.levels.push_back(std::move(texture));
  while (maps.levels.back().texel_count() > 1) {
    maps.levels.push_back(half(maps.levels.back()));
    if (directions) make_unit(maps.levels.back());
  }
  return maps;
}

}  // namespace wrapatlas
