#include "bake/high_surface.h"

#include <cmath>
#include <numbers>

#include "bake/triangle_point.h"
#include "mesh/polygon_plane.h"
#include "texture/placed.h"

namespace wrapatlas {

Result<HighSurface> HighSurface::build(const Triangulated& mesh, const BakeSource& source,
                                       double hard_angle, int threads) {
  auto scene = RayScene::build(mesh.mesh, threads);
  if (!scene) return scene.error();
  return HighSurface(mesh, source, hard_angle, std::move(*scene));
}

Vec3 HighSurface::face_normal(std::uint32_t triangle) const {
  const Triangle t = triangle_of(*mesh_, triangle);
  return cross(t[1] - t[0], t[2] - t[0]);
}

HighPoint HighSurface::find(const Vec3& place, const Vec3& normal, double distance) const {
  std::optional<SurfacePoint> best;
  for (const double way : {1.0, -1.0}) {
    const auto hit =
        scene_.first_hit(place, way * normal, best ? best->distance : distance, normal);
    if (hit) best = hit;
  }
  const bool by_ray = best.has_value();
  if (!best) best = scene_.nearest_point(place, normal);
  if (!best) best = scene_.nearest_point(place);
  if (!best) return {0, {1, 0, 0}, false};  // not to be: every mesh has a nearest point
  return {best->triangle, best->weights, by_ray};
}

Vec3 HighSurface::position(const HighPoint& point) const {
  return point_at(triangle_of(*mesh_, point.triangle), point.weights);
}

Vec3 HighSurface::normal(const HighPoint& point) const {
  Vec3 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    sum = sum + point.weights[i] * normals_[3 * std::size_t{point.triangle} + i];
  }
  return unit(sum == Vec3{} ? face_normal(point.triangle) : sum);
}

TextureValue HighSurface::color(const HighPoint& point) const {
  if (source_->group_colors.empty()) {
    return source_->color != nullptr ? texture_color(point) : corner_color(point);
  }
  const GroupColor& from = source_->group_colors[source_->face_group[(*face_)[point.triangle]]];
  TextureValue value = from.maps != nullptr ? texture_color(point) : corner_color(point);
  for (std::size_t c = 0; c < 3; ++c) value[c] *= from.factor[c];
  return value;
}

TextureValue HighSurface::corner_color(const HighPoint& point) const {
  if (source_->corner_color.empty()) return {1, 1, 1, 1};
  TextureValue sum{0, 0, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t at = (*corner_)[3 * std::size_t{point.triangle} + i];
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += static_cast<float>(point.weights[i]) * source_->corner_color[at][c];
    }
  }
  return sum;
}

TextureValue HighSurface::texture_color(const HighPoint& point) const {
  Vec2 uv;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t at = mesh_->corner_texcoord[3 * std::size_t{point.triangle} + i];
    if (at == kNone) return corner_color(point);
    uv = uv + point.weights[i] * mesh_->texcoords[at];
  }
  if (!source_->v_points_down) uv.y = 1 - uv.y;
  if (source_->group_colors.empty()) return sample_bilinear(*source_->color, uv, Wrap::uv);
  const GroupColor& from = source_->group_colors[source_->face_group[(*face_)[point.triangle]]];
  const Texture& texture = from.maps->levels.front();
  return as_color(sample_bilinear(texture, place_of(from.source, uv), wrap_of(from.source)),
                  texture.channels);
}

double HighSurface::openness(const HighPoint& point, int rays, double farthest,
                             std::array<double, 2> turn) const {
  constexpr double kOff = 1e-4;  // of the diagonal: rays begin this far from the surface
  const Vec3 up = normal(point);
  const Vec3 axis = std::abs(up.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = unit(cross(axis, up)), along = cross(up, across);
  const double off = kOff * scene_.diagonal();
  const Vec3 origin = position(point) + off * up;
  const double end = farthest > 0 ? farthest : 4 * scene_.diagonal();
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    // Roberts' sequence of two dimensions, which fills the square evenly for any count.
    const double a = std::fmod(turn[0] + 0.7548776662466927 * i, 1);
    const double b = std::fmod(turn[1] + 0.5698402909980532 * i, 1);
    const double radius = std::sqrt(a), angle = 2 * std::numbers::pi * b;
    const Vec3 direction = radius * std::cos(angle) * across + radius * std::sin(angle) * along +
                           std::sqrt(1 - a) * up;
    if (!scene_.is_blocked(origin, direction, end)) ++open;
  }
  return double(open) / rays;
}

}  // namespace wrapatlas
