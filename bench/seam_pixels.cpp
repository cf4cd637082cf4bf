#include "seam_pixels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/polygon_plane.h"

namespace wrapatlas::bench {

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

std::array<Vec2, 3> texels_of(const Mesh& mesh, std::uint32_t face, int side) {
  std::array<Vec2, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = double(side) * mesh.texcoords[mesh.corner_texcoord[3 * std::size_t{face} + k]];
  }
  return corner;
}

Vec2 uv_at(const Mesh& mesh, std::uint32_t face, const std::array<double, 3>& weights) {
  const std::array<Vec2, 3> corner = texels_of(mesh, face, 1);
  return weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
}

Projection::Projection(const Mesh& low, const HighSurface& high, double distance)
    : low_(low), high_(high), distance_(distance), normals_(smooth_normals(low)) {}

HighPoint Projection::find(std::uint32_t face, const std::array<double, 3>& weights) const {
  Vec3 normal;
  for (std::size_t k = 0; k < 3; ++k) {
    normal = normal + weights[k] * normals_[3 * std::size_t{face} + k];
  }
  return high_.find(point_at(triangle_of(low_, face), weights), unit(normal), distance_);
}

Filtered Seamless::at(const Pixel& pixel, int level) const {
  constexpr int kAcross = 4;  // samples of a texel
  const double texel = std::exp2(level);
  const Vec2 place = double(side_) * pixel.uv;
  const Vec2 first{std::floor(place.x / texel - 0.5), std::floor(place.y / texel - 0.5)};
  const Vec2 share = (1 / texel) * place - first - Vec2{0.5, 0.5};
  Vec3 sum;
  double weights = 0;
  for (int i = 0; i < 4 * kAcross * kAcross; ++i) {
    const int column = i % (2 * kAcross), row = i / (2 * kAcross);
    const double weight =
        (column < kAcross ? 1 - share.x : share.x) * (row < kAcross ? 1 - share.y : share.y);
    const Vec2 at = first + (1.0 / kAcross) * Vec2{column + 0.5, row + 0.5};
    sum = sum + weight * seen_from(pixel, texel * at - place);
    weights += weight;
  }
  const double mean_length = std::min(length(sum) / weights, 1.0);
  return {unit(sum), std::acos(mean_length) * 180 / std::numbers::pi};
}

Vec3 Seamless::seen_from(const Pixel& pixel, Vec2 by) const {
  const std::array<Vec2, 3> corner = texels_of(low_, pixel.face, side_);
  const Triangle t = triangle_of(low_, pixel.face);
  const WalkEnd end = walk_.go(pixel.face, pixel.weights, along_surface(t, corner, by));
  return projection_.normal(projection_.find(end.triangle, end.weights));
}

std::vector<Pixel> visible_pixels(const Mesh& low, const Projection& projection, int side,
                                  const RenderOptions& view) {
  const Rendering rendering = render(low, view);
  const ChartBorders borders(low, side);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < rendering.face.size(); ++i) {
    const std::uint32_t face = rendering.face[i];
    if (face == kNone || rendering.covered[i] == 0) continue;
    const std::array<Vec2, 3> corner = texels_of(low, face, side);
    const double area = signed_area2(corner[0], corner[1], corner[2]);
    if (area == 0) continue;
    const Vec2 texel = double(side) * rendering.uv[i];
    const double b = signed_area2(corner[2], corner[0], texel) / area;
    const double c = signed_area2(corner[0], corner[1], texel) / area;
    const std::array<double, 3> weights{1 - b - c, b, c};
    const HighPoint point = projection.find(face, weights);
    if (!point.by_ray) continue;
    const auto to_whole = [&](double t) { return std::abs(t - side * std::round(t / side)); };
    pixels.push_back({rendering.uv[i], face, weights, projection.normal(point),
                      borders.distance(face, texel),
                      std::min(to_whole(texel.x), to_whole(texel.y))});
  }
  return pixels;
}

}  // namespace wrapatlas::bench
