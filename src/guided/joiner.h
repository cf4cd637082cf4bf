// Charts joined where their borders match.
#pragma once

#include <span>
#include <vector>

#include "guided/borders.h"
#include "guided/effort.h"
#include "guided/groups.h"

namespace wrapatlas {

/// A match between two charts of one group that wants one of them elsewhere, but turned as it is:
/// what it touches is the other's image beyond a border of the atlas that wraps.
struct Period {
  std::size_t match = 0;
  Vec2 shift;  ///< of the chart of border b
  double strength = 0;
};

class Joiner {
 public:
  /// `step`: input units between points of a border.
  Joiner(std::span<const ChartShape> shapes, double step);

  /// False if some chart is too small, or overlaps itself: it can never be joined.
  [[nodiscard]] bool all_have_borders() const;
  /// Joins until nothing matches any more or the effort is spent, always what the most and the
  /// clearest matches agree on.
  void join_all(int threads, const Effort& effort);
  /// Of all charts of a group.
  [[nodiscard]] std::vector<Period> periods(std::uint32_t group) const;
  /// Takes the charts of a group, of which the first rests, to where their matches agree best.
  /// `periods`: matches across the borders of the atlas, and how far it is from image to image.
  void settle(std::uint32_t group, std::span<const Period> periods);
  /// Takes each chart of a group to where most of its matches want it, on a torus with these sides
  /// along the axes; at first some may lie on others beyond its border, or where one match was
  /// wrong.
  void relocate(std::uint32_t group, Vec2 sides);
  /// Share of a group's borders that lies on others.
  [[nodiscard]] double contact(std::uint32_t group, std::span<const Period> periods) const;
  Groups& groups() { return groups_; }

 private:
  [[nodiscard]] std::uint32_t chart_a(std::size_t m) const { return borders_[matches_[m].a].chart; }
  [[nodiscard]] std::uint32_t chart_b(std::size_t m) const { return borders_[matches_[m].b].chart; }
  [[nodiscard]] std::uint32_t group_a(std::size_t m) const { return groups_.group(chart_a(m)); }
  [[nodiscard]] std::uint32_t group_b(std::size_t m) const { return groups_.group(chart_b(m)); }
  [[nodiscard]] Pose motion(std::size_t m) const;
  [[nodiscard]] bool holds(std::size_t m) const;
  [[nodiscard]] bool same(const Pose& a, const Pose& b, Vec2 at) const;
  void update_support(std::span<const std::size_t> open, std::vector<double>& support) const;
  void add_contact(std::size_t m, std::uint32_t chart, Vec2 shift, MotionFit& fit) const;

  std::size_t charts_;
  double step_;
  std::vector<Border> borders_;
  std::vector<BorderMatch> matches_;  ///< from strong to weak
  Groups groups_;
};

}  // namespace wrapatlas
