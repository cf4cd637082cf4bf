// Small vectors, boxes and the similarity transforms that a packing is made of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace wrapatlas {

/// "No such index" in every index array of the library.
inline constexpr std::uint32_t kNone = 0xffffffffU;

struct Vec2 {
  double x = 0, y = 0;
  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return std::hypot(a.x, a.y); }

/// Twice the signed area of (a, b, c): positive if counter-clockwise with y up.
inline double signed_area2(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// An axis-aligned box; empty until a point is added.
struct Box2 {
  Vec2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Vec2 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  [[nodiscard]] bool empty() const { return min.x > max.x; }
  [[nodiscard]] Vec2 size() const { return empty() ? Vec2{} : max - min; }
};

/// p -> scale * R(angle) * p + translation. Never mirrors: scale > 0.
struct Similarity {
  double scale = 1;
  double cos_angle = 1, sin_angle = 0;
  Vec2 translation;

  static Similarity from(double scale, double angle_radians, Vec2 translation) {
    return {scale, std::cos(angle_radians), std::sin(angle_radians), translation};
  }
  [[nodiscard]] Vec2 apply(Vec2 p) const {
    return {scale * (cos_angle * p.x - sin_angle * p.y) + translation.x,
            scale * (sin_angle * p.x + cos_angle * p.y) + translation.y};
  }
};

}  // namespace wrapatlas
