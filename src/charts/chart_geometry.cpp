// Outline, area and overlap of one chart.
#include <fmt/format.h>

#include <cassert>

#include "charts/sweep_area.h"
#include "mesh/edge_groups.h"
#include "wrapatlas/charts.h"

namespace wrapatlas {
namespace {

/// Overlap below this share of a chart's area is a matter of rounding, and not reported.
constexpr double kHair = 1e-9;

// -1, 0 or 1 per triangle, and whether the chart as a whole is clockwise.
struct Orientation {
  std::vector<std::int8_t> of_triangle;
  bool clockwise = false;
  double absolute_area = 0;
};

Orientation orient(const Chart& chart) {
  Orientation orientation;
  orientation.of_triangle.reserve(chart.triangles.size());
  double sum = 0, absolute = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const double area = 0.5 * signed_area2(chart.points[a], chart.points[b], chart.points[c]);
    sum += area;
    absolute += std::abs(area);
    orientation.of_triangle.push_back(static_cast<std::int8_t>((area > 0) - (area < 0)));
  }
  orientation.clockwise = sum < 0;
  orientation.absolute_area = absolute;
  return orientation;
}

// Every triangle is walked in the majority's sense, so that winding numbers count the triangles
// over a point, and edges between neighbours cancel even where the chart is folded in parts.
std::vector<OutlineEdge> net_edges(const Chart& chart, const Orientation& orientation) {
  const std::int8_t majority = orientation.clockwise ? -1 : 1;
  std::vector<EdgeUse> uses;
  uses.reserve(3 * chart.triangles.size());
  for (std::uint32_t t = 0; t < chart.triangles.size(); ++t) {
    const bool turn = orientation.of_triangle[t] == -majority;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = chart.triangles[t][i], b = chart.triangles[t][(i + 1) % 3];
      if (a == b) continue;
      uses.push_back({std::min(a, b), std::max(a, b), t, (a > b) != turn});
    }
  }
  gather_edges(uses, chart.points.size());
  std::vector<OutlineEdge> outline;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    std::int32_t net = 0;
    for (const EdgeUse& use : edge) net += use.reversed ? -1 : 1;
    if (net > 0) outline.push_back({edge[0].low, edge[0].high, net});
    if (net < 0) outline.push_back({edge[0].high, edge[0].low, -net});
  });
  return outline;
}

void measure_extent(Chart& chart) {
  if (chart.box.empty()) return;
  const Vec2 centre = 0.5 * (chart.box.min + chart.box.max);
  double farthest = 0;  // squared
  const auto reach = [&](std::uint32_t p) {
    const Vec2 d = chart.points[p] - centre;
    farthest = std::max(farthest, dot(d, d));
  };
  for (const OutlineEdge& edge : chart.outline) reach(edge.from);
  for (const auto& triangle : chart.triangles) {
    for (const std::uint32_t p : triangle) reach(p);
  }
  chart.max_radius = std::sqrt(farthest);
}

/// The outline as both layers of a sweep, so that "shared" measures what it covers.
std::vector<SweepEdge> sweep_edges(const Chart& chart) {
  std::vector<SweepEdge> edges;
  edges.reserve(chart.outline.size());
  for (const OutlineEdge& e : chart.outline) {
    edges.push_back({chart.points[e.from], chart.points[e.to], {e.winding, e.winding}});
  }
  return edges;
}

}  // namespace

Chart chart_from_triangles(std::vector<Vec2> points,
                           std::vector<std::array<std::uint32_t, 3>> triangles) {
  Chart chart;
  chart.points = std::move(points);
  chart.triangles = std::move(triangles);
  for (const auto& triangle : chart.triangles) {
    for (const std::uint32_t p : triangle) {
      assert(p < chart.points.size());
      chart.box.add(chart.points[p]);
    }
  }
  const Orientation orientation = orient(chart);
  const std::int8_t majority = orientation.clockwise ? -1 : 1;
  for (std::uint32_t t = 0; t < chart.triangles.size(); ++t) {
    if (orientation.of_triangle[t] != majority) chart.against_grain.push_back(t);
  }
  chart.outline = net_edges(chart, orientation);
  measure_extent(chart);

  const double overlap = sweep_area(sweep_edges(chart), Measure::repeated, chart.box);
  if (overlap > kHair * orientation.absolute_area) chart.overlap = overlap;
  chart.area = orientation.absolute_area - chart.overlap;
  return chart;
}

Result<Chart> chart_from_loops(std::span<const std::vector<Vec2>> loops) {
  Chart chart;
  if (loops.empty()) {
    return Error{ErrorKind::input, "loops", "there are none", "give a chart at least one loop"};
  }
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    const std::vector<Vec2>& points = loops[loop];
    if (points.size() < 3) {
      return Error{ErrorKind::input, fmt::format("loop {}", loop),
                   fmt::format("it has {} points", points.size()),
                   "give every closed loop at least three points"};
    }
    const auto first = static_cast<std::uint32_t>(chart.points.size());
    const auto count = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec2 p = points[i];
      if (!(std::abs(p.x) < 1e30 && std::abs(p.y) < 1e30)) {
        return Error{ErrorKind::input, fmt::format("loop {}, point {}", loop, i),
                     "a coordinate is not a usable number",
                     "pass finite coordinates of magnitude below 1e30"};
      }
      chart.points.push_back(p);
      chart.box.add(p);
      chart.outline.push_back({first + i, first + (i + 1) % count, 1});
    }
  }
  const std::vector<SweepEdge> edges = sweep_edges(chart);
  chart.area = sweep_area(edges, Measure::shared, chart.box);
  const double overlap = sweep_area(edges, Measure::repeated, chart.box);
  if (overlap > kHair * chart.area) chart.overlap = overlap;
  measure_extent(chart);
  return chart;
}

}  // namespace wrapatlas
