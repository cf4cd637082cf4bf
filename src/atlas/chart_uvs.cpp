#include "atlas/chart_uvs.h"

#include <cmath>

namespace wrapatlas {
namespace {

// A smallest value of -1e-17 would become 1.0 when a period is added: it stays, and becomes 0.
double shift_into_first_period(double smallest) {
  const double shift = -std::floor(smallest);
  return smallest + shift < 1 ? shift : shift - 1;
}

}  // namespace

std::vector<Vec2> atlas_uvs(const Chart& chart, const Packing& packing, std::size_t index) {
  const Similarity transform = packing.transform(index);
  std::vector<Vec2> uvs;
  uvs.reserve(chart.points.size());
  Box2 box;
  for (const Vec2 point : chart.points) {
    const Vec2 texel = transform.apply(point);
    uvs.push_back({texel.x / packing.width, texel.y / packing.height});
    box.add(uvs.back());
  }
  if (box.empty()) return uvs;
  if (wraps_u(packing.wrap)) {
    const double shift = shift_into_first_period(box.min.x);
    for (Vec2& uv : uvs) uv.x = std::max(uv.x + shift, 0.0);
  }
  if (wraps_v(packing.wrap)) {
    const double shift = shift_into_first_period(box.min.y);
    for (Vec2& uv : uvs) uv.y = std::max(uv.y + shift, 0.0);
  }
  return uvs;
}

}  // namespace wrapatlas
