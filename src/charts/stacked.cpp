#include "charts/stacked.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "charts/sweep_area.h"

namespace wrapatlas {
namespace {

Box2 common_box(const Box2& a, const Box2& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

/// Tests pairs of charts, and counts the edges it had to look at.
class PairTest {
 public:
  bool stacked(const Chart& a, const Chart& b) {
    const Box2 window = common_box(a.box, b.box);
    const double enough = kStackedShare * std::min(a.area, b.area);
    if (window.empty() || window.size().x * window.size().y <= enough) return false;
    edges_.clear();
    add(a, window, {1, 0});
    add(b, window, {0, 1});
    steps += static_cast<double>(a.outline.size() + b.outline.size());
    return sweep_area(edges_, Measure::shared, window, enough) > enough;
  }

  double steps = 0;

 private:
  // Edges above and below the window, or right of it, do not matter to any line through it;
  // but the sweep chooses its axis, so only edges outside of both ranges may go.
  void add(const Chart& chart, const Box2& window, std::array<std::int32_t, 2> layer) {
    for (const OutlineEdge& e : chart.outline) {
      const Vec2 p = chart.points[e.from], q = chart.points[e.to];
      const bool beside = std::max(p.x, q.x) <= window.min.x || std::min(p.x, q.x) >= window.max.x;
      const bool above = std::max(p.y, q.y) <= window.min.y || std::min(p.y, q.y) >= window.max.y;
      if (beside && above) continue;
      edges_.push_back({p, q, {layer[0] * e.winding, layer[1] * e.winding}});
    }
  }

  std::vector<SweepEdge> edges_;
};

/// Calls test(i, j) for pairs of charts of some area whose boxes overlap, until it returns false.
template <typename Test>
void for_overlapping_boxes(std::span<const Chart> charts, Test&& test) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < charts.size(); ++i) {
    if (charts[i].area > 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return charts[a].box.min.x < charts[b].box.min.x;
  });
  std::vector<std::uint32_t> open;
  for (const std::uint32_t i : order) {
    const Box2& box = charts[i].box;
    std::erase_if(open, [&](std::uint32_t j) { return charts[j].box.max.x <= box.min.x; });
    for (const std::uint32_t j : open) {
      const Box2& other = charts[j].box;
      if (other.max.y <= box.min.y || box.max.y <= other.min.y) continue;
      if (!test(i, j)) return;
    }
    open.push_back(i);
  }
}

}  // namespace

std::vector<bool> mark_stacked(std::span<const Chart> charts, double most_steps) {
  std::vector<bool> marked(charts.size(), false);
  PairTest pair;
  for_overlapping_boxes(charts, [&](std::uint32_t i, std::uint32_t j) {
    pair.steps += 1;
    if (marked[i] && marked[j]) return true;
    if (pair.stacked(charts[i], charts[j])) marked[i] = marked[j] = true;
    return pair.steps <= most_steps;
  });
  return marked;
}

UnionFind group_stacked(std::span<const Chart> charts) {
  UnionFind groups(charts.size());
  PairTest pair;
  for_overlapping_boxes(charts, [&](std::uint32_t i, std::uint32_t j) {
    if (groups.find(i) != groups.find(j) && pair.stacked(charts[i], charts[j])) {
      groups.unite(i, j);
    }
    return true;
  });
  return groups;
}

}  // namespace wrapatlas
