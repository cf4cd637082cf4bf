#include "bake/low_surface.h"

#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

/// Beyond its border a triangle goes on in its plane; one that is stretched so much that this leads
/// far away ends there.
Vec3 continued(const Triangle& triangle, const std::array<Vec2, 3>& on_texels,
               const TexelSample& sample, const std::array<double, 3>& nearest) {
  const Vec3 there = point_at(triangle, sample.weights), border = point_at(triangle, nearest);
  const double farthest = farthest_along(triangle, on_texels, sample.distance);
  return length(there - border) <= farthest ? there : border;
}

}  // namespace

LowPoint LowSurface::on(std::uint32_t triangle, const std::array<double, 3>& weights) const {
  LowPoint point;
  point.position = point_at(triangle_of(mesh_, triangle), weights);
  Vec3 tangent;
  double sign = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t c = 3 * std::size_t{triangle} + i;
    point.normal = point.normal + weights[i] * frames_.normal[c];
    tangent = tangent + weights[i] * frames_.tangent[c];
    sign += weights[i] * frames_.sign[c];
  }
  // As a renderer has them: interpolated, and not made perpendicular again.
  if (point.normal == Vec3{}) point.normal = polygon_normal(mesh_, triangle);
  point.normal = unit(point.normal);
  point.tangent = unit(tangent);
  point.bitangent = (sign < 0 ? -1.0 : 1.0) * cross(point.normal, point.tangent);
  return point;
}

LowPoint LowSurface::at(const TexelSample& sample, const std::array<Vec2, 3>& on_texels) const {
  if (sample.is_on()) return on(sample.triangle, sample.weights);
  const std::array<double, 3>& w = sample.weights;
  const Vec2 place = w[0] * on_texels[0] + w[1] * on_texels[1] + w[2] * on_texels[2];
  const std::array<double, 3> nearest = nearest_weights(on_texels, place);
  LowPoint point = on(sample.triangle, nearest);
  point.position = continued(triangle_of(mesh_, sample.triangle), on_texels, sample, nearest);
  return point;
}

LowPoint LowSurface::beyond(const BeyondBorder& place) const {
  const LowPoint border = on(place.chart_triangle, place.border_weights);
  LowPoint point = on(place.end.triangle, place.end.weights);
  point.tangent = place.end.carried(border.tangent);
  const double sign = dot(cross(border.normal, border.tangent), border.bitangent);
  point.bitangent = (sign < 0 ? -1.0 : 1.0) * cross(point.normal, point.tangent);
  return point;
}

}  // namespace wrapatlas
