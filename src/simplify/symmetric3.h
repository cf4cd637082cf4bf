// Symmetric 3x3 matrices.
#pragma once

#include "wrapatlas/geometry.h"

namespace wrapatlas {

struct Symmetric3 {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// v vᵀ
  static Symmetric3 square(const Vec3& v) {
    return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
  }
  friend Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
  }
  friend Symmetric3 operator*(double s, const Symmetric3& a) {
    return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz};
  }
  friend Symmetric3 operator-(const Symmetric3& a, const Symmetric3& b) { return a + -1.0 * b; }
  friend Vec3 operator*(const Symmetric3& a, const Vec3& v) {
    return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
            a.xz * v.x + a.yz * v.y + a.zz * v.z};
  }
  [[nodiscard]] double trace() const { return xx + yy + zz; }
};

}  // namespace wrapatlas
