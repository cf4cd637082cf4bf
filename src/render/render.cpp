// Deferred: first which triangle each sample shows, then what is there.
#include "wrapatlas/render.h"

#include <algorithm>
#include <cmath>

#include "mesh/polygon_plane.h"
#include "mesh/triangulate.h"
#include "render/colors.h"
#include "render/visible.h"
#include "threads/parallel.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {
namespace {

constexpr float kGrey = 0.6F;  ///< linear, of models without a texture

Vec3 direction_of(const TextureValue& value) {
  return {2.0 * double(value[0]) - 1, 2.0 * double(value[1]) - 1, 2.0 * double(value[2]) - 1};
}

/// What a sample of a triangle looks like.
class Shader {
 public:
  Shader(const Mesh& triangles, const RenderOptions& options)
      : mesh_(triangles), options_(options) {
    const bool mapped = options.shading == Shading::tangent_normals;
    if (options.shading == Shading::smooth || mapped) {
      frames_.normal = smooth_normals(triangles, options.hard_angle);
    }
    if (mapped) frames_ = tangent_frames(triangles, frames_.normal, options.v_points_down);
  }

  /// Linear light. `shares` are of the triangle's corners; `level` of detail.
  [[nodiscard]] std::array<float, 3> color(std::uint32_t triangle,
                                           const std::array<double, 3>& shares, double level,
                                           const Camera& camera) const {
    Vec2 uv = this->uv(triangle, shares);
    if (!options_.v_points_down) uv.y = 1 - uv.y;
    std::array<float, 3> albedo{kGrey, kGrey, kGrey};
    if (options_.color != nullptr) {
      const TextureValue value = sampled(*options_.color, uv, level);
      const bool grey = options_.color->levels.front().channels < 3;
      for (std::size_t i = 0; i < 3; ++i) albedo[i] = srgb_to_linear(value[grey ? 0 : i]);
    }
    if (options_.shading == Shading::none) return albedo;
    const double light = light_on(normal_at(triangle, shares, uv, level), triangle, camera);
    for (float& value : albedo) value *= static_cast<float>(light);
    return albedo;
  }

  /// As in the mesh; (0, 0) without UVs.
  [[nodiscard]] Vec2 uv(std::uint32_t triangle, const std::array<double, 3>& shares) const {
    Vec2 sum;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t at = mesh_.corner_texcoord[3 * std::size_t{triangle} + i];
      if (at == kNone) return {};
      sum = sum + shares[i] * mesh_.texcoords[at];
    }
    return sum;
  }

 private:
  [[nodiscard]] TextureValue sampled(const MipMaps& maps, Vec2 uv, double level) const {
    if (options_.trilinear) return sample_trilinear(maps, uv, level, options_.wrap);
    return sample_bilinear(maps.levels.front(), uv, options_.wrap);
  }

  [[nodiscard]] Vec3 face_normal(std::uint32_t triangle) const {
    return unit(polygon_normal(mesh_, triangle));
  }

  [[nodiscard]] Vec3 interpolated(const CornerVectors& vectors, std::uint32_t triangle,
                                  const std::array<double, 3>& shares) const {
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i) {
      sum = sum + shares[i] * vectors[3 * std::size_t{triangle} + i];
    }
    return sum;
  }

  [[nodiscard]] Vec3 normal_at(std::uint32_t triangle, const std::array<double, 3>& shares, Vec2 uv,
                               double level) const {
    switch (options_.shading) {
      case Shading::object_normals:
        return unit(direction_of(sampled(*options_.normals, uv, level)));
      case Shading::smooth:
        return unit(interpolated(frames_.normal, triangle, shares));
      case Shading::tangent_normals:
        break;
      default:
        return face_normal(triangle);
    }
    const Vec3 map = direction_of(sampled(*options_.normals, uv, level));
    const Vec3 normal = unit(interpolated(frames_.normal, triangle, shares));
    const Vec3 tangent = unit(interpolated(frames_.tangent, triangle, shares));
    const double sign = double(frames_.sign[3 * std::size_t{triangle}]);
    return unit(map.x * tangent + sign * map.y * cross(normal, tangent) + map.z * normal);
  }

  [[nodiscard]] double light_on(const Vec3& normal, std::uint32_t triangle,
                                const Camera& camera) const {
    constexpr double kEverywhere = 0.12, kKey = 0.7, kViewer = 0.18;
    const Vec3 key = unit(-0.5 * camera.right + 0.6 * camera.up + 0.7 * camera.back);
    const Vec3 n = dot(face_normal(triangle), camera.back) < 0 ? -1.0 * normal : normal;
    return kEverywhere + kKey * std::max(0.0, dot(n, key)) +
           kViewer * std::max(0.0, dot(n, camera.back));
  }

  const Mesh& mesh_;
  const RenderOptions& options_;
  TangentFrames frames_;
};

/// One view, drawn into its part of the rendering.
class View {
 public:
  View(const Triangulated& mesh, const Camera& camera, const RenderOptions& options, int size)
      : mesh_(mesh), camera_(camera), options_(options), visible_(size * kSamplesAcross) {
    const Mesh& triangles = mesh.mesh;
    placed_.reserve(triangles.face_count());
    for (std::uint32_t t = 0; t < triangles.face_count(); ++t) {
      std::array<Vec3, 3> corner;
      for (std::size_t i = 0; i < 3; ++i) {
        corner[i] =
            camera.place(triangles.positions[triangles.corner_position[3 * std::size_t{t} + i]]);
      }
      placed_.push_back(corner);
      visible_.draw(t, corner);
    }
  }

  void shade(const Shader& shader, int left, Rendering& rendering) const {
    const int size = visible_.size() / kSamplesAcross;
    parallel_for(static_cast<std::size_t>(size), thread_count(0), [&](std::size_t y) {
      for (int x = 0; x < size; ++x) {
        shade_pixel(shader, x, static_cast<int>(y), left, rendering);
      }
    });
  }

 private:
  void shade_pixel(const Shader& shader, int x, int y, int left, Rendering& rendering) const {
    std::array<float, 3> sum{};
    int seen = 0;
    const std::size_t pixel =
        std::size_t{1} * y * rendering.image.width + static_cast<std::size_t>(left + x);
    for (int j = 0; j < kSamplesAcross; ++j) {
      for (int i = 0; i < kSamplesAcross; ++i) {
        const int column = x * kSamplesAcross + i, row = y * kSamplesAcross + j;
        const std::uint32_t triangle =
            visible_.triangle(std::size_t{1} * row * visible_.size() + std::size_t(column));
        std::array<float, 3> color = ground();
        if (triangle != kNone) {
          const std::array<double, 3> shares = shares_at(triangle, column, row);
          color = shader.color(triangle, shares, level_of(triangle), camera_);
          ++seen;
          if (i == kSamplesAcross / 2 && j == kSamplesAcross / 2) {
            rendering.face[pixel] = mesh_.face_source[triangle];
            rendering.uv[pixel] = shader.uv(triangle, shares);
          }
        }
        for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
      }
    }
    constexpr int kSamples = kSamplesAcross * kSamplesAcross;
    float* value = rendering.image.at(left + x, y);
    for (std::size_t c = 0; c < 3; ++c) value[c] = linear_to_srgb(sum[c] / kSamples);
    rendering.covered[pixel] = seen == kSamples ? 1 : 0;
  }

  static std::array<float, 3> ground() {
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) color[c] = srgb_to_linear(float(kGround[c]) / 255.0F);
    return color;
  }

  [[nodiscard]] std::array<double, 3> shares_at(std::uint32_t triangle, int x, int y) const {
    const auto& corner = placed_[triangle];
    const Vec2 a{corner[0].x, corner[0].y}, b{corner[1].x, corner[1].y};
    const Vec2 c{corner[2].x, corner[2].y}, p{double(x), double(y)};
    const double area = signed_area2(a, b, c);
    const double of_b = signed_area2(c, a, p) / area, of_c = signed_area2(a, b, p) / area;
    return {1 - of_b - of_c, of_b, of_c};
  }

  /// By the areas of the triangle on the texture and on the picture.
  [[nodiscard]] double level_of(std::uint32_t triangle) const {
    if (options_.level >= 0) return options_.level;
    const MipMaps* maps = options_.normals != nullptr ? options_.normals : options_.color;
    if (maps == nullptr) return 0;
    std::array<Vec2, 3> uv, place;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t at = mesh_.mesh.corner_texcoord[3 * std::size_t{triangle} + i];
      if (at == kNone) return 0;
      uv[i] = mesh_.mesh.texcoords[at];
      place[i] = {placed_[triangle][i].x, placed_[triangle][i].y};
    }
    const double texels = std::abs(signed_area2(uv[0], uv[1], uv[2])) *
                          static_cast<double>(maps->levels.front().texel_count());
    const double pixels =
        std::abs(signed_area2(place[0], place[1], place[2])) / (kSamplesAcross * kSamplesAcross);
    return texels > pixels && pixels > 0 ? 0.5 * std::log2(texels / pixels) : 0;
  }

  const Triangulated& mesh_;
  const Camera& camera_;
  const RenderOptions& options_;
  Visible visible_;
  std::vector<std::array<Vec3, 3>> placed_;
};

}  // namespace

Rendering render(const Mesh& mesh, const RenderOptions& options) {
  const int size = std::clamp(options.size, 16, 4096), views = std::clamp(options.views, 1, 64);
  Rendering rendering;
  rendering.image = Texture(size * views, size, 3);
  rendering.covered.assign(rendering.image.texel_count(), 0);
  rendering.face.assign(rendering.image.texel_count(), kNone);
  rendering.uv.assign(rendering.image.texel_count(), {});
  const Triangulated triangles = triangulated(mesh);
  const Shader shader(triangles.mesh, options);
  const Mesh& framed = options.framed != nullptr ? *options.framed : mesh;
  for (int view = 0; view < views; ++view) {
    const Camera camera = camera_of_view(view, views, framed, size * kSamplesAcross);
    View(triangles, camera, options, size).shade(shader, view * size, rendering);
  }
  return rendering;
}

}  // namespace wrapatlas
