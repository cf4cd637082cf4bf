// The surface that is baked onto: where a sample of a texel is in space, and along which axes.
#pragma once

#include <utility>

#include "bake/bleed.h"
#include "bake/texel_samples.h"
#include "bake/triangle_point.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {

struct LowPoint {
  Vec3 position, normal;
  Vec3 tangent, bitangent;
};

class LowSurface {
 public:
  /// `frames`: per corner of the triangles.
  LowSurface(const Mesh& triangles, TangentFrames frames)
      : mesh_(triangles), frames_(std::move(frames)) {}

  /// `on_texels`: the triangle's corners in texels (TexelSamples::corners).
  [[nodiscard]] LowPoint at(const TexelSample& sample, const std::array<Vec2, 3>& on_texels) const;

  /// Along the axes of the chart, which are carried over its border.
  [[nodiscard]] LowPoint beyond(const BeyondBorder& place) const;

 private:
  [[nodiscard]] LowPoint on(std::uint32_t triangle, const std::array<double, 3>& weights) const;
  const Mesh& mesh_;
  TangentFrames frames_;
};

}  // namespace wrapatlas
