#include "simplify/constraints.h"

#include <cmath>

#include "mesh/perpendicular.h"

namespace wrapatlas {
namespace {

constexpr double kCosAlpha = 0.99984769515639123916;  // of 1 degree
constexpr double kSinAlpha = 0.01745240643728351282;

/// Of a matrix' trace: rows shorter than this are rounding.
constexpr double kNoRow = 1e-12;

}  // namespace

bool Constraints::is_compatible(const Vec3& unit_normal) const {
  if (count_ == 0) return true;
  if (count_ == 1) return std::abs(dot(normal_[0], unit_normal)) < kCosAlpha;
  return std::abs(dot(line_, unit_normal)) > kSinAlpha * length(line_);
}

void Constraints::add(const Vec3& normal, double offset, double least) {
  const double size = length(normal);
  if (complete() || !(size > least)) return;
  const Vec3 unit_normal = 1 / size * normal;
  if (!is_compatible(unit_normal)) return;
  normal_[count_] = unit_normal;
  offset_[count_] = offset / size;
  ++count_;
  if (count_ == 2) line_ = cross(normal_[0], normal_[1]);
}

void Constraints::minimise(const Symmetric3& h, const Vec3& c) {
  const double least = kNoRow * h.trace();
  const auto along = [&](const Vec3& direction) { add(h * direction, -dot(c, direction), least); };
  if (count_ == 0) {
    along({1, 0, 0});
    along({0, 1, 0});
    along({0, 0, 1});
  } else if (count_ == 1) {
    const Vec3 n = normal_[0], side = perpendicular(n);
    along(side);
    along(cross(n, side));
  } else if (count_ == 2) {
    along(1 / length(line_) * line_);
  }
}

Vec3 Constraints::point() const {
  const auto& [a, b, c] = normal_;
  const Vec3 bc = cross(b, c);
  const Vec3 sum = offset_[0] * bc + offset_[1] * cross(c, a) + offset_[2] * line_;
  return 1 / dot(a, bc) * sum;
}

}  // namespace wrapatlas
