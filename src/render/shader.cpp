#include "render/shader.h"

#include <algorithm>
#include <cmath>

#include "mesh/corner_normals.h"
#include "mesh/polygon_plane.h"
#include "texture/placed.h"

namespace wrapatlas {
namespace {

constexpr float kGrey = 0.6F;  ///< linear, of models without a texture

Vec3 direction_of(const TextureValue& value) {
  return {2.0 * double(value[0]) - 1, 2.0 * double(value[1]) - 1, 2.0 * double(value[2]) - 1};
}

}  // namespace

Shader::Shader(const Triangulated& triangles, const RenderOptions& options)
    : mesh_(triangles.mesh), face_(triangles.face_source), options_(options) {
  const bool mapped = options.shading == Shading::tangent_normals;
  if (options.shading == Shading::smooth || mapped) {
    frames_.normal = corner_normals(triangles, options.corner_normals, options.hard_angle);
  }
  if (mapped) {
    frames_ = corner_frames(triangles, std::move(frames_.normal), options.corner_tangents,
                            options.v_points_down);
  }
}

std::array<float, 3> Shader::color(std::uint32_t triangle, const Weights& weights,
                                   double level_of_detail, const Camera& camera) const {
  Vec2 place = uv(triangle, weights);
  if (!options_.v_points_down) place.y = 1 - place.y;
  std::array<float, 3> color = albedo(triangle, place, level_of_detail);
  if (options_.shading == Shading::none) return color;
  const double light =
      light_on(normal_at(triangle, weights, place, level_of_detail), triangle, camera);
  for (float& value : color) value *= static_cast<float>(light);
  return color;
}

std::array<float, 3> Shader::albedo(std::uint32_t triangle, Vec2 uv, double level_of_detail) const {
  GroupColor from;
  from.maps = options_.color;
  Wrap wrap = options_.wrap;
  if (!options_.group_colors.empty()) {
    from = options_.group_colors[options_.face_group[face_[triangle]]];
    wrap = wrap_of(from.source);
    uv = place_of(from.source, uv);
    level_of_detail += 0.5 * std::log2(area_scale(from.source));
  }
  if (from.maps == nullptr) {
    return from.factor == kNoFactor ? std::array<float, 3>{kGrey, kGrey, kGrey} : from.factor;
  }
  const TextureValue value =
      as_color(sampled(*from.maps, uv, wrap, level_of_detail), from.maps->levels.front().channels);
  return {value[0] * from.factor[0], value[1] * from.factor[1], value[2] * from.factor[2]};
}

Vec2 Shader::uv(std::uint32_t triangle, const Weights& weights) const {
  Vec2 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t at = mesh_.corner_texcoord[3 * std::size_t{triangle} + i];
    if (at == kNone) return {};
    sum = sum + weights[i] * mesh_.texcoords[at];
  }
  return sum;
}

TextureValue Shader::sampled(const MipMaps& maps, Vec2 uv, Wrap wrap,
                             double level_of_detail) const {
  const Texture& texture = maps.levels.front();
  if (!options_.trilinear) return sample_bilinear(texture, uv, wrap);
  const double size = 0.5 * std::log2(static_cast<double>(texture.texel_count()));
  const double level = options_.level >= 0 ? options_.level : level_of_detail + size;
  return sample_trilinear(maps, uv, level, wrap);
}

Vec3 Shader::face_normal(std::uint32_t triangle) const {
  return unit(polygon_normal(mesh_, triangle));
}

Vec3 Shader::interpolated(const CornerVectors& vectors, std::uint32_t triangle,
                          const Weights& weights) const {
  Vec3 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    sum = sum + weights[i] * vectors[3 * std::size_t{triangle} + i];
  }
  return unit(sum);
}

Vec3 Shader::normal_at(std::uint32_t triangle, const Weights& weights, Vec2 uv,
                       double level_of_detail) const {
  if (options_.shading == Shading::flat) return face_normal(triangle);
  if (options_.shading == Shading::smooth) return interpolated(frames_.normal, triangle, weights);
  const Vec3 map = direction_of(sampled(*options_.normals, uv, options_.wrap, level_of_detail));
  if (options_.shading == Shading::object_normals) return unit(map);
  const Vec3 normal = interpolated(frames_.normal, triangle, weights);
  const Vec3 tangent = interpolated(frames_.tangent, triangle, weights);
  const auto sign = double(frames_.sign[3 * std::size_t{triangle}]);
  return unit(map.x * tangent + sign * map.y * cross(normal, tangent) + map.z * normal);
}

double Shader::light_on(const Vec3& normal, std::uint32_t triangle, const Camera& camera) const {
  constexpr double kEverywhere = 0.12, kKey = 0.7, kViewer = 0.18;
  const Vec3 key = unit(-0.5 * camera.right + 0.6 * camera.up + 0.7 * camera.back);
  const Vec3 n = dot(face_normal(triangle), camera.back) < 0 ? -1.0 * normal : normal;
  return kEverywhere + kKey * std::max(0.0, dot(n, key)) +
         kViewer * std::max(0.0, dot(n, camera.back));
}

}  // namespace wrapatlas
