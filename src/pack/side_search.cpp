#include "pack/side_search.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

constexpr double kAim = 1.002;     ///< a scale not much above 1, as packings scatter
constexpr double kApart = 0.05;    ///< of the side: packings nearer than that say no slope
constexpr double kMostGrowth = 2;  ///< in a step
constexpr double kLeastGrowth = 1.01;
constexpr double kWorthATry = 0.007;  ///< of the side

}  // namespace

int SideSearch::rounded(double side) const {
  const double least = std::min(too_small_ + 4, kMost);
  return 4 * static_cast<int>(std::ceil(std::clamp(side, least, double{kMost}) / 4));
}

double SideSearch::promised(double scale) {
  if (scale == 0) return kMostGrowth * side_;
  if (last_scale_ > 0 && std::abs(side_ - last_side_) > kApart * side_) {
    slope_ = (scale - last_scale_) / (side_ - last_side_);
  }
  last_side_ = side_;
  last_scale_ = scale;
  const double slope = std::max(slope_, scale / side_);  // the line begins at 0 or above
  return std::min(side_ + (kAim - scale) / slope, kMostGrowth * side_);
}

bool SideSearch::go_on(double scale) {
  const bool was_quick = is_quick();
  double next = promised(scale);
  if (scale >= 1 && (enough_ == 0 || side_ < enough_)) enough_ = side_;
  if (scale == 0 || (scale < 1 && !was_quick)) too_small_ = std::max(too_small_, side_);
  int& left = was_quick ? quick_left_ : full_left_;
  if (scale > 0 && left > 0) --left;
  if (was_quick && rounded(next) == side_) quick_left_ = 0;  // it would be the same packing

  if (enough_ == 0) {
    if (too_small_ >= kMost) return false;
    if (!was_quick) next = std::max(next, kLeastGrowth * side_);
    side_ = rounded(next);
    return true;
  }
  const double smaller = std::min((1 - kWorthATry) * enough_, enough_ - 4.0);
  if (was_quick && !is_quick()) next = std::min(next, smaller);  // a full one is denser
  if (!was_quick && (full_left_ == 0 || (scale >= 1 && next > smaller))) return false;
  const bool is_between = next > too_small_ && (next < enough_ || (is_quick() && scale > 0));
  if (!is_between) next = 0.5 * (too_small_ + enough_);
  if (!is_quick() && next > smaller) return false;
  side_ = rounded(next);
  return side_ < enough_ || is_quick();
}

}  // namespace wrapatlas
