#include "render/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wrapatlas {
namespace {

constexpr int kSub = 8;  // samples along one side of a pixel

/// The first sample (of `count`) whose centre is at or after `position` pixels from the window.
int first_sample(double position, int count) {
  const double index = std::ceil(position * kSub - 0.5);
  return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(count)));
}

void append_loop(std::span<const Vec2> loop, std::vector<Segment>& segments) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    segments.push_back({loop[i], loop[(i + 1) % loop.size()], 1});
  }
}

}  // namespace

void CoverageMask::reset(const PixelBox& window) {
  window_ = window;
  bits_.assign(window.empty() ? 0 : static_cast<std::size_t>(window.width()) * window.height(), 0);
}

void CoverageMask::fill(std::span<const Segment> segments) {
  if (window_.empty()) return;
  crossings_.clear();
  const int rows = window_.height() * kSub;
  for (const Segment& segment : segments) {
    const bool down = segment.from.y <= segment.to.y;
    const Vec2 upper = down ? segment.from : segment.to;
    const Vec2 lower = down ? segment.to : segment.from;
    const int begin = first_sample(upper.y - window_.top, rows);
    const int end = first_sample(lower.y - window_.top, rows);
    if (begin >= end) continue;
    const double slope = (lower.x - upper.x) / (lower.y - upper.y);
    const int winding = down ? segment.winding : -segment.winding;
    for (int row = begin; row < end; ++row) {
      const double y = window_.top + (row + 0.5) / kSub;
      crossings_.push_back({row, winding, upper.x + (y - upper.y) * slope});
    }
  }
  std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
    return a.row != b.row ? a.row < b.row : a.x < b.x;
  });
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings_.size(); ++i) {
    const Crossing& here = crossings_[i];
    const Crossing& next = crossings_[i + 1];
    winding = (i > 0 && crossings_[i - 1].row != here.row ? 0 : winding) + here.winding;
    if (winding != 0 && next.row == here.row) cover(here.row, here.x, next.x);
  }
}

void CoverageMask::cover(int row, double from_x, double to_x) {
  const int columns = window_.width() * kSub;
  int from = first_sample(from_x - window_.left, columns);
  const int to = first_sample(to_x - window_.left, columns);
  std::uint64_t* pixels = &bits_[static_cast<std::size_t>(row / kSub) * window_.width()];
  const int shift = (row % kSub) * kSub;
  while (from < to) {
    const int pixel = from / kSub;
    const int last = std::min(to, (pixel + 1) * kSub);
    const std::uint64_t run = (1ULL << (last - from)) - 1;
    pixels[pixel] |= run << (shift + from % kSub);
    from = last;
  }
}

std::vector<Segment> stroke(std::span<const Segment> lines, double width, bool round) {
  constexpr int kCorners = 12;
  const double half = width / 2;
  std::vector<Segment> segments;
  segments.reserve(lines.size() * (round ? 4 + 2 * kCorners : 4));
  for (const Segment& line : lines) {
    const Vec2 along = line.to - line.from;
    const double size = length(along);
    const Vec2 ahead = size > 0 ? (half / size) * along : Vec2{half, 0};
    const Vec2 side{-ahead.y, ahead.x};
    const Vec2 cap = round ? Vec2{} : ahead;
    // Every quad turns the same way, so that overlapping ones never cancel.
    append_loop(std::array{line.from - cap - side, line.to + cap - side, line.to + cap + side,
                           line.from - cap + side},
                segments);
    if (!round) continue;
    for (const Vec2 centre : {line.from, line.to}) {
      std::array<Vec2, kCorners> disc;
      for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * std::numbers::pi * i / kCorners;
        disc[i] = centre + half * Vec2{std::cos(angle), std::sin(angle)};
      }
      append_loop(disc, segments);
    }
  }
  return segments;
}

}  // namespace wrapatlas
