#include "raster/row_scan.h"

#include <utility>

namespace wrapatlas {
namespace {

/// A segment grown by a disc. Its right side is, from below to above, an arc around the lower end,
/// a straight piece, an arc around the upper end; its left side the same.
class Capsule {
 public:
  Capsule(Vec2 from, Vec2 to, double radius) : low_(from), high_(to), radius_(radius) {
    if (low_.y > high_.y || (low_.y == high_.y && low_.x > high_.x)) std::swap(low_, high_);
    const Vec2 along = high_ - low_;
    const double norm = std::sqrt(dot(along, along));
    if (norm > 0) side_ = {radius / norm * along.y, -radius / norm * along.x};
    slope_ = along.y > 0 ? along.x / along.y : 0;
  }

  [[nodiscard]] double bottom() const { return low_.y - radius_; }
  [[nodiscard]] double top() const { return high_.y + radius_; }

  /// x extent at a height between bottom() and top().
  [[nodiscard]] Interval at(double y) const { return {x_at<-1>(y), x_at<1>(y)}; }

  /// x extent between two heights, one of which at least lies between bottom() and top(). Each side
  /// is farthest out at the height of the end that lies farthest out, and falls off from there.
  [[nodiscard]] Interval between(double from, double to) const {
    const Vec2 leftmost = low_.x < high_.x ? low_ : high_;
    const Vec2 rightmost = low_.x < high_.x ? high_ : low_;
    return {leftmost.y < from ? x_at<-1>(from)
                              : (leftmost.y > to ? x_at<-1>(to) : leftmost.x - radius_),
            rightmost.y < from ? x_at<1>(from)
                               : (rightmost.y > to ? x_at<1>(to) : rightmost.x + radius_)};
  }

 private:
  template <int kSide>
  [[nodiscard]] double x_at(double y) const {
    const double lean = kSide * side_.y;
    if (y < low_.y + lean) return arc<kSide>(low_, y);
    if (y > high_.y + lean) return arc<kSide>(high_, y);
    return low_.x + kSide * side_.x + (y - low_.y - lean) * slope_;
  }
  template <int kSide>
  [[nodiscard]] double arc(Vec2 centre, double y) const {
    const double away = y - centre.y;
    return centre.x + kSide * std::sqrt(std::max(0.0, radius_ * radius_ - away * away));
  }

  Vec2 low_, high_;
  double radius_;
  Vec2 side_;  ///< from the axis to the right side, length radius
  double slope_;
};

}  // namespace

void cover_capsule(Vec2 a, Vec2 b, double radius, BitLanes& rows) {
  const Capsule capsule(a, b, radius);
  const int end = row_of(capsule.top(), rows);
  for (int y = row_of(capsule.bottom(), rows); y <= end; ++y) {
    set_entered(rows, y, capsule.between(y, y + 1.0));
  }
}

void cover_capsule_centres(Vec2 a, Vec2 b, double radius, BitLanes& rows) {
  const Capsule capsule(a, b, radius);
  const int begin = std::max(0, static_cast<int>(std::ceil(capsule.bottom() - 0.5)));
  const int end = std::min(rows.lanes - 1, static_cast<int>(std::floor(capsule.top() - 0.5)));
  for (int y = begin; y <= end; ++y) set_centres(rows, y, capsule.at(y + 0.5));
}

}  // namespace wrapatlas
