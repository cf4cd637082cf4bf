// Antialiased filling: 8 x 8 samples a pixel, one bit each, so that unions are exact.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// A directed edge in pixels, counted `winding` times.
struct Segment {
  Vec2 from, to;
  int winding = 1;
};

/// Pixels [left, right) x [top, bottom).
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
  [[nodiscard]] int width() const { return right - left; }
  [[nodiscard]] int height() const { return bottom - top; }
  [[nodiscard]] bool empty() const { return left >= right || top >= bottom; }
};

/// Which samples of a window of pixels are covered.
class CoverageMask {
 public:
  static constexpr int kSamples = 64;  ///< bits of a pixel that is covered entirely

  /// Starts over, with nothing covered in `window`.
  void reset(const PixelBox& window);

  /// Covers the samples of non-zero winding number. The segments must form closed loops (in any
  /// order); what lies outside the window is cut off. O(n log n) for n crossings of sample rows.
  void fill(std::span<const Segment> segments);

  [[nodiscard]] const PixelBox& window() const { return window_; }
  /// Precondition: the pixel lies in the window.
  [[nodiscard]] std::uint64_t bits(int x, int y) const {
    return bits_[static_cast<std::size_t>(y - window_.top) * window_.width() + (x - window_.left)];
  }

 private:
  struct Crossing {
    int row, winding;
    double x;
  };
  void cover(int row, double from_x, double to_x);

  PixelBox window_;
  std::vector<std::uint64_t> bits_;
  std::vector<Crossing> crossings_;
};

/// The closed outlines of lines of the given width along `lines`, for CoverageMask::fill. Ends are
/// square, or with `round` rounded, as are the joints then.
std::vector<Segment> stroke(std::span<const Segment> lines, double width, bool round);

}  // namespace wrapatlas
