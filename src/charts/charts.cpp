// From a mesh to its charts.
#include "wrapatlas/charts.h"

#include "charts/face_cover.h"
#include "charts/stacked.h"
#include "charts/uv_vertices.h"
#include "mesh/edge_groups.h"
#include "mesh/union_find.h"

namespace wrapatlas {
namespace {

/// A count of stacked charts is information only: it may cost this many outline edges.
constexpr double kMostStackedSteps = 3e6;

/// Where it decides what is packed, only a hostile input reaches the end of the search.
constexpr double kMostKeepSteps = 1e8;

/// A chart this thin (area / radius^2) has no area to speak of.
constexpr double kDegenerate = 1e-12;

std::uint32_t number_charts(const Mesh& mesh, const UvVertices& vertices, ChartSet& set) {
  std::vector<EdgeUse> uses;
  uses.reserve(mesh.corner_count());
  const auto face_count = static_cast<std::uint32_t>(mesh.face_count());
  for (std::uint32_t face = 0; face < face_count; ++face) {
    const std::uint32_t begin = mesh.face_begin[face], size = mesh.face_size(face);
    if (vertices.of_corner[begin] == kNone) continue;
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = vertices.of_corner[begin + i];
      const std::uint32_t b = vertices.of_corner[begin + (i + 1) % size];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), face, a > b});
    }
  }
  gather_edges(uses, vertices.position.size());
  UnionFind connected(face_count);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge) connected.unite(edge[0].face, use.face);
  });

  set.face_chart.assign(face_count, kNone);
  std::uint32_t charts = 0;
  for (std::uint32_t face = 0; face < face_count; ++face) {
    if (vertices.of_corner[mesh.face_begin[face]] == kNone) continue;
    const std::uint32_t root = connected.find(face);
    set.face_chart[face] = root == face ? charts++ : set.face_chart[root];
  }
  return charts;
}

std::vector<std::vector<std::uint32_t>> faces_of_charts(const ChartSet& set, std::uint32_t charts) {
  std::vector<std::uint32_t> count(charts, 0);
  for (const std::uint32_t chart : set.face_chart) {
    if (chart != kNone) ++count[chart];
  }
  std::vector<std::vector<std::uint32_t>> faces(charts);
  for (std::uint32_t chart = 0; chart < charts; ++chart) faces[chart].reserve(count[chart]);
  for (std::uint32_t face = 0; face < set.face_chart.size(); ++face) {
    if (set.face_chart[face] != kNone) faces[set.face_chart[face]].push_back(face);
  }
  return faces;
}

void make_charts(const Mesh& mesh, const UvVertices& vertices, std::uint32_t charts,
                 ChartSet& set) {
  set.corner_point.assign(mesh.corner_count(), kNone);
  std::vector<std::uint32_t> owner(vertices.position.size(), kNone), local(owner.size());
  std::vector<Vec2> corners;
  std::vector<std::array<std::uint32_t, 3>> cut;
  const auto faces = faces_of_charts(set, charts);
  set.charts.reserve(charts);
  for (std::uint32_t chart = 0; chart < charts; ++chart) {
    std::vector<Vec2> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const std::uint32_t face : faces[chart]) {
      const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
      corners.clear();
      for (std::uint32_t c = begin; c < end; ++c) {
        const std::uint32_t v = vertices.of_corner[c];
        if (owner[v] != chart) {
          owner[v] = chart;
          local[v] = static_cast<std::uint32_t>(points.size());
          points.push_back(vertices.uv[v]);
        }
        set.corner_point[c] = local[v];
        corners.push_back(vertices.uv[v]);
      }
      cut.clear();
      if (cover_face(corners, cut) && set.crossing_faces++ == 0) set.first_crossing_face = face;
      for (const auto& [i, j, k] : cut) {
        triangles.push_back({set.corner_point[begin + i], set.corner_point[begin + j],
                             set.corner_point[begin + k]});
      }
    }
    set.charts.push_back(chart_from_triangles(std::move(points), std::move(triangles)));
  }
}

Chart concatenate(std::span<const Chart> charts, std::span<const std::uint32_t> members,
                  std::vector<std::uint32_t>& point_offset) {
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const std::uint32_t member : members) {
    const Chart& chart = charts[member];
    const auto offset = static_cast<std::uint32_t>(points.size());
    point_offset[member] = offset;
    points.insert(points.end(), chart.points.begin(), chart.points.end());
    for (const auto& [a, b, c] : chart.triangles) {
      triangles.push_back({a + offset, b + offset, c + offset});
    }
  }
  return chart_from_triangles(std::move(points), std::move(triangles));
}

void count_stacked(ChartSet& set) {
  auto [groups, complete] = group_stacked(set.charts, kMostStackedSteps);
  set.all_stacks_found = complete;
  std::vector<std::uint32_t> size(set.charts.size(), 0);
  for (std::uint32_t i = 0; i < size.size(); ++i) ++size[groups.find(i)];
  for (const std::uint32_t n : size) set.stacked += n > 1 ? n : 0;
}

void keep_stacks(const Mesh& mesh, ChartSet& set) {
  const auto count = static_cast<std::uint32_t>(set.charts.size());
  auto [groups, complete] = group_stacked(set.charts, kMostKeepSteps);
  set.all_stacks_found = complete;
  std::vector<std::uint32_t> stack_of(count), point_offset(count, 0);
  std::vector<std::vector<std::uint32_t>> stacks;
  for (std::uint32_t chart = 0; chart < count; ++chart) {
    const std::uint32_t root = groups.find(chart);
    if (root == chart) stacks.emplace_back();
    stack_of[chart] =
        root == chart ? static_cast<std::uint32_t>(stacks.size() - 1) : stack_of[root];
    stacks[stack_of[chart]].push_back(chart);
  }
  std::vector<Chart> merged;
  merged.reserve(stacks.size());
  for (const auto& members : stacks) {
    if (members.size() == 1) {
      merged.push_back(std::move(set.charts[members[0]]));
      continue;
    }
    set.stacked += static_cast<std::uint32_t>(members.size());
    merged.push_back(concatenate(set.charts, members, point_offset));
  }
  set.charts = std::move(merged);
  for (std::size_t face = 0; face < set.face_chart.size(); ++face) {
    if (set.face_chart[face] == kNone) continue;
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      set.corner_point[c] += point_offset[set.face_chart[face]];
    }
    set.face_chart[face] = stack_of[set.face_chart[face]];
  }
}

}  // namespace

double ChartSet::total_area() const {
  double sum = 0;
  for (const Chart& chart : charts) sum += chart.area;
  return sum;
}

Result<ChartSet> build_charts(const Mesh& mesh, Stacked stacked) {
  const UvVertices vertices = find_uv_vertices(mesh);
  if (vertices.position.empty()) {
    return Error{ErrorKind::input, "mesh", "no face has texture coordinates",
                 "export it with UVs, or unwrap it first"};
  }
  ChartSet set;
  set.faces_without_uv = vertices.faces_without_uv;
  make_charts(mesh, vertices, number_charts(mesh, vertices, set), set);
  for (const Chart& chart : set.charts) {
    if (chart.overlap > 0) ++set.self_overlapping;
    if (chart.area <= kDegenerate * chart.max_radius * chart.max_radius) ++set.degenerate;
  }
  if (stacked == Stacked::keep) {
    keep_stacks(mesh, set);
  } else {
    count_stacked(set);
  }
  return set;
}

}  // namespace wrapatlas
