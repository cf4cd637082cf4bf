#include "atlas/edge_cuts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/edge_groups.h"

namespace wrapatlas {
namespace {

std::uint32_t next_corner(const Mesh& mesh, std::size_t face, std::uint32_t corner) {
  return corner + 1 == mesh.face_begin[face + 1] ? mesh.face_begin[face] : corner + 1;
}

void cross_axis(double a, double b, int axis, std::vector<Crossing>& crossings) {
  const double low = std::min(a, b), high = std::max(a, b);
  // The UVs are those of an atlas, so that they are small.
  for (int line = static_cast<int>(std::floor(low)) + 1; line < high; ++line) {
    const double t = (line - a) / (b - a);
    if (0 < t && t < 1) crossings.push_back({t, axis, double(line)});
  }
}

}  // namespace

void find_crossings(Vec2 a, Vec2 b, Wrap wrap, std::vector<Crossing>& crossings) {
  if (wraps_u(wrap)) cross_axis(a.x, b.x, 0, crossings);
  if (wraps_v(wrap)) cross_axis(a.y, b.y, 1, crossings);
}

EdgeCuts::EdgeCuts(const Mesh& mesh, const ChartSet& charts, const std::vector<Vec2>& corner_uv,
                   Wrap wrap)
    : mesh_(mesh), welded_(weld_corners(mesh)) {
  std::vector<std::uint32_t> next(mesh.corner_count());
  std::vector<bool> has_uv(mesh.corner_count());
  std::vector<bool> cut_begins(welded_.count, false);  // the lower end of a cut edge
  std::vector<Crossing> crossings;
  bool any = false;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      next[c] = next_corner(mesh, face, c);
      has_uv[c] = charts.face_chart[face] != kNone;
      if (!has_uv[c]) continue;
      find_crossings(corner_uv[c], corner_uv[next[c]], wrap, crossings);
      if (crossings.empty()) continue;
      crossings.clear();
      any = true;
      cut_begins[std::min(welded(c), welded(next[c]))] = true;
    }
  }
  if (!any) return;
  std::vector<EdgeUse> uses;  // `face` holds the corner at which the side begins
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
    const std::uint32_t a = welded(c), b = welded(next[c]);
    if (cut_begins[std::min(a, b)]) uses.push_back({std::min(a, b), std::max(a, b), c, a > b});
  }
  begin_.assign(mesh.corner_count(), 0);
  end_.assign(mesh.corner_count(), 0);
  gather_edges(uses, welded_.count);

  std::vector<double> ts;
  std::vector<std::uint32_t> sides;
  const auto add_side = [&](std::uint32_t c) {
    sides.push_back(c);
    if (!has_uv[c]) return;
    crossings.clear();
    const bool forward = canonical(c, next[c]);
    const std::uint32_t from = forward ? c : next[c], to = forward ? next[c] : c;
    find_crossings(corner_uv[from], corner_uv[to], wrap, crossings);
    for (const Crossing& crossing : crossings) ts.push_back(crossing.t);
  };
  const auto finish = [&] {
    std::sort(ts.begin(), ts.end());
    if (!ts.empty()) cut_edge(sides, ts);
    sides.clear();
    ts.clear();
  };
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge) {
      add_side(use.face);
      if (use.low == use.high) finish();  // no length in space: nothing to share
    }
    finish();
  });
}

void EdgeCuts::cut_edge(std::span<const std::uint32_t> sides, const std::vector<double>& ts) {
  const auto begin = static_cast<std::uint32_t>(points_.size());
  for (const double t : ts) {
    const bool first = points_.size() == begin;
    if (first || t - points_.back().t > kSamePlace) points_.push_back({t, position_count_++});
  }
  for (const std::uint32_t side : sides) {
    begin_[side] = begin;
    end_[side] = static_cast<std::uint32_t>(points_.size());
  }
}

std::span<const EdgePoint> EdgeCuts::on_side(std::size_t corner) const {
  if (begin_.empty()) return {};
  return std::span(points_).subspan(begin_[corner], end_[corner] - begin_[corner]);
}

bool EdgeCuts::canonical(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t pa = welded(a), pb = welded(b);
  if (pa != pb) return pa < pb;
  if (mesh_.corner_texcoord[a] == kNone || mesh_.corner_texcoord[b] == kNone) return a < b;
  const Vec2 ua = mesh_.texcoords[mesh_.corner_texcoord[a]];
  const Vec2 ub = mesh_.texcoords[mesh_.corner_texcoord[b]];
  return std::tie(ua.x, ua.y, a) < std::tie(ub.x, ub.y, b);
}

}  // namespace wrapatlas
