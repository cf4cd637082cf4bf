#include "simplify/collapse_mesh.h"

#include <algorithm>

namespace wrapatlas {

CollapseMesh::CollapseMesh(const Surface& surface)
    : corners_(surface.corner_vertex.size()),
      vertex_corner_(surface.points.size(), kNone),
      mark_(surface.points.size(), 0),
      face_count_(static_cast<std::uint32_t>(surface.face_count())) {
  for (std::uint32_t c = 0; c < corners_.size(); ++c) {
    corners_[c] = {surface.corner_vertex[c], surface.corner_twin[c], kNone};
    std::uint32_t& known = vertex_corner_[corners_[c].vertex];
    const bool is_border = corners_[c].twin == kNone;
    if (known == kNone || is_border) known = c;
    if (is_border) is_closed_ = false;
  }
  number_edges();
}

void CollapseMesh::number_edges() {
  for (std::uint32_t c = 0; c < corners_.size(); ++c) {
    if (corners_[c].edge != kNone) continue;
    const auto number = static_cast<std::uint32_t>(edge_corner_.size());
    edge_corner_.push_back(c);
    corners_[c].edge = number;
    if (twin(c) != kNone) corners_[twin(c)].edge = number;
  }
}

bool CollapseMesh::can_collapse(std::uint32_t c) {
  const std::uint32_t a = vertex(c), b = vertex(next(c)), t = twin(c);
  const bool a_at_border = is_border(a), b_at_border = is_border(b);
  if (t != kNone && a_at_border && b_at_border) return false;  // a bridge
  if (t == kNone && twin(next(c)) == kNone && twin(previous(c)) == kNone) return false;
  ++stamp_;
  int a_edges = 0, b_edges = 0, common = 0;
  each_edge(a, [&](std::uint32_t u, std::uint32_t) {
    mark_[u] = stamp_;
    ++a_edges;
  });
  each_edge(b, [&](std::uint32_t u, std::uint32_t) {
    common += mark_[u] == stamp_ ? 1 : 0;
    ++b_edges;
  });
  if (common != (t == kNone ? 1 : 2)) return false;
  const bool tetrahedron = a_edges == 3 && b_edges == 3 && !a_at_border && !b_at_border;
  return !tetrahedron;
}

std::array<std::uint32_t, 3> CollapseMesh::collapse(std::uint32_t c) {
  const std::uint32_t a = vertex(c), b = vertex(next(c)), t = twin(c);
  if (is_border(b)) vertex_corner_[a] = vertex_corner_[b];  // a is at a border from now on
  each_corner(b, [&](std::uint32_t corner) { corners_[corner].vertex = a; });
  const std::array<std::uint32_t, 3> gone{edge(c), close_face(c),
                                          t == kNone ? kNone : close_face(t)};
  std::uint32_t at_a = kNone;
  for (const std::uint32_t side : {c, t}) {
    if (side == kNone) continue;
    // What is left beside the face: corners at its third vertex and at a.
    const std::uint32_t after = twin(next(side)), before = twin(previous(side));
    anchor(opposite(side), after != kNone ? after : next(before));
    at_a = before != kNone ? before : next(after);
    for (const std::uint32_t k : {side, next(side), previous(side)}) corners_[k].vertex = kNone;
    --face_count_;
  }
  anchor(a, at_a);
  vertex_corner_[b] = kNone;
  edge_corner_[gone[0]] = kNone;
  return gone;
}

/// Joins what lies beyond the two other edges of the face; the number of the edge that is gone.
std::uint32_t CollapseMesh::close_face(std::uint32_t c) {
  const std::uint32_t a = twin(next(c)), b = twin(previous(c));
  const auto [kept, gone] = std::minmax({edge(next(c)), edge(previous(c))});
  if (a != kNone) corners_[a] = {vertex(a), b, kept};
  if (b != kNone) corners_[b] = {vertex(b), a, kept};
  edge_corner_[kept] = a != kNone ? a : b;
  edge_corner_[gone] = kNone;
  return gone;
}

/// Makes the vertex known by the corner, or by the one at its border if it is known by that.
void CollapseMesh::anchor(std::uint32_t v, std::uint32_t corner) {
  std::uint32_t c = corner;
  if (is_border(v)) {
    while (twin(c) != kNone) c = next(twin(c));
  }
  vertex_corner_[v] = c;
}

bool CollapseMesh::has_double_edge(std::uint32_t v) {
  ++stamp_;
  bool found = false;
  each_edge(v, [&](std::uint32_t u, std::uint32_t) {
    found = found || mark_[u] == stamp_;
    mark_[u] = stamp_;
  });
  return found;
}

}  // namespace wrapatlas
