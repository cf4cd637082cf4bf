// From polygons to a manifold: pairs of faces at edges, one winding, a vertex for each fan.
#include "wrapatlas/surface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mesh/edge_groups.h"
#include "mesh/polygon_plane.h"
#include "mesh/same_uv.h"
#include "mesh/union_find.h"

namespace wrapatlas {
namespace {

class SurfaceBuilder {
 public:
  SurfaceBuilder(const Mesh& mesh, const SurfaceOptions& options)
      : mesh_(mesh), options_(options), welded_(weld_corners(mesh)) {}

  Surface build() {
    twin_.assign(mesh_.corner_count(), kNone);
    leave_out_folded_faces();
    pair_edges();
    wind_alike();
    count_shared_points();
    part();
    copy_faces();
    number_vertices();
    triangulate();
    return std::move(surface_);
  }

 private:
  [[nodiscard]] std::uint32_t next(std::uint32_t corner) const {
    const std::uint32_t face = corner_face_[corner];
    return corner + 1 == mesh_.face_begin[face + 1] ? mesh_.face_begin[face] : corner + 1;
  }

  void leave_out_folded_faces() {
    const auto count = static_cast<std::uint32_t>(mesh_.face_count());
    is_folded_.assign(count, false);
    normal_.resize(count);
    corner_face_.resize(mesh_.corner_count());
    std::vector<std::uint32_t> points;
    for (std::uint32_t face = 0; face < count; ++face) {
      const std::uint32_t begin = mesh_.face_begin[face], end = mesh_.face_begin[face + 1];
      std::fill(corner_face_.begin() + begin, corner_face_.begin() + end, face);
      points.assign(welded_.of_corner.begin() + begin, welded_.of_corner.begin() + end);
      std::sort(points.begin(), points.end());
      is_folded_[face] = std::adjacent_find(points.begin(), points.end()) != points.end();
      normal_[face] = polygon_normal(mesh_, face);
      if (is_folded_[face]) surface_.folded_faces.push_back(face);
      if (!is_folded_[face] && normal_[face] == Vec3{}) ++surface_.report.flat_faces;
    }
    surface_.report.folded_faces = static_cast<std::uint32_t>(surface_.folded_faces.size());
  }

  void pair_edges() {
    std::vector<EdgeUse> uses;
    uses.reserve(mesh_.corner_count());
    for (std::uint32_t c = 0; c < mesh_.corner_count(); ++c) {
      if (is_folded_[corner_face_[c]]) continue;
      const std::uint32_t a = welded_.of_corner[c], b = welded_.of_corner[next(c)];
      uses.push_back({std::min(a, b), std::max(a, b), c, a > b});  // a corner in place of a face
    }
    gather_edges(uses, welded_.count);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2) pair_two(edge[0], edge[1]);
      if (edge.size() > 2) pair_crowded(edge);
    });
    count_duplicates();
  }

  void join(std::uint32_t a, std::uint32_t b) {
    twin_[a] = b;
    twin_[b] = a;
  }

  /// A face that lies on its neighbour is the back of it, or its double: the surface ends there.
  [[nodiscard]] static bool folds_back(double cosine) { return cosine < 1e-6 - 1; }

  [[nodiscard]] double cosine(std::uint32_t a, std::uint32_t b) const {
    return dot(unit(normal_[corner_face_[a]]), unit(normal_[corner_face_[b]]));
  }

  void pair_two(const EdgeUse& a, const EdgeUse& b) {
    const double sign = a.reversed == b.reversed ? -1 : 1;
    if (folds_back(sign * cosine(a.face, b.face))) {
      ++folded_edges_;
    } else {
      join(a.face, b.face);
    }
  }

  /// Faces that walk the edge in opposite directions go on in each other, the flattest pair first;
  /// what is left is border.
  void pair_crowded(std::span<const EdgeUse> edge) {
    ++surface_.report.crowded_edges;
    struct Pair {
      double bend;
      std::uint32_t a, b;
    };
    std::vector<Pair> pairs;
    constexpr std::size_t kMostCompared = 64;  // an edge of thousands of faces is no surface
    const std::size_t count = std::min(edge.size(), kMostCompared);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        if (edge[i].reversed == edge[j].reversed) continue;
        const std::uint32_t a = edge[i].face, b = edge[j].face;
        if (!folds_back(cosine(a, b))) pairs.push_back({-cosine(a, b), a, b});
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.bend < b.bend; });
    for (const Pair& pair : pairs) {
      if (twin_[pair.a] == kNone && twin_[pair.b] == kNone) join(pair.a, pair.b);
    }
  }

  void count_duplicates() {
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> seen;
    std::vector<std::uint32_t> points, other;
    const auto points_of = [&](std::uint32_t face, std::vector<std::uint32_t>& sorted) {
      sorted.assign(welded_.of_corner.begin() + mesh_.face_begin[face],
                    welded_.of_corner.begin() + mesh_.face_begin[face + 1]);
      std::sort(sorted.begin(), sorted.end());
    };
    // Without edges that are crowded or fold back, two faces cannot have all their edges in common.
    if (surface_.report.crowded_edges + folded_edges_ == 0) return;
    for (std::uint32_t face = 0; face < mesh_.face_count(); ++face) {
      if (is_folded_[face]) continue;
      points_of(face, points);
      std::uint64_t hash = 0;
      for (const std::uint32_t point : points) hash = (hash ^ point) * 0x9e3779b97f4a7c15ULL;
      auto& faces = seen[hash];
      const bool known = std::any_of(faces.begin(), faces.end(), [&](std::uint32_t earlier) {
        points_of(earlier, other);
        return other == points;
      });
      if (known) ++surface_.report.duplicate_faces;
      if (!known) faces.push_back(face);
    }
  }

  /// Walks over each component and turns faces, so that neighbours walk their edge in opposite
  /// directions; the smaller part is turned.
  void wind_alike() {
    const auto count = static_cast<std::uint32_t>(mesh_.face_count());
    is_turned_.assign(count, false);
    std::vector<bool> reached(count, false);
    std::vector<std::uint32_t> component;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
      if (reached[seed] || is_folded_[seed]) continue;
      ++surface_.report.components;
      component.assign(1, seed);
      reached[seed] = true;
      std::size_t turned = 0;
      for (std::size_t i = 0; i < component.size(); ++i) {
        const std::uint32_t face = component[i];
        turned += is_turned_[face] ? 1 : 0;
        for (std::uint32_t c = mesh_.face_begin[face]; c < mesh_.face_begin[face + 1]; ++c) {
          if (twin_[c] == kNone) continue;
          const std::uint32_t other = corner_face_[twin_[c]];
          const bool same_way = welded_.of_corner[c] == welded_.of_corner[twin_[c]];
          const bool turn = is_turned_[face] != same_way;
          if (!reached[other]) {
            reached[other] = true;
            is_turned_[other] = turn;
            component.push_back(other);
          } else if (is_turned_[other] != turn) {
            twin_[twin_[c]] = kNone;
            twin_[c] = kNone;
            ++surface_.report.one_sided_edges;
          }
        }
      }
      const bool all = 2 * turned > component.size();
      for (const std::uint32_t face : component) is_turned_[face] = is_turned_[face] != all;
      surface_.report.turned_faces +=
          static_cast<std::uint32_t>(all ? component.size() - turned : turned);
    }
  }

  /// Points with more than one fan of faces around them.
  void count_shared_points() {
    UnionFind fans(static_cast<std::uint32_t>(twin_.size()));
    for (std::uint32_t c = 0; c < twin_.size(); ++c) {
      const std::uint32_t t = twin_[c];
      if (t == kNone) continue;
      const bool same_way = welded_.of_corner[c] == welded_.of_corner[t];
      fans.unite(c, same_way ? t : next(t));
      fans.unite(next(c), same_way ? next(t) : t);
    }
    std::vector<std::uint32_t> fans_at(welded_.count, 0);
    for (std::uint32_t c = 0; c < twin_.size(); ++c) {
      if (is_folded_[corner_face_[c]] || fans.find(c) != c) continue;
      if (++fans_at[welded_.of_corner[c]] == 2) ++surface_.report.shared_points;
    }
  }

  /// The edges that the caller wants to be borders.
  void part() {
    const double least_cosine = options_.hard_angle < 0 ? -2 : std::cos(options_.hard_angle);
    for (std::uint32_t c = 0; c < twin_.size(); ++c) {
      if (twin_[c] == kNone || twin_[c] < c) continue;
      if (!is_hard(c, least_cosine) && !is_uv_seam(c) && !is_label_border(c)) continue;
      twin_[twin_[c]] = kNone;
      twin_[c] = kNone;
    }
  }

  [[nodiscard]] bool is_hard(std::uint32_t c, double least_cosine) const {
    if (least_cosine < -1) return false;
    const std::uint32_t a = corner_face_[c], b = corner_face_[twin_[c]];
    if (normal_[a] == Vec3{} || normal_[b] == Vec3{}) return false;
    const double sign = is_turned_[a] == is_turned_[b] ? 1 : -1;
    return sign * dot(unit(normal_[a]), unit(normal_[b])) < least_cosine;
  }

  [[nodiscard]] bool is_uv_seam(std::uint32_t c) const {
    if (!options_.uv_seams) return false;
    const std::uint32_t t = twin_[c];
    const bool same_way = welded_.of_corner[c] == welded_.of_corner[t];
    return !same_uv(mesh_, c, same_way ? t : next(t)) ||
           !same_uv(mesh_, next(c), same_way ? next(t) : t);
  }

  [[nodiscard]] bool is_label_border(std::uint32_t c) const {
    return !options_.face_labels.empty() &&
           options_.face_labels[corner_face_[c]] != options_.face_labels[corner_face_[twin_[c]]];
  }

  /// The corner of the surface whose edge is the one of corner c of the mesh.
  [[nodiscard]] std::uint32_t edge_in_surface(std::uint32_t c) const {
    const std::uint32_t face = corner_face_[c];
    const std::uint32_t size = mesh_.face_size(face), begin = first_corner_[face];
    const std::uint32_t i = c - mesh_.face_begin[face];
    return begin + (is_turned_[face] ? (2 * size - 2 - i) % size : i);
  }

  void copy_faces() {
    first_corner_.assign(mesh_.face_count(), kNone);
    std::uint32_t corners = 0;
    for (std::uint32_t face = 0; face < mesh_.face_count(); ++face) {
      if (is_folded_[face]) continue;
      const std::uint32_t size = mesh_.face_size(face), begin = mesh_.face_begin[face];
      first_corner_[face] = corners;
      for (std::uint32_t i = 0; i < size; ++i) {
        surface_.corner_source.push_back(begin + (is_turned_[face] ? size - 1 - i : i));
        surface_.corner_face.push_back(static_cast<std::uint32_t>(surface_.face_source.size()));
      }
      surface_.face_source.push_back(face);
      corners += size;
      surface_.face_begin.push_back(corners);
    }
    surface_.corner_twin.assign(corners, kNone);
    for (std::uint32_t c = 0; c < twin_.size(); ++c) {
      if (is_folded_[corner_face_[c]]) continue;
      if (twin_[c] == kNone) {
        ++surface_.report.border_edges;
      } else {
        surface_.corner_twin[edge_in_surface(c)] = edge_in_surface(twin_[c]);
      }
    }
  }

  void number_vertices() {
    const auto corners = static_cast<std::uint32_t>(surface_.corner_source.size());
    UnionFind fans(corners);
    for (std::uint32_t c = 0; c < corners; ++c) {
      const std::uint32_t t = surface_.corner_twin[c];
      if (t != kNone) fans.unite(c, surface_.next(t));
    }
    surface_.corner_vertex.resize(corners);
    for (std::uint32_t c = 0; c < corners; ++c) {
      const std::uint32_t root = fans.find(c), source = surface_.corner_source[c];
      if (root != c) {
        surface_.corner_vertex[c] = surface_.corner_vertex[root];
        continue;
      }
      surface_.corner_vertex[c] = static_cast<std::uint32_t>(surface_.points.size());
      surface_.points.push_back(mesh_.positions[mesh_.corner_position[source]]);
    }
  }

  /// The corner of the face, from 0 on, that is the first one in the file.
  [[nodiscard]] std::uint32_t first_in_file(std::uint32_t face) const {
    const std::uint32_t source = surface_.face_source[face];
    return is_turned_[source] ? mesh_.face_size(source) - 1 : 0;
  }

  /// As most programs cut polygons, so that what is unflipped here is so there. False if a triangle
  /// would lie outside the polygon.
  static bool cut_as_fan(std::span<const Vec2> points, std::uint32_t first,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const auto size = static_cast<std::uint32_t>(points.size());
    double sign = 0;
    for (std::uint32_t k = 1; k + 1 < size; ++k) {
      const std::uint32_t a = (first + k) % size, b = (first + k + 1) % size;
      const double area = signed_area2(points[first], points[a], points[b]);
      if (size > 3 && (area == 0 || area * sign < 0)) {
        triangles.clear();
        return false;
      }
      sign = area;
      triangles.push_back({first, a, b});
    }
    return true;
  }

  void triangulate() {
    surface_.triangle_begin.assign(1, 0);
    std::vector<Vec2> flat;
    std::vector<std::array<std::uint32_t, 3>> cut;
    for (std::uint32_t face = 0; face < surface_.face_count(); ++face) {
      const std::uint32_t begin = surface_.face_begin[face], end = surface_.face_begin[face + 1];
      cut.clear();
      flat.resize(end - begin);
      if (flat.size() > 3) {
        const Plane plane(normal_[surface_.face_source[face]]);
        for (std::uint32_t c = begin; c < end; ++c) {
          flat[c - begin] = plane.project(surface_.points[surface_.corner_vertex[c]]);
        }
      }
      if (!cut_as_fan(flat, first_in_file(face), cut)) triangulate_polygon(flat, cut);
      for (const auto& [i, j, k] : cut) {
        surface_.triangles.push_back({begin + i, begin + j, begin + k});
      }
      surface_.triangle_begin.push_back(static_cast<std::uint32_t>(surface_.triangles.size()));
    }
  }

  const Mesh& mesh_;
  const SurfaceOptions& options_;
  WeldedCorners welded_;
  std::vector<std::uint32_t> twin_, corner_face_;  // of the mesh's corners
  std::vector<bool> is_folded_, is_turned_;        // of its faces
  std::vector<Vec3> normal_;                       // of its faces, as they are wound there
  std::vector<std::uint32_t> first_corner_;        // in the surface
  std::size_t folded_edges_ = 0;
  Surface surface_;
};

}  // namespace

Result<Surface> build_surface(const Mesh& mesh, const SurfaceOptions& options) {
  if (!options.face_labels.empty() && options.face_labels.size() != mesh.face_count()) {
    return Error{ErrorKind::usage, "face labels", "some faces have none",
                 "pass one for each face, or none at all"};
  }
  return SurfaceBuilder(mesh, options).build();
}

}  // namespace wrapatlas
