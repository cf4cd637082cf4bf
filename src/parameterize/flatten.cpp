// From a disc in space to the plane: angles, then the layout that has them.
#include <fmt/format.h>

#include <cmath>

#include "parameterize/disc.h"
#include "parameterize/labf.h"
#include "parameterize/layout.h"
#include "parameterize/pattern.h"
#include "parameterize/shape.h"
#include "wrapatlas/parameterize.h"

namespace wrapatlas {
namespace {

/// To the area in space. False if there is nothing to scale.
bool scale_to_area(const Disc& disc, std::vector<Vec2>& uv) {
  double area = 0;
  for (const auto& [a, b, c] : disc.triangles) {
    area += std::abs(signed_area2(uv[a], uv[b], uv[c]));
  }
  const double scale = disc.size * std::sqrt(2 * disc.area / area);
  if (!(area > 0) || !std::isfinite(scale)) return false;
  for (Vec2& p : uv) p = scale * p;
  return true;
}

}  // namespace

Result<Flattening> flatten_disc(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                const FlattenOptions& options) {
  if (options.iterations < 1 || options.iterations > kMostIterations) {
    return Error{ErrorKind::usage, "iterations",
                 fmt::format("{} is out of range", options.iterations),
                 fmt::format("choose 1 to {}", kMostIterations)};
  }
  const Result<Disc> disc = make_disc(points, triangles);
  if (!disc) return disc.error();
  const std::vector<std::uint32_t> order = elimination_order(*disc);
  Flattening flat{{}, FlattenMethod::lscm};
  std::vector<Shape> shapes;
  if (options.method == FlattenMethod::labf) {
    if (const auto found = flat_angles(*disc, order, options.iterations)) {
      flat.method = FlattenMethod::labf;
      flat.wheel_residual = found->wheel_residual;
      shapes = shapes_of_angles(found->angles);
    }
  }
  if (flat.method == FlattenMethod::lscm) shapes = shapes_in_space(*disc);
  auto uv = lay_out(*disc, order, shapes);
  if (!uv || !scale_to_area(*disc, *uv)) {
    return Error{ErrorKind::input, "chart", "its points have no place in the plane",
                 "cut it, or clean up triangles that are needles"};
  }
  flat.uv = std::move(*uv);
  return flat;
}

}  // namespace wrapatlas
