#include "segment/seams.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace wrapatlas {
namespace {

/// The edges of a disc between its points, and shortest ways along them.
class EdgeGraph {
 public:
  explicit EdgeGraph(const CutChart& disc) : disc_(disc) {
    const std::size_t points = disc.points.size();
    begin_.assign(points + 1, 0);
    for_each_edge([&](std::uint32_t, std::uint32_t a, std::uint32_t b) {
      ++begin_[a + 1];
      ++begin_[b + 1];
    });
    for (std::size_t p = 0; p < points; ++p) begin_[p + 1] += begin_[p];
    arcs_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for_each_edge([&](std::uint32_t corner, std::uint32_t a, std::uint32_t b) {
      const double size = length(disc.points[a] - disc.points[b]);
      arcs_[next[a]++] = {b, corner, size};
      arcs_[next[b]++] = {a, corner, size};
    });
  }

  struct Arc {
    std::uint32_t to, corner;
    double length;
  };
  [[nodiscard]] std::span<const Arc> arcs_of(std::uint32_t point) const {
    return {arcs_.data() + begin_[point], arcs_.data() + begin_[point + 1]};
  }

  /// Walks from a point until `is_end` holds for the nearest point left, or all are reached.
  /// Returns where it ended.
  template <typename IsEnd>
  std::uint32_t walk(std::uint32_t from, IsEnd&& is_end) {
    through_.assign(disc_.points.size(), {kNone, kNone});
    way_.assign(disc_.points.size(), std::numeric_limits<double>::infinity());
    using Step = std::pair<double, std::uint32_t>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
    steps.push({0, from});
    way_[from] = 0;
    std::uint32_t last = from;
    while (!steps.empty()) {
      const auto [way, point] = steps.top();
      steps.pop();
      if (way > way_[point]) continue;
      last = point;
      if (is_end(point)) return point;
      for (const Arc& arc : arcs_of(point)) {
        if (way + arc.length >= way_[arc.to]) continue;
        way_[arc.to] = way + arc.length;
        through_[arc.to] = {point, arc.corner};
        steps.push({way_[arc.to], arc.to});
      }
    }
    return last;
  }

  /// Visits (point, corner of the edge to the one before it) from `to` back to where walk() began.
  template <typename Visit>
  void retrace(std::uint32_t to, Visit&& visit) const {
    while (through_[to].second != kNone) {
      visit(to, through_[to].second);
      to = through_[to].first;
    }
  }

 private:
  template <typename Visit>
  void for_each_edge(Visit&& visit) const {
    for (std::uint32_t c = 0; c < disc_.corner_point.size(); ++c) {
      if (disc_.corner_twin[c] != kNone && disc_.corner_twin[c] < c) continue;
      visit(c, disc_.corner_point[c], disc_.corner_point[disc_.next(c)]);
    }
  }

  const CutChart& disc_;
  std::vector<std::uint32_t> begin_;
  std::vector<Arc> arcs_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> through_;
  std::vector<double> way_;
};

/// Adds both corners of the edge.
void add_edge(const Surface& surface, const Region& region, const CutChart& disc,
              std::uint32_t corner, std::vector<std::uint32_t>& seams) {
  const std::uint32_t face = disc.corner_face[corner];
  const std::uint32_t of_surface =
      surface.face_begin[region.faces[face]] + corner - disc.corner_begin[face];
  seams.push_back(of_surface);
  if (surface.corner_twin[of_surface] != kNone) seams.push_back(surface.corner_twin[of_surface]);
}

std::vector<bool> border_points(const CutChart& disc) {
  std::vector<bool> is_border(disc.points.size(), false);
  for (std::uint32_t c = 0; c < disc.corner_point.size(); ++c) {
    if (disc.corner_twin[c] != kNone) continue;
    is_border[disc.corner_point[c]] = true;
    is_border[disc.corner_point[disc.next(c)]] = true;
  }
  return is_border;
}

/// Area around each point in the plane, over that in space.
std::vector<double> growth_of_points(const CutChart& disc, std::span<const Vec2> uv) {
  std::vector<double> plane(disc.points.size(), 0), space(disc.points.size(), 0);
  for (const auto& [a, b, c] : disc.triangles) {
    const double flat = std::max(0.0, signed_area2(uv[a], uv[b], uv[c]));
    const double true_area =
        length(cross(disc.points[b] - disc.points[a], disc.points[c] - disc.points[a]));
    for (const std::uint32_t p : {a, b, c}) {
      plane[p] += flat;
      space[p] += true_area;
    }
  }
  for (std::size_t p = 0; p < plane.size(); ++p) {
    plane[p] = space[p] > 0 ? plane[p] / space[p] : 1;
  }
  return plane;
}

}  // namespace

std::vector<std::uint32_t> cut_open(const Surface& surface, const Region& region,
                                    const CutChart& disc) {
  EdgeGraph graph(disc);
  const auto never = [](std::uint32_t) { return false; };
  const std::uint32_t one = graph.walk(0, never);
  const std::uint32_t other = graph.walk(one, never);
  std::vector<std::uint32_t> seams;
  graph.retrace(other, [&](std::uint32_t, std::uint32_t corner) {
    add_edge(surface, region, disc, corner, seams);
  });
  std::sort(seams.begin(), seams.end());
  return seams;
}

std::vector<std::uint32_t> seams_to_shrunk(const Surface& surface, const Region& region,
                                           const CutChart& disc, std::span<const Vec2> uv,
                                           double low) {
  const std::vector<double> growth = growth_of_points(disc, uv);
  std::vector<bool> is_border = border_points(disc);
  EdgeGraph graph(disc);
  std::vector<bool> reached(disc.points.size(), false);
  std::vector<std::uint32_t> part, seams;
  for (std::uint32_t seed = 0; seed < disc.points.size(); ++seed) {
    if (reached[seed] || growth[seed] >= low) continue;
    part.assign(1, seed);
    reached[seed] = true;
    std::uint32_t least = seed;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (growth[part[i]] < growth[least]) least = part[i];
      for (const EdgeGraph::Arc& arc : graph.arcs_of(part[i])) {
        if (reached[arc.to] || growth[arc.to] >= low) continue;
        reached[arc.to] = true;
        part.push_back(arc.to);
      }
    }
    if (is_border[least]) continue;
    const std::uint32_t end =
        graph.walk(least, [&](std::uint32_t point) { return is_border[point]; });
    graph.retrace(end, [&](std::uint32_t point, std::uint32_t corner) {
      add_edge(surface, region, disc, corner, seams);
      is_border[point] = true;
    });
    is_border[least] = true;
  }
  std::sort(seams.begin(), seams.end());
  seams.erase(std::unique(seams.begin(), seams.end()), seams.end());
  return seams;
}

}  // namespace wrapatlas
