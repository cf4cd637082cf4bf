// Charts that lie side by side in groups, each group in a plane of its own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "guided/cover.h"
#include "guided/piece_library.h"
#include "guided/pose.h"

namespace wrapatlas {

class Groups {
 public:
  /// Every chart is a group. `cell`: input units, of the cells by which overlap is found.
  Groups(std::span<const ChartShape> shapes, double cell);

  [[nodiscard]] std::uint32_t group(std::uint32_t chart) const { return group_[chart]; }
  /// Of a group; empty if it was joined to another.
  [[nodiscard]] const std::vector<std::uint32_t>& members(std::uint32_t group) const {
    return members_[group];
  }
  /// The group with most charts.
  [[nodiscard]] std::uint32_t largest() const;
  /// Takes a shape's points to the plane of its group.
  [[nodiscard]] const Pose& pose(std::uint32_t chart) const { return poses_[chart]; }
  void move(std::uint32_t chart, const Pose& motion) {
    poses_[chart] = motion.after(poses_[chart]);
  }
  /// Charts of a group were moved: from now on they are in the way where they are.
  void settled(std::uint32_t group);
  /// Puts group b, moved, to group a. False if charts would lie on each other.
  bool join(std::uint32_t a, std::uint32_t b, const Pose& motion);

 private:
  struct Covered {
    Cover cover;
    std::int64_t cells = 0;
    Pose pose;         ///< at which it was found
    double reach = 0;  ///< from the chart's centre, cells
  };
  [[nodiscard]] Covered covered(std::uint32_t chart, const Pose& pose) const;

  std::span<const ChartShape> shapes_;
  double cell_;
  std::vector<std::uint32_t> group_;
  std::vector<Pose> poses_;
  std::vector<Covered> covered_;
  std::vector<std::vector<std::uint32_t>> members_;
};

}  // namespace wrapatlas
