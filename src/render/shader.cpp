#include "render/shader.h"

#include <algorithm>
#include <cmath>

#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

constexpr float kGrey = 0.6F;  ///< linear, of models without a texture

Vec3 direction_of(const TextureValue& value) {
  return {2.0 * double(value[0]) - 1, 2.0 * double(value[1]) - 1, 2.0 * double(value[2]) - 1};
}

}  // namespace

Shader::Shader(const Mesh& triangles, const RenderOptions& options)
    : mesh_(triangles), options_(options) {
  const bool mapped = options.shading == Shading::tangent_normals;
  if (options.shading == Shading::smooth || mapped) {
    frames_.normal = smooth_normals(triangles, options.hard_angle);
  }
  if (mapped) frames_ = tangent_frames(triangles, frames_.normal, options.v_points_down);
}

std::array<float, 3> Shader::color(std::uint32_t triangle, const Shares& shares, double spread,
                                   const Camera& camera) const {
  Vec2 place = uv(triangle, shares);
  if (!options_.v_points_down) place.y = 1 - place.y;
  std::array<float, 3> albedo{kGrey, kGrey, kGrey};
  if (options_.color != nullptr) {
    const TextureValue value = sampled(*options_.color, place, spread);
    const bool grey = options_.color->levels.front().channels < 3;
    for (std::size_t i = 0; i < 3; ++i) albedo[i] = value[grey ? 0 : i];
  }
  if (options_.shading == Shading::none) return albedo;
  const double light = light_on(normal_at(triangle, shares, place, spread), triangle, camera);
  for (float& value : albedo) value *= static_cast<float>(light);
  return albedo;
}

Vec2 Shader::uv(std::uint32_t triangle, const Shares& shares) const {
  Vec2 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t at = mesh_.corner_texcoord[3 * std::size_t{triangle} + i];
    if (at == kNone) return {};
    sum = sum + shares[i] * mesh_.texcoords[at];
  }
  return sum;
}

TextureValue Shader::sampled(const MipMaps& maps, Vec2 uv, double spread) const {
  const Texture& texture = maps.levels.front();
  if (!options_.trilinear) return sample_bilinear(texture, uv, options_.wrap);
  const double size = 0.5 * std::log2(static_cast<double>(texture.texel_count()));
  const double level = options_.level >= 0 ? options_.level : spread + size;
  return sample_trilinear(maps, uv, level, options_.wrap);
}

Vec3 Shader::face_normal(std::uint32_t triangle) const {
  return unit(polygon_normal(mesh_, triangle));
}

Vec3 Shader::interpolated(const CornerVectors& vectors, std::uint32_t triangle,
                          const Shares& shares) const {
  Vec3 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    sum = sum + shares[i] * vectors[3 * std::size_t{triangle} + i];
  }
  return unit(sum);
}

Vec3 Shader::normal_at(std::uint32_t triangle, const Shares& shares, Vec2 uv, double spread) const {
  if (options_.shading == Shading::flat) return face_normal(triangle);
  if (options_.shading == Shading::smooth) return interpolated(frames_.normal, triangle, shares);
  const Vec3 map = direction_of(sampled(*options_.normals, uv, spread));
  if (options_.shading == Shading::object_normals) return unit(map);
  const Vec3 normal = interpolated(frames_.normal, triangle, shares);
  const Vec3 tangent = interpolated(frames_.tangent, triangle, shares);
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
