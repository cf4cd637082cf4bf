#include "guided/assemble.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "charts/hull.h"
#include "guided/joiner.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

/// Share of all borders that has to lie on others. Charts cut from one sheet touch along nearly all
/// of them, but for where the sheet had an end; charts that merely fit here and there do not.
constexpr double kContact = 0.4;

double angle_between(double a, double b) { return std::remainder(a - b, 2 * std::numbers::pi); }

/// Sides of an atlas of a frame's shape that has the area of all charts.
Vec2 sides_of(const Frame& frame, double area) {
  const double aspect = std::sqrt(frame.lengths().x / frame.lengths().y);
  return {std::sqrt(area) * aspect, std::sqrt(area) / aspect};
}

/// How a group has to be turned to lie on an atlas, and how sure that is.
struct Turn {
  std::size_t frame = 0;
  double angle = 0, strength = 0;
  std::vector<Period> periods;  ///< that agree, once it is turned
};

/// On an atlas that wraps: its sides are the periods of the group.
Turn turn_to_periods(const std::vector<Period>& found, Vec2 sides, Wrap wrap) {
  constexpr int kFurthest = 3;
  constexpr double kLikeLength = 0.03, kLikeAngle = 0.04;
  struct Reading {
    Period on_atlas;
    double angle;
  };
  std::vector<Reading> readings;
  const int columns = wraps_u(wrap) ? kFurthest : 0, rows = wraps_v(wrap) ? kFurthest : 0;
  for (const Period& period : found) {
    for (int i = -columns; i <= columns; ++i) {
      for (int j = -rows; j <= rows; ++j) {
        const Vec2 whole{i * sides.x, j * sides.y};
        if (std::abs(length(whole) / length(period.shift) - 1) > kLikeLength) continue;
        readings.push_back({{period.match, whole, period.strength},
                            std::atan2(cross(period.shift, whole), dot(period.shift, whole))});
      }
    }
  }
  Turn best;
  for (const Reading& centre : readings) {
    Turn turn;
    double off = 0;
    for (const Reading& other : readings) {
      const double apart = angle_between(other.angle, centre.angle);
      if (std::abs(apart) > kLikeAngle) continue;
      turn.strength += other.on_atlas.strength;
      off += other.on_atlas.strength * apart;
      turn.periods.push_back(other.on_atlas);
    }
    turn.angle = centre.angle + off / turn.strength;
    if (turn.strength > best.strength) best = std::move(turn);
  }
  return best;
}

std::vector<Vec2> points_of(const Groups& groups, std::uint32_t group,
                            std::span<const ChartShape> shapes) {
  std::vector<Vec2> points;
  for (const std::uint32_t chart : groups.members(group)) {
    const Similarity to_group = groups.pose(chart).map();
    for (const Vec2 p : shapes[chart].raster.points) points.push_back(to_group.apply(p));
  }
  return points;
}

/// On one that does not: the group's smallest box is the atlas, if it is of its shape.
Turn turn_to_box(const std::vector<Vec2>& points, Vec2 sides) {
  constexpr double kLike = 0.9;  // of the sides
  const double direction = smallest_box_direction(convex_hull(points));
  Turn best;
  for (int quarter = 0; quarter < 2; ++quarter) {
    const double angle = quarter * std::numbers::pi / 2 - direction;
    Box2 box;
    const Similarity turn = Similarity::from(1, angle, {});
    for (const Vec2 p : points) box.add(turn.apply(p));
    const double larger = std::max(box.size().x / sides.x, box.size().y / sides.y);
    if (1 / larger > std::max(best.strength, kLike)) best = {0, angle, 1 / larger, {}};
  }
  return best;
}

/// Between the points of borders; 0 if in so many seconds not enough of them can be compared.
double border_step(std::span<const ChartShape> shapes, double seconds) {
  constexpr double kSecondsPerPair = 8e-9;
  constexpr double kFewestSteps = 20, kMostSteps = 40;  // along the side of a mean chart
  const double side = std::sqrt(total_area(shapes) / static_cast<double>(shapes.size()));
  double length_of_borders = 0;
  for (const ChartShape& shape : shapes) {
    for (const RasterShape::Edge& edge : shape.raster.edges) {
      length_of_borders += length(shape.raster.points[edge.to] - shape.raster.points[edge.from]);
    }
  }
  if (!(side > 0) || !(length_of_borders > 0)) return 0;
  // n points are n^2 / 2 pairs.
  const double affordable = std::sqrt(2 * seconds / kSecondsPerPair);
  const double steps = std::min(kMostSteps, affordable * side / length_of_borders);
  return steps >= kFewestSteps ? side / steps : 0;
}

/// Onto the frame that it fits best.
Turn turn_to_frame(const Joiner& joiner, std::uint32_t group, std::span<const Frame> frames,
                   double area, Wrap wrap, const std::vector<Vec2>& points) {
  const auto periods = joiner.periods(group);
  Turn best;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Vec2 sides = sides_of(frames[f], area);
    Turn turn =
        wrap == Wrap::none ? turn_to_box(points, sides) : turn_to_periods(periods, sides, wrap);
    turn.frame = f;
    if (turn.strength > best.strength) best = std::move(turn);
  }
  return best;
}

/// Where the charts lie on an atlas with these sides; nothing if they stick out of it.
std::optional<Layout> lay_out(const Groups& groups, const std::vector<Vec2>& points,
                              std::span<const ChartShape> shapes, Vec2 sides, Wrap wrap) {
  constexpr double kLargest = 1.1;  // of a side that does not wrap
  Box2 box;
  for (const Vec2 p : points) box.add(p);
  if (!wraps_u(wrap) && box.size().x > kLargest * sides.x) return {};
  if (!wraps_v(wrap) && box.size().y > kLargest * sides.y) return {};
  const Vec2 origin{wraps_u(wrap) ? 0 : box.min.x, wraps_v(wrap) ? 0 : box.min.y};
  Layout layout;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const Pose& pose = groups.pose(i);
    const double turns = (pose.angle - shapes[i].base_angle) / (2 * std::numbers::pi);
    const int angle = static_cast<int>(std::lround((turns - std::floor(turns)) * kAngleSteps));
    const Vec2 at{(pose.shift.x - origin.x) / sides.x, (pose.shift.y - origin.y) / sides.y};
    layout.spots.push_back({angle % kAngleSteps,
                            {wraps_u(wrap) ? at.x - std::floor(at.x) : at.x,
                             wraps_v(wrap) ? at.y - std::floor(at.y) : at.y}});
  }
  return layout;
}

}  // namespace

std::optional<Assembly> assemble(std::span<const ChartShape> shapes, std::span<const Frame> frames,
                                 const PackOptions& options, double seconds, const Effort& effort) {
  const double step = border_step(shapes, seconds);
  if (step == 0) return {};
  Joiner joiner(shapes, step);
  if (!joiner.all_have_borders()) return {};
  joiner.join_all(thread_count(options.threads), effort);
  Groups& groups = joiner.groups();
  const std::uint32_t group = groups.largest();
  if (groups.members(group).size() < shapes.size()) return {};

  const double area = total_area(shapes);
  Turn turn =
      turn_to_frame(joiner, group, frames, area, options.wrap, points_of(groups, group, shapes));
  const auto holds = [&] {
    return turn.strength > 0 && joiner.contact(group, turn.periods) >= kContact;
  };
  const auto turn_all = [&] {
    for (const std::uint32_t chart : groups.members(group)) groups.move(chart, {turn.angle, {}});
  };
  if (!holds()) return {};
  const Frame& frame = frames[turn.frame];
  const Vec2 sides = sides_of(frame, area);
  Assembly result;
  result.frame = turn.frame;
  turn_all();
  if (options.wrap == Wrap::uv) {
    joiner.relocate(group, sides);
    turn = turn_to_periods(joiner.periods(group), sides, options.wrap);
    if (!holds()) return {};
    turn_all();
  }
  if (!turn.periods.empty()) joiner.settle(group, turn.periods);

  auto layout = lay_out(groups, points_of(groups, group, shapes), shapes, sides, options.wrap);
  if (!layout) return {};
  result.layout = std::move(*layout);
  result.layout.scale = frame.lengths().x / sides.x;
  return result;
}

}  // namespace wrapatlas
