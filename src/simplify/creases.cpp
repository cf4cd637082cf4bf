#include "simplify/creases.h"

#include <algorithm>

#include "mesh/same_uv.h"

namespace wrapatlas {

Creases::Creases(const Mesh& triangles, const Surface& surface, CollapseMesh& mesh,
                 bool keep_uv_seams)
    : kind_(surface.points.size(), Kind::free) {
  if (keep_uv_seams) find_seams(triangles, surface, mesh);
  if (surface.report.shared_points > 0) fix_shared_points(triangles, surface);
  fix_double_edges(mesh);
  const auto is_free = [](Kind kind) { return kind == Kind::free; };
  all_free_ = std::all_of(kind_.begin(), kind_.end(), is_free);
}

/// Sheets that meet in a point have a vertex each there, and would part.
void Creases::fix_shared_points(const Mesh& triangles, const Surface& surface) {
  const WeldedCorners welded = weld_corners(triangles);
  std::vector<std::uint32_t> first(welded.count, kNone);
  first_at_point_.assign(kind_.size(), kNone);
  for (std::uint32_t c = 0; c < surface.corner_vertex.size(); ++c) {
    const std::uint32_t v = surface.corner_vertex[c];
    std::uint32_t& known = first[welded.of_corner[surface.corner_source[c]]];
    if (known == kNone) known = v;
    if (known != v) kind_[known] = kind_[v] = Kind::fixed;
    first_at_point_[v] = known;
  }
}

/// Where faces of a crowded edge were paired, two edges may join the same vertices.
void Creases::fix_double_edges(CollapseMesh& mesh) {
  for (std::uint32_t v = 0; v < kind_.size(); ++v) {
    if (mesh.has_double_edge(v)) kind_[v] = Kind::fixed;
  }
}

void Creases::find_seams(const Mesh& triangles, const Surface& surface, const CollapseMesh& mesh) {
  is_seam_.assign(mesh.edge_numbers(), 0);
  std::vector<std::uint32_t> seams_at(kind_.size(), 0);
  const auto source = [&](std::uint32_t c) { return surface.corner_source[c]; };
  for (std::uint32_t c = 0; c < surface.corner_vertex.size(); ++c) {
    const std::uint32_t t = surface.corner_twin[c];
    if (t == kNone || t < c) continue;
    if (same_uv(triangles, source(c), source(surface.next(t))) &&
        same_uv(triangles, source(surface.next(c)), source(t))) {
      continue;
    }
    is_seam_[mesh.edge(c)] = 1;
    ++seams_at[mesh.vertex(c)];
    ++seams_at[mesh.vertex(t)];
  }
  for (std::uint32_t v = 0; v < kind_.size(); ++v) {
    if (seams_at[v] == 0) continue;
    kind_[v] = seams_at[v] == 2 && !mesh.is_border(v) ? Kind::seam : Kind::fixed;
  }
}

bool Creases::allow(const CollapseMesh& mesh, std::uint32_t c) const {
  if (all_free_) return true;
  const Kind a = kind_[mesh.vertex(c)], b = kind_[mesh.vertex(CollapseMesh::next(c))];
  if (a == Kind::fixed || a != b) return false;
  return a == Kind::free || is_seam_[mesh.edge(c)] != 0;
}

bool Creases::closes_chart(const CollapseMesh& mesh, std::uint32_t c) const {
  if (is_seam_.empty()) return false;
  const auto closes = [&](std::uint32_t side) {
    return side != kNone && is_seam_[mesh.edge(CollapseMesh::next(side))] != 0 &&
           is_seam_[mesh.edge(CollapseMesh::previous(side))] != 0;
  };
  return closes(c) || closes(mesh.twin(c));
}

void Creases::before_collapse(const CollapseMesh& mesh, std::uint32_t c) {
  if (is_seam_.empty()) return;
  for (const std::uint32_t side : {c, mesh.twin(c)}) {
    if (side == kNone) continue;
    const std::uint32_t e = mesh.edge(CollapseMesh::next(side));
    const std::uint32_t f = mesh.edge(CollapseMesh::previous(side));
    is_seam_[e] = is_seam_[f] = std::max(is_seam_[e], is_seam_[f]);
  }
}

std::uint32_t Creases::fixed_count() const {
  return static_cast<std::uint32_t>(std::count(kind_.begin(), kind_.end(), Kind::fixed));
}

}  // namespace wrapatlas
