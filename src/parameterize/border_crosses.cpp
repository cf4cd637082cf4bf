// The border as a chain of edges, and a tree of boxes over it: half of the chain, a quarter, and so
// on. Parts of a border that are near along it are near in the plane, so few boxes meet.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/edge_groups.h"
#include "parameterize/orient2d.h"
#include "wrapatlas/parameterize.h"

namespace wrapatlas {
namespace {

struct BorderEdge {
  std::uint32_t from = 0, to = 0;
};

/// Nothing if more than two border edges, or one alone, meet at a point.
bool chain_border(std::size_t point_count, std::span<const std::array<std::uint32_t, 3>> triangles,
                  std::vector<BorderEdge>& chain) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), t, a > b});
    }
  }
  gather_edges(uses, point_count);
  std::vector<std::array<std::uint32_t, 2>> next_to(point_count, {kNone, kNone});
  bool simple = true;
  const auto link = [&](std::uint32_t from, std::uint32_t to) {
    std::array<std::uint32_t, 2>& ends = next_to[from];
    simple = simple && ends[1] == kNone;
    ends[ends[0] == kNone ? 0 : 1] = to;
  };
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 1) return;
    link(edge[0].low, edge[0].high);
    link(edge[0].high, edge[0].low);
  });
  for (std::uint32_t first = 0; first < point_count && simple; ++first) {
    if (next_to[first][0] == kNone) continue;
    std::uint32_t before = next_to[first][1], at = first;
    do {
      const std::array<std::uint32_t, 2> ends = std::exchange(next_to[at], {kNone, kNone});
      if (ends[1] == kNone) return false;
      const std::uint32_t after = ends[0] == before ? ends[1] : ends[0];
      chain.push_back({at, after});
      before = std::exchange(at, after);
    } while (at != first);
  }
  return simple;
}

/// By a power of two, so that no product of coordinates overflows, or underflows unless one is
/// 1e-290 times the largest or less. False if one is not a number.
bool scale_coordinates(std::vector<Vec2>& points) {
  double largest = 0;
  for (const Vec2 p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
    largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  }
  if (largest == 0) return true;
  const int exponent = 495 - std::ilogb(largest);
  for (Vec2& p : points) p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)};
  return true;
}

bool meet(const Box2& a, const Box2& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

class BoxTree {
 public:
  /// `chain` indexes `points`; no edge is a point.
  BoxTree(std::span<const Vec2> points, std::span<const BorderEdge> chain)
      : points_(points), chain_(chain), boxes_(2 * chain.size()) {
    build(whole());
  }
  [[nodiscard]] bool any_meet() const { return any_within(whole()); }

 private:
  /// Edges [begin, end) of the chain; its box has the number `box`, those of its halves follow.
  struct Part {
    std::size_t begin, end, box;

    [[nodiscard]] bool one() const { return end - begin == 1; }
    [[nodiscard]] std::pair<Part, Part> halves() const {
      const std::size_t middle = begin + (end - begin) / 2;
      return {{begin, middle, box + 1}, {middle, end, box + 2 * (middle - begin)}};
    }
  };
  [[nodiscard]] Part whole() const { return {0, chain_.size(), 0}; }

  void build(const Part& part) {
    Box2& box = boxes_[part.box];
    if (part.one()) {
      box.add(points_[chain_[part.begin].from]);
      box.add(points_[chain_[part.begin].to]);
      return;
    }
    const auto [first, second] = part.halves();
    for (const Part& half : {first, second}) {
      build(half);
      box.add(boxes_[half.box].min);
      box.add(boxes_[half.box].max);
    }
  }

  [[nodiscard]] bool any_within(const Part& part) const {
    if (part.one()) return false;
    const auto [first, second] = part.halves();
    return any_within(first) || any_within(second) || any_between(first, second);
  }
  [[nodiscard]] bool any_between(const Part& a, const Part& b) const {
    if (!meet(boxes_[a.box], boxes_[b.box])) return false;
    if (a.one() && b.one()) return edges_meet(chain_[a.begin], chain_[b.begin]);
    if (a.end - a.begin < b.end - b.begin) return any_between(b, a);
    const auto [first, second] = a.halves();
    return any_between(first, b) || any_between(second, b);
  }

  /// For edges whose boxes meet.
  [[nodiscard]] bool edges_meet(const BorderEdge& e, const BorderEdge& f) const {
    if (e.to == f.from || e.to == f.to)
      return folds_back(e.to, e.from, e.to == f.from ? f.to : f.from);
    if (e.from == f.from || e.from == f.to) {
      return folds_back(e.from, e.to, e.from == f.from ? f.to : f.from);
    }
    const Vec2 a = points_[e.from], b = points_[e.to], c = points_[f.from], d = points_[f.to];
    // Where all four are on one line the boxes have said it. Else each must reach the other's line.
    return orient2d(a, b, c) * orient2d(a, b, d) <= 0 && orient2d(c, d, a) * orient2d(c, d, b) <= 0;
  }
  /// Do the edges from `corner` to p and to q have more than the corner in common?
  [[nodiscard]] bool folds_back(std::uint32_t corner, std::uint32_t p, std::uint32_t q) const {
    const Vec2 o = points_[corner], a = points_[p], b = points_[q];
    const auto same_side = [](double from, double x, double y) {
      return (x > from && y > from) || (x < from && y < from);
    };
    return orient2d(o, a, b) == 0 && (same_side(o.x, a.x, b.x) || same_side(o.y, a.y, b.y));
  }

  std::span<const Vec2> points_;
  std::span<const BorderEdge> chain_;
  std::vector<Box2> boxes_;
};

}  // namespace

bool border_crosses(std::span<const Vec2> uv,
                    std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<BorderEdge> chain;
  if (!chain_border(uv.size(), triangles, chain)) return true;
  if (chain.empty()) return false;
  std::vector<Vec2> points;
  points.reserve(chain.size());
  for (const BorderEdge& edge : chain) points.push_back(uv[edge.from]);
  if (!scale_coordinates(points)) return true;
  // From here on points are numbered along the border, where each is once.
  std::vector<std::uint32_t> number(uv.size(), kNone);
  for (std::uint32_t i = 0; i < chain.size(); ++i) number[chain[i].from] = i;
  for (BorderEdge& edge : chain) edge = {number[edge.from], number[edge.to]};
  for (const BorderEdge& edge : chain) {
    if (points[edge.from] == points[edge.to]) return true;
  }
  return BoxTree(points, chain).any_meet();
}

}  // namespace wrapatlas
