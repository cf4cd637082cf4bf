#include "atlas/chart_uvs.h"

#include <cmath>

namespace wrapatlas {
namespace {

// A smallest value of -1e-17 would become 1.0 when a period is added: it stays, and becomes 0.
double shift_into_first_period(double smallest) {
  const double shift = -std::floor(smallest);
  return smallest + shift < 1 ? shift : shift - 1;
}

/// What a float would round up to the next tile goes there, to its very beginning.
double shift_onto_tile(double smallest, int pages) {
  const double shift = -std::floor(smallest);
  return smallest + shift < 1 - 2 * page_rounding(pages) ? shift : -smallest;
}

}  // namespace

std::vector<Vec2> atlas_uvs(const Chart& chart, const Packing& packing, std::size_t index,
                            bool v_points_down) {
  const Similarity transform = packing.transform(index);
  const bool paged = packing.pages > 1, turned = paged && v_points_down;
  std::vector<Vec2> uvs;
  uvs.reserve(chart.points.size());
  Box2 box;
  for (const Vec2 point : chart.points) {
    const Vec2 texel = transform.apply(point);
    const double v = texel.y / packing.height;
    uvs.push_back({texel.x / packing.width, turned ? 1 - v : v});
    box.add(uvs.back());
  }
  if (box.empty()) return uvs;
  const auto move = [&](double Vec2::*axis, double smallest, bool wraps) {
    double shift = 0;
    if (wraps) {
      shift = paged ? shift_onto_tile(smallest, packing.pages) : shift_into_first_period(smallest);
    } else if (!paged || smallest < -kOutside) {
      return;
    }
    for (Vec2& uv : uvs) uv.*axis = std::max(uv.*axis + shift, 0.0);
  };
  move(&Vec2::x, box.min.x, wraps_u(packing.wrap));
  move(&Vec2::y, box.min.y, wraps_v(packing.wrap));
  if (turned) {
    for (Vec2& uv : uvs) uv.y = 1 - uv.y;
  }
  return uvs;
}

Vec2 tile_offset(const Packing& packing, std::size_t index, bool v_points_down) {
  const PageTile tile = page_tile(packing.placements[index].page);
  return {static_cast<double>(tile.column),
          static_cast<double>(v_points_down ? -tile.row : tile.row)};
}

}  // namespace wrapatlas
