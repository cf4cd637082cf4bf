// The borders of charts as points at equal distances, and where two borders run alike: charts that
// were cut from one sheet fit together there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "guided/effort.h"
#include "guided/piece_library.h"
#include "guided/pose.h"

namespace wrapatlas {

/// One closed line of a chart's outline, the chart to its left.
struct Border {
  std::uint32_t chart = 0;
  std::vector<Vec2> points;               ///< relative to the shape's centre, input units
  std::vector<std::uint16_t> directions;  ///< of the line at each point, 65536 to the turn

  [[nodiscard]] int size() const { return static_cast<int>(points.size()); }
  [[nodiscard]] Vec2 point(int i) const { return points[static_cast<std::size_t>(index(i))]; }
  /// Where number i of a walk without end is.
  [[nodiscard]] int index(int i) const {
    const int rest = i % size();
    return rest < 0 ? rest + size() : rest;
  }
};

/// The borders of charts whose winding is clean, with a point about every `step`. Lines too short
/// to have a shape are left out.
std::vector<Border> sample_borders(std::span<const ChartShape> shapes, double step);

/// Points begin_a, begin_a + 1, ... of border a lie on points begin_b, begin_b - 1, ... of border
/// b.
struct BorderMatch {
  std::uint32_t a = 0, b = 0;  ///< numbers of borders
  std::int32_t begin_a = 0, begin_b = 0, count = 0;
  Pose b_to_a;          ///< takes the chart of b to its place beside that of a
  double strength = 0;  ///< points in contact; those of straight lines, which fit anywhere, less
};

/// A point of a border, and the unit vector along the line it is on.
struct OnBorder {
  Vec2 point, along;
};
/// The nearest to `point` among the lines next to point number `near`.
OnBorder nearest_on(const Border& border, Vec2 point, int near);

/// All places where two borders run alike for a while, the strongest of each pair of borders.
/// Of each point several are kept. An effort that is spent leaves some out. `step`: as sampled.
std::vector<BorderMatch> match_borders(std::span<const Border> borders, double step, int threads,
                                       const Effort& effort);

}  // namespace wrapatlas
