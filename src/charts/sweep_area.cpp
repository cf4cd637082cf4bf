// Between two neighbouring end points in y no edge begins or ends: a slab. Where the edges that
// cross a slab keep their order, the integral is a sum of trapezoids; where they do not, the slab
// is halved around them, or cut at the crossings when few edges are involved. Nothing depends on a
// correct order of coinciding edges: they then exchange an area of the size of rounding.
#include "charts/sweep_area.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <span>
#include <tuple>

namespace wrapatlas {
namespace {

constexpr double kMostSteps = 4e7;
constexpr std::size_t kFewEdges = 6;
constexpr int kMostHalvings = 16;  // what is left then is 4^-16 of the block's own area

/// An edge pointing up, with what its crossing from left to right adds to the winding numbers.
struct Rising {
  Vec2 low, high;
  std::array<std::int32_t, 2> step{};

  [[nodiscard]] double x_at(double y) const {
    if (y <= low.y) return low.x;
    if (y >= high.y) return high.x;
    const double t = (y - low.y) / (high.y - low.y);
    return low.x + t * (high.x - low.x);
  }
};

struct Active {
  double x0 = 0, x1 = 0;   // at the lower and the upper side of the slab
  double leftmost_x1 = 0;  // of this edge and all edges to its right
  std::uint32_t edge = 0;
};

bool left_of(const Active& a, const Active& b) {
  return a.x0 != b.x0 ? a.x0 < b.x0 : (a.x1 != b.x1 ? a.x1 < b.x1 : a.edge < b.edge);
}

using Winding = std::array<std::int32_t, 2>;

double measure_of(Measure measure, const Winding& c) {
  if (measure == Measure::shared) return c[0] != 0 && c[1] != 0 ? 1 : 0;
  return std::max(std::abs(c[0]) - 1, 0);
}

class Sweep {
 public:
  /// `edges` in the order of their low ends.
  Sweep(std::vector<Rising> edges, Measure measure) : edges_(std::move(edges)), measure_(measure) {}

  /// Nothing, if it takes too long.
  std::optional<double> exact(const std::vector<double>& ys, double enough) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < ys.size() && sum <= enough; ++i) {
      advance(ys[i], ys[i], ys[i + 1]);
      Winding c{};
      sum += slab(active_, ys[i], ys[i + 1], c, 0);
      if (steps_ > kMostSteps) return std::nullopt;
    }
    return sum;
  }

  double sampled(double low, double high, std::size_t lines, double enough) {
    const double step = (high - low) / static_cast<double>(lines);
    active_.clear();
    next_ = 0;
    double sum = 0;
    for (std::size_t i = 0; i < lines && sum <= enough; ++i) {
      const double y = low + (static_cast<double>(i) + 0.5) * step;
      advance(y, y, y);
      Winding c{};
      for (const Active& a : active_) sum += step * pass(a.x0, a.edge, c);
    }
    return sum;
  }

 private:
  // Crossing an edge at x changes the measure from m to m': it adds x (m - m') to the integral
  // along the line.
  double pass(double x, std::uint32_t edge, Winding& c) const {
    const double before = measure_of(measure_, c);
    c[0] += edges_[edge].step[0];
    c[1] += edges_[edge].step[1];
    return x * (before - measure_of(measure_, c));
  }

  void advance(double y, double y0, double y1) {
    std::erase_if(active_, [&](const Active& a) { return edges_[a.edge].high.y <= y; });
    const std::size_t old = active_.size();
    for (; next_ < edges_.size() && edges_[next_].low.y <= y; ++next_) {
      if (edges_[next_].high.y > y) active_.push_back({0, 0, 0, static_cast<std::uint32_t>(next_)});
    }
    for (Active& a : active_) {
      a.x0 = edges_[a.edge].x_at(y0);
      a.x1 = edges_[a.edge].x_at(y1);
    }
    const auto middle = active_.begin() + static_cast<std::ptrdiff_t>(old);
    if (!std::is_sorted(active_.begin(), middle, left_of)) {
      std::sort(active_.begin(), middle, left_of);
    }
    std::sort(middle, active_.end(), left_of);
    std::inplace_merge(active_.begin(), middle, active_.end(), left_of);
  }

  // `row` is ordered at y0; c is the winding on its left, then on its right.
  double slab(std::span<Active> row, double y0, double y1, Winding& c, int depth) {
    const double height = y1 - y0;
    steps_ += static_cast<double>(row.size());
    double leftmost = std::numeric_limits<double>::infinity();
    for (std::size_t i = row.size(); i-- > 0;) {
      row[i].leftmost_x1 = leftmost = std::min(leftmost, row[i].x1);
    }
    double sum = 0;
    std::size_t begin = 0;
    while (begin < row.size()) {
      const std::size_t end = block_end(row, begin);
      if (end == begin + 1) {
        sum += height * pass(0.5 * (row[begin].x0 + row[begin].x1), row[begin].edge, c);
      } else {
        sum += crossing_block(row.subspan(begin, end - begin), y0, y1, c, depth);
      }
      begin = end;
    }
    return sum;
  }

  // The shortest run from `begin` on that keeps clear of all edges to its right.
  static std::size_t block_end(std::span<const Active> row, std::size_t begin) {
    double farthest = row[begin].x1;
    std::size_t end = begin + 1;
    for (; end < row.size() && row[end].leftmost_x1 < farthest; ++end) {
      farthest = std::max(farthest, row[end].x1);
    }
    return end;
  }

  double crossing_block(std::span<Active> block, double y0, double y1, Winding& c, int depth) {
    if (block.size() <= kFewEdges) return cut_at_crossings(block, y0, y1, c);
    const double middle = y0 + 0.5 * (y1 - y0);
    if (depth == kMostHalvings || !(y0 < middle && middle < y1)) {
      return (y1 - y0) * along_line(block, middle, c);
    }
    std::vector<Active> half(block.begin(), block.end());
    for (Active& a : half) a.x1 = edges_[a.edge].x_at(middle);
    Winding lower = c;
    double sum = slab(half, y0, middle, lower, depth + 1);
    for (Active& a : half) {
      a.x0 = edges_[a.edge].x_at(middle);
      a.x1 = edges_[a.edge].x_at(y1);
    }
    std::sort(half.begin(), half.end(), left_of);
    sum += slab(half, middle, y1, c, depth + 1);
    return sum;
  }

  double cut_at_crossings(std::span<const Active> block, double y0, double y1, Winding& c) {
    std::array<double, kFewEdges*(kFewEdges - 1) / 2 + 2> cuts;
    std::size_t count = 0;
    cuts[count++] = y0;
    for (std::size_t i = 0; i < block.size(); ++i) {
      for (std::size_t j = i + 1; j < block.size(); ++j) {
        const double below = block[j].x0 - block[i].x0, above = block[i].x1 - block[j].x1;
        if (below >= 0 && above > 0) cuts[count++] = y0 + (y1 - y0) * (below / (below + above));
      }
    }
    cuts[count++] = y1;
    std::sort(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(count));
    const Winding left = c;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      c = left;
      sum += (cuts[i + 1] - cuts[i]) * along_line(block, 0.5 * (cuts[i] + cuts[i + 1]), c);
    }
    return sum;
  }

  double along_line(std::span<const Active> block, double y, Winding& c) {
    line_.assign(block.begin(), block.end());
    for (Active& a : line_) a.x0 = a.x1 = edges_[a.edge].x_at(y);
    std::sort(line_.begin(), line_.end(), left_of);
    double sum = 0;
    for (const Active& a : line_) sum += pass(a.x0, a.edge, c);
    return sum;
  }

  std::vector<Rising> edges_;
  Measure measure_;
  std::vector<Active> active_, line_;
  std::size_t next_ = 0;
  double steps_ = 0;
};

struct Direction {
  std::vector<Rising> edges;
  std::vector<double> ys;
  double steps = 0;
};

// Copies of a chart on top of each other have the same edges.
void merge_coinciding(std::vector<Rising>& edges) {
  std::sort(edges.begin(), edges.end(), [](const Rising& a, const Rising& b) {
    return std::tie(a.low.y, a.low.x, a.high.y, a.high.x) <
           std::tie(b.low.y, b.low.x, b.high.y, b.high.x);
  });
  std::size_t kept = 0;
  for (const Rising& edge : edges) {
    if (kept > 0 && edges[kept - 1].low == edge.low && edges[kept - 1].high == edge.high) {
      edges[kept - 1].step[0] += edge.step[0];
      edges[kept - 1].step[1] += edge.step[1];
    } else {
      edges[kept++] = edge;
    }
  }
  edges.resize(kept);
  std::erase_if(edges, [](const Rising& e) { return e.step == Winding{}; });
}

Direction sweep_along(const std::vector<SweepEdge>& edges, const Box2& window, bool swap_axes) {
  const Vec2 centre = 0.5 * (window.min + window.max);
  const auto place = [&](Vec2 p) {
    p = p - centre;
    return swap_axes ? Vec2{p.y, p.x} : p;
  };
  const double low = place(window.min).y, high = place(window.max).y;
  Direction d;
  d.ys = {low, high};
  for (const SweepEdge& e : edges) {
    const Vec2 a = place(e.from), b = place(e.to);
    if (a.y == b.y || std::max(a.y, b.y) <= low || std::min(a.y, b.y) >= high) continue;
    const Winding w = e.winding;
    if (a.y < b.y) {
      d.edges.push_back({a, b, {-w[0], -w[1]}});
    } else {
      d.edges.push_back({b, a, w});
    }
    for (const double y : {a.y, b.y}) {
      if (low < y && y < high) d.ys.push_back(y);
    }
  }
  merge_coinciding(d.edges);
  std::sort(d.ys.begin(), d.ys.end());
  d.ys.erase(std::unique(d.ys.begin(), d.ys.end()), d.ys.end());
  const auto rank = [&](double y) { return std::lower_bound(d.ys.begin(), d.ys.end(), y); };
  for (const Rising& e : d.edges) {
    d.steps += static_cast<double>(rank(e.high.y) - rank(std::max(e.low.y, low)));
  }
  return d;
}

}  // namespace

double sweep_area(const std::vector<SweepEdge>& edges, Measure measure, const Box2& window,
                  double enough) {
  if (window.empty()) return 0;
  Direction direction = sweep_along(edges, window, false);
  Direction other = sweep_along(edges, window, true);
  if (other.steps < direction.steps) direction = std::move(other);
  const double low = direction.ys.front(), high = direction.ys.back();
  if (!(low < high)) return 0;
  const double slabs = static_cast<double>(direction.ys.size() - 1);
  Sweep sweep(std::move(direction.edges), measure);
  if (direction.steps <= kMostSteps) {
    if (const auto sum = sweep.exact(direction.ys, enough)) return *sum;
  }
  const double lines = std::clamp(slabs * (kMostSteps / direction.steps) / 8, 64.0, 1e5);
  return sweep.sampled(low, high, static_cast<std::size_t>(lines), enough);
}

}  // namespace wrapatlas
