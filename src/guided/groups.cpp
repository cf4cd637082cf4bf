#include "guided/groups.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wrapatlas {
namespace {

constexpr double kMostShared = 0.1;  ///< of a chart's cells: so much comes of rounding
constexpr int kPlane = 1 << 13;      ///< cells along the side of a plane

}  // namespace

Groups::Groups(std::span<const ChartShape> shapes, double cell)
    : shapes_(shapes), cell_(cell), poses_(shapes.size()) {
  for (std::uint32_t chart = 0; chart < shapes.size(); ++chart) {
    group_.push_back(chart);
    members_.push_back({chart});
    covered_.push_back(covered(chart, poses_[chart]));
  }
}

std::uint32_t Groups::largest() const {
  const auto found =
      std::max_element(members_.begin(), members_.end(),
                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return static_cast<std::uint32_t>(found - members_.begin());
}

bool Groups::join(std::uint32_t a, std::uint32_t b, const Pose& motion) {
  std::vector<Covered> moved;
  for (const std::uint32_t chart : members_[b]) {
    moved.push_back(covered(chart, motion.after(poses_[chart])));
    if (moved.back().cells == 0) return false;  // too large to be looked at
    for (const std::uint32_t other : members_[a]) {
      const auto cells = static_cast<double>(std::min(moved.back().cells, covered_[other].cells));
      const std::int64_t shared = Cover::shared(moved.back().cover, covered_[other].cover);
      if (static_cast<double>(shared) > kMostShared * cells) return false;
    }
  }
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const std::uint32_t chart = members_[b][k];
    poses_[chart] = motion.after(poses_[chart]);
    covered_[chart] = std::move(moved[k]);
    group_[chart] = a;
    members_[a].push_back(chart);
  }
  members_[b].clear();
  return true;
}

void Groups::settled(std::uint32_t group) {
  constexpr double kNoticed = 0.5;  // cells
  for (const std::uint32_t chart : members_[group]) {
    const Pose &now = poses_[chart], &then = covered_[chart].pose;
    const double turned = std::abs(std::remainder(now.angle - then.angle, 2 * std::numbers::pi));
    const double moved = length(now.shift - then.shift) / cell_ + turned * covered_[chart].reach;
    if (moved > kNoticed) {
      covered_[chart] = covered(chart, now);
    }
  }
}

Groups::Covered Groups::covered(std::uint32_t chart, const Pose& pose) const {
  RasterScale scale;
  scale.cells_per_unit = {1 / cell_, 1 / cell_};
  scale.coverage = Coverage::center;
  const ChartRaster raster = rasterize_cells(shapes_[chart].raster, scale, pose.angle);
  if (raster.width == 0) return {};
  const Piece piece = make_bare_piece(raster);
  const auto at = [](double shift, double in_piece, int size) {
    return std::clamp(kPlane / 2 + static_cast<int>(std::lround(shift - in_piece)), 0,
                      kPlane - size);
  };
  Covered result;
  result.cells = piece.cells;
  result.pose = pose;
  result.reach = length(Vec2{double(piece.width), double(piece.height)}) / 2;
  result.cover.set({kPlane, kPlane, false, false}, piece,
                   at(pose.shift.x / cell_, piece.centre.x, piece.width),
                   at(pose.shift.y / cell_, piece.centre.y, piece.height));
  return result;
}

}  // namespace wrapatlas
