// What a place on a textured model looks like.
#pragma once

#include <array>
#include <cstdint>

#include "mesh/triangulate.h"
#include "render/camera.h"
#include "wrapatlas/render.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {

/// Barycentric: of a triangle's corners; they add up to 1.
using Weights = std::array<double, 3>;

class Shader {
 public:
  /// Both outlive the shader.
  Shader(const Triangulated& triangles, const RenderOptions& options);

  /// Linear light. `level_of_detail`: how far the triangle reaches in UV for each pixel on the
  /// picture, as a power of two. Thread safe.
  [[nodiscard]] std::array<float, 3> color(std::uint32_t triangle, const Weights& weights,
                                           double level_of_detail, const Camera& camera) const;

  /// As in the mesh; (0, 0) without UVs.
  [[nodiscard]] Vec2 uv(std::uint32_t triangle, const Weights& weights) const;

 private:
  [[nodiscard]] std::array<float, 3> albedo(std::uint32_t triangle, Vec2 uv,
                                            double level_of_detail) const;
  [[nodiscard]] TextureValue sampled(const MipMaps& maps, Vec2 uv, Wrap wrap,
                                     double level_of_detail) const;
  [[nodiscard]] Vec3 face_normal(std::uint32_t triangle) const;
  [[nodiscard]] Vec3 interpolated(const CornerVectors& vectors, std::uint32_t triangle,
                                  const Weights& weights) const;
  [[nodiscard]] Vec3 normal_at(std::uint32_t triangle, const Weights& weights, Vec2 uv,
                               double level_of_detail) const;
  [[nodiscard]] double light_on(const Vec3& normal, std::uint32_t triangle,
                                const Camera& camera) const;

  const Mesh& mesh_;
  const std::vector<std::uint32_t>& face_;  ///< of the model, per triangle
  const RenderOptions& options_;
  TangentFrames frames_;
};

}  // namespace wrapatlas
