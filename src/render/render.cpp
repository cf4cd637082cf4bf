// Deferred: first which triangle each sample shows, then what is there.
#include "wrapatlas/render.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/triangulate.h"
#include "render/colors.h"
#include "render/shader.h"
#include "render/visible.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

std::array<float, 3> linear_ground() {
  std::array<float, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = srgb_to_linear(float(kGround[c]) / 255.0F);
  return color;
}

/// One view, drawn into its part of the rendering.
class View {
 public:
  View(const Triangulated& mesh, const Camera& camera, const RenderOptions& options, int size)
      : mesh_(mesh), camera_(camera), options_(options), visible_(size * kSamplesAcross) {
    const Mesh& triangles = mesh.mesh;
    placed_.reserve(triangles.face_count());
    for (std::uint32_t t = 0; t < triangles.face_count(); ++t) {
      Placed placed;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t c = 3 * std::size_t{t} + i;
        placed.corner[i] = camera.place(triangles.positions[triangles.corner_position[c]]);
      }
      placed.level_of_detail = level_of(triangles, t, placed.flat());
      placed_.push_back(placed);
      visible_.draw(t, placed.corner);
    }
  }

  void shade(const Shader& shader, int left, Rendering& rendering) const {
    const int size = visible_.size() / kSamplesAcross;
    parallel_for(static_cast<std::size_t>(size), thread_count(options_.threads),
                 [&](std::size_t y) {
                   for (int x = 0; x < size; ++x) {
                     shade_pixel(shader, x, static_cast<int>(y), left, rendering);
                   }
                 });
  }

 private:
  struct Placed {
    std::array<Vec3, 3> corner;
    double level_of_detail = 0;
    [[nodiscard]] std::array<Vec2, 3> flat() const {
      return {
          Vec2{corner[0].x, corner[0].y}, {corner[1].x, corner[1].y}, {corner[2].x, corner[2].y}};
    }
  };

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
        std::array<float, 3> color = ground_;
        if (triangle != kNone) {
          const Weights weights = weights_at(triangle, column, row);
          color = shader.color(triangle, weights, placed_[triangle].level_of_detail, camera_);
          ++seen;
          if (i == kSamplesAcross / 2 && j == kSamplesAcross / 2) {
            rendering.face[pixel] = mesh_.face_source[triangle];
            rendering.uv[pixel] = shader.uv(triangle, weights);
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

  [[nodiscard]] Weights weights_at(std::uint32_t triangle, int x, int y) const {
    const auto [a, b, c] = placed_[triangle].flat();
    const Vec2 p{double(x), double(y)};
    const double area = signed_area2(a, b, c);
    // Of a sliver they are a matter of rounding: they are kept to what lies on it.
    const double of_b = std::clamp(signed_area2(c, a, p) / area, 0.0, 1.0);
    const double of_c = std::clamp(signed_area2(a, b, p) / area, 0.0, 1 - of_b);
    return {1 - of_b - of_c, of_b, of_c};
  }

  /// By the areas of the triangle in UV and on the picture.
  static double level_of(const Mesh& triangles, std::uint32_t triangle,
                         const std::array<Vec2, 3>& place) {
    constexpr double kNothing = -std::numeric_limits<double>::infinity();
    std::array<Vec2, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t at = triangles.corner_texcoord[3 * std::size_t{triangle} + i];
      if (at == kNone) return kNothing;
      uv[i] = triangles.texcoords[at];
    }
    const double in_uv = std::abs(signed_area2(uv[0], uv[1], uv[2]));
    const double pixels =
        std::abs(signed_area2(place[0], place[1], place[2])) / (kSamplesAcross * kSamplesAcross);
    return pixels > 0 ? 0.5 * std::log2(in_uv / pixels) : kNothing;
  }

  const Triangulated& mesh_;
  const Camera& camera_;
  const RenderOptions& options_;
  std::array<float, 3> ground_ = linear_ground();
  Visible visible_;
  std::vector<Placed> placed_;
};

}  // namespace

Rendering render(const Mesh& mesh, const RenderOptions& options) {
  const int size = std::clamp(options.size, 16, 4096);
  const int views = options.from ? 1 : std::clamp(options.views, 1, std::min(64, 65536 / size));
  Rendering rendering;
  rendering.image = Texture(size * views, size, 3);
  rendering.covered.assign(rendering.image.texel_count(), 0);
  rendering.face.assign(rendering.image.texel_count(), kNone);
  rendering.uv.assign(rendering.image.texel_count(), {});
  const Triangulated triangles = triangulated(mesh);
  const Shader shader(triangles, options);
  const Mesh& framed = options.framed != nullptr ? *options.framed : mesh;
  for (int view = 0; view < views; ++view) {
    const int samples = size * kSamplesAcross;
    const Camera camera =
        options.from ? camera_at(options.from->azimuth, options.from->elevation, framed, samples)
                     : camera_of_view(view, views, framed, samples);
    View(triangles, camera, options, size).shade(shader, view * size, rendering);
  }
  return rendering;
}

}  // namespace wrapatlas
