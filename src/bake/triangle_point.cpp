#include "bake/triangle_point.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

/// How far along ab the point nearest to p lies, 0 to 1.
double along(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 ab = b - a;
  const double size2 = dot(ab, ab);
  return size2 > 0 ? std::clamp(dot(p - a, ab) / size2, 0.0, 1.0) : 0;
}

}  // namespace

Vec3 along_surface(const Triangle& t, const std::array<Vec2, 3>& flat, Vec2 way) {
  const double area = signed_area2(flat[0], flat[1], flat[2]);
  const double b = cross(flat[0] - flat[2], way) / area, c = cross(flat[1] - flat[0], way) / area;
  return b * (t[1] - t[0]) + c * (t[2] - t[0]);
}

double farthest_along(const Triangle& t, const std::array<Vec2, 3>& flat, double way) {
  constexpr double kMostStretch = 3;
  const double area = length(cross(t[1] - t[0], t[2] - t[0]));
  const double in_plane = std::abs(signed_area2(flat[0], flat[1], flat[2]));
  return kMostStretch * way * std::sqrt(area / in_plane);
}

std::array<double, 3> nearest_weights(const Triangle& t, const Vec3& p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const double pb = dot(ap, ab), pc = dot(ap, ac);
  const double area = bb * cc - bc * bc;
  const double v = cc * pb - bc * pc, w = bb * pc - bc * pb;
  std::array<double, 3> best{1, 0, 0};
  double least = -1;
  const auto offer = [&](const std::array<double, 3>& weights) {
    const Vec3 off = point_at(t, weights) - p;
    if (least >= 0 && dot(off, off) >= least) return;
    least = dot(off, off);
    best = weights;
  };
  // Of a sliver this may be far off, so its sides are looked at all the same.
  const bool is_thin = area <= 1e-6 * bb * cc;
  if (area > 0 && v >= 0 && w >= 0 && v + w <= area) {
    offer({1 - (v + w) / area, v / area, w / area});
    if (!is_thin) return best;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double share = along(t[i], t[j], p);
    std::array<double, 3> weights{};
    weights[i] = 1 - share;
    weights[j] = share;
    offer(weights);
  }
  return best;
}

}  // namespace wrapatlas
