// Which triangle each sample of a view shows.
#pragma once

#include <limits>
#include <vector>

#include "render/camera.h"
#include "render/samples.h"

namespace wrapatlas {

/// Samples in rows from the top: the nearest triangle at each.
class Visible {
 public:
  explicit Visible(int size)
      : size_(size),
        triangle_(std::size_t{1} * size * size, kNone),
        depth_(triangle_.size(), -std::numeric_limits<float>::infinity()) {}

  /// Corners as Camera::place has them.
  void draw(std::uint32_t number, const std::array<Vec3, 3>& corner) {
    std::array<Vec2, 3> flat;
    for (std::size_t i = 0; i < 3; ++i) flat[i] = {corner[i].x, corner[i].y};
    const double area = signed_area2(flat[0], flat[1], flat[2]);
    // The plane of a sliver is a matter of rounding: its depths are kept to those of its corners.
    const double farthest = std::min({corner[0].z, corner[1].z, corner[2].z});
    const double nearest = std::max({corner[0].z, corner[1].z, corner[2].z});
    for_each_span(flat, {0, 0, size_, size_}, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x) {
        const Vec2 here{double(x), double(y)};
        const double share_1 = signed_area2(flat[2], flat[0], here) / area;
        const double share_2 = signed_area2(flat[0], flat[1], here) / area;
        const double plane = corner[0].z + share_1 * (corner[1].z - corner[0].z) +
                             share_2 * (corner[2].z - corner[0].z);
        const auto depth = static_cast<float>(std::clamp(plane, farthest, nearest));
        const std::size_t at = std::size_t{1} * y * size_ + static_cast<std::size_t>(x);
        if (!(depth > depth_[at])) continue;  // no number, no sample
        depth_[at] = depth;
        triangle_[at] = number;
      }
    });
  }

  [[nodiscard]] int size() const { return size_; }
  /// kNone: the ground.
  [[nodiscard]] std::uint32_t triangle(std::size_t sample) const { return triangle_[sample]; }
  [[nodiscard]] float depth(std::size_t sample) const { return depth_[sample]; }
  [[nodiscard]] std::size_t sample_count() const { return triangle_.size(); }

 private:
  int size_;
  std::vector<std::uint32_t> triangle_;
  std::vector<float> depth_;  ///< -infinity: the ground
};

}  // namespace wrapatlas
