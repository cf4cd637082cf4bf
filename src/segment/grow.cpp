#include "segment/grow.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <set>

#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

/// Slightly above 1, or steps within a plane would be free.
constexpr double kNormalsApart = 1.01;

struct Step {
  double cost = 0;
  std::uint32_t face = 0, from = 0;
  friend bool operator>(const Step& a, const Step& b) {
    if (a.cost != b.cost) return a.cost > b.cost;
    return a.face != b.face ? a.face > b.face : a.from > b.from;
  }
};
using Steps = std::priority_queue<Step, std::vector<Step>, std::greater<>>;

/// Distance of two faces of the region, by their centroids.
double distance(const Region& region, const FaceShapes& shapes, std::uint32_t a, std::uint32_t b) {
  return length(shapes.centroid[region.faces[a]] - shapes.centroid[region.faces[b]]);
}

double edge_length(const Surface& surface, std::uint32_t corner) {
  return length(surface.points[surface.corner_vertex[corner]] -
                surface.points[surface.corner_vertex[surface.next(corner)]]);
}

double step_cost(const Region& region, const FaceShapes& shapes, std::uint32_t from,
                 std::uint32_t to, const Vec3& normal) {
  const double apart = kNormalsApart - dot(normal, shapes.normal[region.faces[to]]);
  return apart * distance(region, shapes, from, to);
}

}  // namespace

Growth grow(const Region& region, const FaceShapes& shapes, std::span<const std::uint32_t> seeds) {
  Growth growth;
  growth.seed_of.assign(region.size(), kNone);
  std::vector<Vec3> normal_sum(seeds.size());
  Steps steps;
  // Before all others, also where steps cost nothing: a seed has its own face.
  for (std::uint32_t i = 0; i < seeds.size(); ++i) steps.push({-1, seeds[i], i});
  while (!steps.empty()) {
    const Step step = steps.top();
    steps.pop();
    if (growth.seed_of[step.face] != kNone) continue;
    growth.seed_of[step.face] = step.from;
    const double way = std::max(0.0, step.cost);
    const std::uint32_t face = region.faces[step.face];
    normal_sum[step.from] = normal_sum[step.from] + shapes.area[face] * shapes.normal[face];
    const Vec3 normal = unit(normal_sum[step.from]);
    for (const Region::Arc arc : region.arcs_of(step.face)) {
      if (growth.seed_of[arc.to] != kNone) continue;
      steps.push({way + step_cost(region, shapes, step.face, arc.to, normal), arc.to, step.from});
    }
  }
  return growth;
}

std::vector<std::uint32_t> middles(const Surface& surface, const Region& region,
                                   const FaceShapes& shapes, const Growth& growth,
                                   std::span<const std::uint32_t> seeds) {
  std::vector<std::uint32_t> middle(seeds.begin(), seeds.end());
  std::vector<bool> reached(region.size(), false);
  Steps steps;
  for (std::uint32_t i = 0; i < region.size(); ++i) {
    const std::uint32_t face = region.faces[i];
    const auto arcs = region.arcs_of(i);
    const bool is_inner = arcs.size() == surface.face_begin[face + 1] - surface.face_begin[face] &&
                          std::all_of(arcs.begin(), arcs.end(), [&](const Region::Arc& arc) {
                            return growth.seed_of[arc.to] == growth.seed_of[i];
                          });
    if (!is_inner) steps.push({0, i, 0});
  }
  while (!steps.empty()) {
    const Step step = steps.top();
    steps.pop();
    if (reached[step.face]) continue;
    reached[step.face] = true;
    const std::uint32_t chart = growth.seed_of[step.face];
    middle[chart] = step.face;  // the last one to come stays
    for (const Region::Arc arc : region.arcs_of(step.face)) {
      if (reached[arc.to] || growth.seed_of[arc.to] != chart) continue;
      steps.push({step.cost + distance(region, shapes, step.face, arc.to), arc.to, 0});
    }
  }
  return middle;
}

std::vector<std::uint32_t> far_seeds(const Region& region, const FaceShapes& shapes,
                                     std::uint32_t count) {
  std::vector<double> way(region.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> seeds;
  Steps steps;
  const auto walk_from = [&](std::uint32_t seed) {
    way[seed] = 0;
    steps.push({0, seed, seed});
    while (!steps.empty()) {
      const Step step = steps.top();
      steps.pop();
      if (step.cost > way[step.face]) continue;
      for (const Region::Arc arc : region.arcs_of(step.face)) {
        const double cost = step.cost + step_cost(region, shapes, step.face, arc.to,
                                                  shapes.normal[region.faces[step.face]]);
        if (cost >= way[arc.to]) continue;
        way[arc.to] = cost;
        steps.push({cost, arc.to, seed});
      }
    }
  };
  const auto farthest = [&] {
    return static_cast<std::uint32_t>(std::max_element(way.begin(), way.end()) - way.begin());
  };
  walk_from(0);
  // The first seed is far from where it began, as all others will be.
  seeds.push_back(farthest());
  std::fill(way.begin(), way.end(), std::numeric_limits<double>::infinity());
  walk_from(seeds[0]);
  while (seeds.size() < count) {
    std::uint32_t next = farthest();
    if (way[next] <= 0) {  // of no size: any face that is no seed yet
      next = 0;
      while (next < region.size() && std::find(seeds.begin(), seeds.end(), next) != seeds.end()) {
        ++next;
      }
      if (next == region.size()) break;
    }
    seeds.push_back(next);
    walk_from(next);
  }
  return seeds;
}

void smooth_borders(const Surface& surface, const Region& region, Growth& growth) {
  std::vector<std::uint32_t> size;
  for (const std::uint32_t chart : growth.seed_of) {
    size.resize(std::max<std::size_t>(size.size(), chart + std::size_t{1}), 0);
    ++size[chart];
  }
  std::vector<std::uint32_t> waiting(region.size());
  for (std::uint32_t i = 0; i < region.size(); ++i) waiting[i] = region.size() - 1 - i;
  std::vector<std::pair<std::uint32_t, double>> shares;  // of charts in the face's border
  while (!waiting.empty()) {
    const std::uint32_t face = waiting.back();
    waiting.pop_back();
    const std::uint32_t own = growth.seed_of[face];
    double own_length = 0;
    std::uint32_t own_edges = 0;
    shares.clear();
    for (const Region::Arc arc : region.arcs_of(face)) {
      const std::uint32_t chart = growth.seed_of[arc.to];
      const double edge = edge_length(surface, arc.corner);
      if (chart == own) {
        own_length += edge;
        ++own_edges;
        continue;
      }
      const auto known = std::find_if(shares.begin(), shares.end(),
                                      [&](const auto& share) { return share.first == chart; });
      if (known == shares.end()) {
        shares.emplace_back(chart, edge);
      } else {
        known->second += edge;
      }
    }
    // A face that holds its chart by one edge alone does not part it by leaving.
    if (shares.empty() || own_edges > 1 || size[own] == 1) continue;
    const auto best =
        std::max_element(shares.begin(), shares.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (best->second <= own_length * (1 + 1e-9)) continue;
    growth.seed_of[face] = best->first;
    --size[own];
    ++size[best->first];
    for (const Region::Arc arc : region.arcs_of(face)) waiting.push_back(arc.to);
  }
}

Growth grow_charts(const Surface& surface, const Region& region, const FaceShapes& shapes,
                   std::uint32_t count, int rounds) {
  std::vector<std::uint32_t> seeds = far_seeds(region, shapes, count);
  Growth growth = grow(region, shapes, seeds);
  std::set<std::vector<std::uint32_t>> seen{seeds};
  for (int round = 0; round < rounds; ++round) {
    seeds = middles(surface, region, shapes, growth, seeds);
    if (!seen.insert(seeds).second) break;
    growth = grow(region, shapes, seeds);
  }
  smooth_borders(surface, region, growth);
  return growth;
}

}  // namespace wrapatlas
