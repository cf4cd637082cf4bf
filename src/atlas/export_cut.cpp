// Faces are cut triangle by triangle of the triangulation their chart was made with, so that every
// piece is convex, lies in the plane of its triangle, and shows what the whole face would show.
#include <cmath>

#include "atlas/chart_uvs.h"
#include "atlas/cut_texcoords.h"
#include "atlas/edge_cuts.h"
#include "atlas/split_triangle.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas {
namespace {

double snapped(double value) {
  const double nearest = std::round(value);
  return std::abs(value - nearest) <= kSamePlace ? nearest : value;
}

Vec2 snapped(Vec2 uv, Wrap wrap) {
  return {wraps_u(wrap) ? snapped(uv.x) : uv.x, wraps_v(wrap) ? snapped(uv.y) : uv.y};
}

double local(double value, double period, bool wraps) {
  if (wraps) return value - period;
  return value > -kOutside && value < 1 + kOutside ? std::clamp(value, 0.0, 1.0) : value;
}

std::vector<Vec2> uv_of_corners(const Mesh& mesh, const ChartSet& charts, const Packing& packing,
                                bool v_points_down) {
  std::vector<std::vector<Vec2>> of_chart;
  for (std::size_t chart = 0; chart < charts.charts.size(); ++chart) {
    of_chart.push_back(atlas_uvs(charts.charts[chart], packing, chart, v_points_down));
    for (Vec2& uv : of_chart.back()) uv = snapped(uv, packing.wrap);
  }
  std::vector<Vec2> uvs(mesh.corner_count());
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    if (charts.face_chart[face] == kNone) continue;
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      uvs[c] = of_chart[charts.face_chart[face]][charts.corner_point[c]];
    }
  }
  return uvs;
}

class CutExporter {
 public:
  CutExporter(const Mesh& mesh, const ChartSet& charts, const Packing& packing, bool v_points_down)
      : mesh_(mesh),
        charts_(charts),
        wrap_(packing.wrap),
        corner_uv_(uv_of_corners(mesh, charts, packing, v_points_down)),
        edge_cuts_(mesh, charts, corner_uv_, wrap_),
        texcoords_(charts, atlas_.texcoords),
        next_position_(edge_cuts_.position_count()) {
    add_tiles(packing, v_points_down);
  }

  AtlasMesh run() {
    for (face_ = 0; face_ < mesh_.face_count(); ++face_) {
      if (charts_.face_chart[face_] != kNone && touches_border()) {
        split_face();
      } else {
        whole_face();
      }
    }
    atlas_.cut_position_count = next_position_;
    return std::move(atlas_);
  }

 private:
  /// UVs leave [0,1] where there are tiles beyond.
  void add_tiles(const Packing& packing, bool v_points_down) {
    atlas_.pages = packing.pages;
    bool beyond_u = false, beyond_v = false;
    for (std::size_t chart = 0; chart < charts_.charts.size(); ++chart) {
      tiles_.push_back(tile_offset(packing, chart, v_points_down));
      beyond_u = beyond_u || tiles_.back().x != 0;
      beyond_v = beyond_v || tiles_.back().y != 0;
    }
    atlas_.wrap = wrap_on(beyond_u, beyond_v);
  }

  /// The points of a triangle's side that lies inside its polygon, for the triangle behind it.
  struct Diagonal {
    std::uint32_t from, to;
    std::vector<EdgePoint> points;
    std::uint32_t first_cut;
  };

  // Whether a side is cut, or the border runs through the face from vertex to vertex.
  [[nodiscard]] bool touches_border() const {
    Box2 box;
    for (std::uint32_t c = mesh_.face_begin[face_]; c < mesh_.face_begin[face_ + 1]; ++c) {
      if (!edge_cuts_.on_side(c).empty()) return true;
      box.add(corner_uv_[c]);
    }
    return (wraps_u(wrap_) && std::floor(box.min.x) + 1 < box.max.x) ||
           (wraps_v(wrap_) && std::floor(box.min.y) + 1 < box.max.y);
  }

  void whole_face() {
    splitter_.clear();
    ring_.clear();
    const std::uint32_t begin = mesh_.face_begin[face_], size = mesh_.face_size(face_);
    for (std::uint32_t i = 0; i < size; ++i) {
      add_corner(begin + i, 0);
      if (edge_cuts_.on_side(begin + i).empty()) continue;
      add_side(begin + i, begin + (i + 1) % size, 0, 1);
    }
    emit(ring_);
  }

  void split_face() {
    const std::uint32_t begin = mesh_.face_begin[face_], end = mesh_.face_begin[face_ + 1];
    input_uvs_.clear();
    for (std::uint32_t c = begin; c < end; ++c) {
      input_uvs_.push_back(mesh_.texcoords[mesh_.corner_texcoord[c]]);
    }
    triangles_.clear();
    triangulate_polygon(input_uvs_, triangles_);
    diagonals_.clear();
    for (const auto& offsets : triangles_) {
      for (std::size_t i = 0; i < 3; ++i) triangle_[i] = begin + offsets[i];
      splitter_.clear();
      ring_.clear();
      for (std::size_t i = 0; i < 3; ++i) {
        add_corner(triangle_[i], i);
        add_side(triangle_[i], triangle_[(i + 1) % 3], i, (i + 1) % 3);
      }
      for (const auto& piece : splitter_.split(ring_, wrap_)) emit(piece);
    }
  }

  void add_corner(std::uint32_t corner, std::size_t index) {
    CutNode node;
    node.uv = corner_uv_[corner];
    node.corner = corner;
    node.weights[index] = 1;
    ring_.push_back(static_cast<std::uint32_t>(splitter_.nodes.size()));
    splitter_.nodes.push_back(node);
  }

  void add_side(std::uint32_t from, std::uint32_t to, std::size_t from_index,
                std::size_t to_index) {
    const bool forward = edge_cuts_.canonical(from, to);
    if (!forward) {
      std::swap(from, to);
      std::swap(from_index, to_index);
    }
    auto [points, first_cut] = points_between(from, to);
    if (points.empty()) return;
    const Vec2 a = corner_uv_[from], b = corner_uv_[to];
    const std::size_t first_node = splitter_.nodes.size();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      CutNode node;
      node.uv = snapped(a + points[i].t * (b - a), wrap_);
      node.weights[from_index] = 1 - points[i].t;
      node.weights[to_index] = points[i].t;
      node.cut = first_cut + i;
      splitter_.nodes.push_back(node);
    }
    set_exact_coordinates(a, b, points, first_node);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t along = forward ? i : points.size() - 1 - i;
      ring_.push_back(static_cast<std::uint32_t>(first_node + along));
    }
  }

  // Points at which the side itself crosses a border line lie on that line to the last bit.
  void set_exact_coordinates(Vec2 a, Vec2 b, std::span<const EdgePoint> points,
                             std::size_t first_node) {
    crossings_.clear();
    if (charts_.face_chart[face_] != kNone) find_crossings(a, b, wrap_, crossings_);
    for (const Crossing& crossing : crossings_) {
      std::size_t i = 0;
      while (i + 1 < points.size() && points[i + 1].t <= crossing.t) ++i;
      Vec2& uv = splitter_.nodes[first_node + i].uv;
      (crossing.axis == 0 ? uv.x : uv.y) = crossing.line;
    }
  }

  // The points of a canonical side, and the number of the first one's CutPoint.
  std::pair<std::span<const EdgePoint>, std::uint32_t> points_between(std::uint32_t from,
                                                                      std::uint32_t to) {
    const std::uint32_t begin = mesh_.face_begin[face_], size = mesh_.face_size(face_);
    std::span<const EdgePoint> points;
    if (begin + (from - begin + 1) % size == to) {
      points = edge_cuts_.on_side(from);
    } else if (begin + (to - begin + 1) % size == from) {
      points = edge_cuts_.on_side(to);
    } else {
      for (const Diagonal& d : diagonals_) {
        if (d.from == from && d.to == to) return {d.points, d.first_cut};
      }
      diagonals_.push_back({from, to, points_on_diagonal(from, to), 0});
      diagonals_.back().first_cut = add_cut_points(from, to, diagonals_.back().points);
      return {diagonals_.back().points, diagonals_.back().first_cut};
    }
    return {points, add_cut_points(from, to, points)};
  }

  std::vector<EdgePoint> points_on_diagonal(std::uint32_t from, std::uint32_t to) {
    crossings_.clear();
    find_crossings(corner_uv_[from], corner_uv_[to], wrap_, crossings_);
    std::vector<EdgePoint> points;
    std::sort(crossings_.begin(), crossings_.end(),
              [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
    for (const Crossing& crossing : crossings_) {
      if (!points.empty() && crossing.t - points.back().t <= kSamePlace) continue;
      points.push_back({crossing.t, next_position_++});
    }
    return points;
  }

  std::uint32_t add_cut_points(std::uint32_t from, std::uint32_t to,
                               std::span<const EdgePoint> points) {
    const auto first = static_cast<std::uint32_t>(atlas_.cut_points.size());
    for (const EdgePoint& point : points) {
      atlas_.cut_points.push_back({{from, to, from}, {1 - point.t, point.t, 0}, point.position});
    }
    return first;
  }

  void emit(const TriangleSplitter::Ring& ring) {
    const std::uint32_t chart = charts_.face_chart[face_];
    Box2 box;
    for (const std::uint32_t n : ring) box.add(splitter_.nodes[n].uv);
    const Vec2 period{std::floor(box.min.x), std::floor(box.min.y)};
    for (const std::uint32_t n : ring) {
      CutNode& node = splitter_.nodes[n];
      if (node.corner == kNone && node.cut == kNone) {
        node.cut = static_cast<std::uint32_t>(atlas_.cut_points.size());
        atlas_.cut_points.push_back({triangle_, node.weights, next_position_++});
      }
      atlas_.corner_source.push_back(node.corner);
      atlas_.corner_cut.push_back(node.cut);
      const Vec2 uv = Vec2{local(node.uv.x, period.x, wraps_u(wrap_)),
                           local(node.uv.y, period.y, wraps_v(wrap_))} +
                      (chart == kNone ? Vec2{} : tiles_[chart]);
      if (chart == kNone) {
        atlas_.corner_texcoord.push_back(kNone);
      } else if (node.cut == kNone) {
        const std::uint32_t point = charts_.corner_point[node.corner];
        atlas_.corner_texcoord.push_back(texcoords_.of_point(chart, point, uv));
      } else {
        const std::uint32_t position = atlas_.cut_points[node.cut].position;
        atlas_.corner_texcoord.push_back(texcoords_.of_cut(chart, position, uv));
      }
    }
    atlas_.face_begin.push_back(static_cast<std::uint32_t>(atlas_.corner_source.size()));
    atlas_.face_source.push_back(face_);
  }

  const Mesh& mesh_;
  const ChartSet& charts_;
  Wrap wrap_;
  std::vector<Vec2> corner_uv_;
  EdgeCuts edge_cuts_;
  AtlasMesh atlas_;
  CutTexcoords texcoords_;
  std::uint32_t next_position_;
  std::vector<Vec2> tiles_;  ///< per chart

  // Of the face at work.
  std::uint32_t face_ = 0;
  std::array<std::uint32_t, 3> triangle_{};
  std::vector<Vec2> input_uvs_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Diagonal> diagonals_;
  TriangleSplitter splitter_;
  TriangleSplitter::Ring ring_;
  std::vector<Crossing> crossings_;
};

}  // namespace

AtlasMesh export_cut(const Mesh& mesh, const ChartSet& charts, const Packing& packing,
                     bool v_points_down) {
  return CutExporter(mesh, charts, packing, v_points_down).run();
}

}  // namespace wrapatlas
