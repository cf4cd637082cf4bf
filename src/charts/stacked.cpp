#include "charts/stacked.h"

#include <algorithm>
#include <cmath>
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
    double enough = kStackedShare * std::min(a.area, b.area);
    if (window.empty() || window.size().x * window.size().y <= enough) return false;
    edges_.clear();
    add(a, window, {1, 0});
    add(b, window, {0, 1});
    steps += static_cast<double>(a.outline.size() + b.outline.size());
    const double far = std::max({std::abs(window.min.x), std::abs(window.min.y),
                                 std::abs(window.max.x), std::abs(window.max.y)});
    enough = std::max(enough, kStackedDepth * far * (window.size().x + window.size().y));
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

/// Charts on the sweep line, in the sets known so far.
using OpenSets = std::vector<std::vector<std::uint32_t>>;

/// Does chart i lie on a chart of the set? Charts that the sweep line has left drop out.
bool touches_set(std::span<const Chart> charts, std::uint32_t i, std::vector<std::uint32_t>& set,
                 PairTest& pair) {
  const Box2& box = charts[i].box;
  for (std::size_t k = 0; k < set.size();) {
    const Box2& other = charts[set[k]].box;
    if (other.max.x <= box.min.x) {
      set[k] = set.back();
      set.pop_back();
      continue;
    }
    pair.steps += 1;
    if (other.min.y < box.max.y && box.min.y < other.max.y &&
        pair.stacked(charts[i], charts[set[k]])) {
      return true;
    }
    ++k;
  }
  return false;
}

void join(std::vector<std::uint32_t>& into, std::vector<std::uint32_t>& from) {
  if (into.size() < from.size()) into.swap(from);
  into.insert(into.end(), from.begin(), from.end());
  from.clear();
}

}  // namespace

StackedGroups group_stacked(std::span<const Chart> charts, double most_steps) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < charts.size(); ++i) {
    if (charts[i].area > 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return charts[a].box.min.x < charts[b].box.min.x;
  });
  StackedGroups found{UnionFind(charts.size())};
  PairTest pair;
  OpenSets open;
  for (const std::uint32_t i : order) {
    std::vector<std::uint32_t> joined{i};
    for (std::vector<std::uint32_t>& set : open) {
      if (!touches_set(charts, i, set, pair)) continue;
      found.groups.unite(i, set.front());
      join(joined, set);
    }
    std::erase_if(open, [](const auto& set) { return set.empty(); });
    open.push_back(std::move(joined));
    if (pair.steps > most_steps && i != order.back()) {
      found.complete = false;
      break;
    }
  }
  return found;
}

}  // namespace wrapatlas
