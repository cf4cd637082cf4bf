#include "guided/borders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "threads/parallel.h"

namespace wrapatlas {
namespace {

constexpr int kFewest = 12;  ///< points in contact that count as a match
/// Steps between borders in contact: at most, as both are polygons, and in the mean.
constexpr double kTouching = 0.35, kClose = 0.12;
constexpr int kAround = 2;  ///< points to either side from which a direction is taken

/// The closed lines of a shape. At points where it touches itself any way on will do.
std::vector<std::vector<Vec2>> loops_of(const RasterShape& shape) {
  std::vector<std::vector<std::uint32_t>> leaving(shape.points.size());
  for (std::uint32_t e = 0; e < shape.edges.size(); ++e) leaving[shape.edges[e].from].push_back(e);
  std::vector<std::vector<Vec2>> loops;
  for (std::uint32_t first = 0; first < shape.points.size(); ++first) {
    while (!leaving[first].empty()) {
      std::vector<Vec2> loop;
      std::uint32_t at = first;
      do {
        loop.push_back(shape.points[at]);
        const std::uint32_t edge = leaving[at].back();
        leaving[at].pop_back();
        at = shape.edges[edge].to;
      } while (at != first && !leaving[at].empty());
      if (at == first && loop.size() >= 3) loops.push_back(std::move(loop));
    }
  }
  return loops;
}

double signed_area(const std::vector<Vec2>& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += cross(loop[i], loop[(i + 1) % loop.size()]);
  return sum / 2;
}

std::vector<Vec2> resampled(const std::vector<Vec2>& loop, double step) {
  double whole = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    whole += length(loop[(i + 1) % loop.size()] - loop[i]);
  }
  const int count = static_cast<int>(std::lround(whole / step));
  std::vector<Vec2> points;
  double passed = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = loop[i], along = loop[(i + 1) % loop.size()] - a;
    const double here = length(along);
    while (static_cast<int>(points.size()) < count) {
      const double at = whole * static_cast<double>(points.size()) / count;
      if (at > passed + here) break;
      points.push_back(a + (here > 0 ? (at - passed) / here : 0) * along);
    }
    passed += here;
  }
  return points;
}

std::uint16_t direction_of(Vec2 along) {
  const double turns = std::atan2(along.y, along.x) / (2 * std::numbers::pi);
  return static_cast<std::uint16_t>(static_cast<std::int32_t>(std::lround(turns * 65536)));
}

/// Points in contact; those of straight lines, which fit anywhere, count little. What a border
/// turns at the ends is left out: there it may already leave the other.
double strength_of(const Border& border, int begin, int count) {
  constexpr double kStraight = 0.15;
  std::int64_t turning = 0;
  for (int i = begin + kAround; i + 1 < begin + count - kAround; ++i) {
    const auto a = border.directions[static_cast<std::size_t>(border.index(i))];
    const auto b = border.directions[static_cast<std::size_t>(border.index(i + 1))];
    turning += std::abs(static_cast<std::int16_t>(static_cast<std::uint16_t>(b - a)));
  }
  return count *
         std::min(1.0, kStraight + static_cast<double>(turning) * 2 * std::numbers::pi / 65536);
}

struct Run {
  int a, b, count;
  double rank;
};

/// Runs along which the angle between the borders stays the same. The first is not the longer.
class RunFinder {
 public:
  RunFinder(const Border& a, const Border& b) : a_(a), b_(b) {
    // Against the grain, and twice, so that it can be read on beyond its end.
    for (int k = 0; k < 2 * b.size(); ++k) {
      back_.push_back(
          static_cast<std::uint16_t>(b.directions[static_cast<std::size_t>(b.index(-k))] + 0x8000));
    }
  }

  std::vector<Run> find() {
    for (int shift = 0; shift < b_.size(); ++shift) {
      const std::uint16_t* back = back_.data() + shift;
      std::uint16_t anchor = 0;
      int begin = 0;
      for (int t = 0; t <= a_.size(); ++t) {
        if (t < a_.size()) {
          const auto angle =
              static_cast<std::uint16_t>(a_.directions[static_cast<std::size_t>(t)] - back[t]);
          if (std::abs(static_cast<std::int16_t>(static_cast<std::uint16_t>(angle - anchor))) <=
              kAlike)
            continue;
          anchor = angle;
        }
        if (t - begin >= kFewest - 2 * kAround)
          keep({begin, b_.index(-shift - begin), t - begin, 0});
        begin = t;
      }
    }
    return std::move(best_);
  }

 private:
  static constexpr int kAlike = 65536 / 72;  ///< largest difference of angles: 5 degrees
  static constexpr std::size_t kKept = 8;

  void keep(Run run) {
    run.rank = strength_of(a_, run.a, run.count);
    for (Run& other : best_) {
      // The same contact, seen from one point further on.
      if (std::abs(other.a - run.a) <= 4 && std::abs(other.b - run.b) <= 4) {
        if (run.rank > other.rank) other = run;
        return;
      }
    }
    best_.push_back(run);
    std::stable_sort(best_.begin(), best_.end(),
                     [](const Run& x, const Run& y) { return x.rank > y.rank; });
    if (best_.size() > kKept) best_.pop_back();
  }

  const Border &a_, &b_;
  std::vector<std::uint16_t> back_;
  std::vector<Run> best_;
};

/// The motion that takes points of b to those of a they belong to.
Pose first_pose(const Border& a, const Border& b, const Run& run) {
  Vec2 mean_a, mean_b;
  for (int t = 0; t < run.count; ++t) {
    mean_a = mean_a + (1.0 / run.count) * a.point(run.a + t);
    mean_b = mean_b + (1.0 / run.count) * b.point(run.b - t);
  }
  double along = 0, across = 0;
  for (int t = 0; t < run.count; ++t) {
    const Vec2 p = a.point(run.a + t) - mean_a, q = b.point(run.b - t) - mean_b;
    along += dot(q, p);
    across += cross(q, p);
  }
  const Pose turn{std::atan2(across, along), {}};
  return {turn.angle, mean_a - turn.turned(mean_b)};
}

/// Fits a run closely and follows it to its ends. count = 0: it was none.
BorderMatch fitted(const Border& a, const Border& b, Run run, double step) {
  constexpr int kFits = 6;
  const double touching = kTouching * step;
  Pose pose = first_pose(a, b, run);
  double square = 0;
  for (int fit = 0; fit < kFits; ++fit) {
    if (fit == kFits / 2) {  // to both ends
      const Similarity to_a = pose.map();
      const auto touches = [&](int t) {
        const Vec2 q = to_a.apply(b.point(run.b - t));
        return length(nearest_on(a, q, run.a + t).point - q) < touching;
      };
      const int most = std::min(a.size(), b.size());
      while (run.count > kFewest && !touches(run.count - 1)) --run.count;
      while (run.count > kFewest && !touches(0)) ++run.a, --run.b, --run.count;
      while (run.count < most && touches(run.count)) ++run.count;
      while (run.count < most && touches(-1)) --run.a, ++run.b, ++run.count;
    }
    const Similarity to_a = pose.map();
    MotionFit motion(to_a.apply(b.point(run.b - run.count / 2)));
    square = 0;
    for (int t = 0; t < run.count; ++t) {
      const Vec2 q = to_a.apply(b.point(run.b - t));
      const OnBorder on = nearest_on(a, q, run.a + t);
      square += dot(on.point - q, on.point - q) / run.count;
      motion.add(q, on.point, on.along);
    }
    if (!(std::sqrt(square) <= step)) return {};
    pose = motion.solve().after(pose);
  }
  if (!(std::sqrt(square) <= kClose * step) || run.count < kFewest) return {};
  BorderMatch match;
  match.begin_a = a.index(run.a);
  match.begin_b = b.index(run.b);
  match.count = run.count;
  match.b_to_a = pose;
  match.strength = strength_of(a, run.a, run.count);
  return match;
}

/// Leaves out matches half of whose points, on one side, have several stronger ones.
void keep_strongest(std::vector<BorderMatch>& matches, std::span<const Border> borders) {
  constexpr std::uint8_t kPerPoint = 3;
  std::stable_sort(matches.begin(), matches.end(), [](const BorderMatch& x, const BorderMatch& y) {
    return x.strength > y.strength;
  });
  std::vector<std::vector<std::uint8_t>> used;
  for (const Border& border : borders) used.emplace_back(border.points.size());
  std::erase_if(matches, [&](const BorderMatch& match) {
    const auto point_a = [&](int t) -> std::uint8_t& {
      return used[match.a][static_cast<std::size_t>(borders[match.a].index(match.begin_a + t))];
    };
    const auto point_b = [&](int t) -> std::uint8_t& {
      return used[match.b][static_cast<std::size_t>(borders[match.b].index(match.begin_b - t))];
    };
    int open_a = 0, open_b = 0;
    for (int t = 0; t < match.count; ++t) {
      open_a += point_a(t) < kPerPoint ? 1 : 0;
      open_b += point_b(t) < kPerPoint ? 1 : 0;
    }
    if (2 * std::min(open_a, open_b) < match.count) return true;
    for (int t = 0; t < match.count; ++t) {
      ++point_a(t);
      ++point_b(t);
    }
    return false;
  });
}

}  // namespace

std::vector<Border> sample_borders(std::span<const ChartShape> shapes, double step) {
  std::vector<Border> borders;
  for (std::uint32_t chart = 0; chart < shapes.size(); ++chart) {
    if (!shapes[chart].raster.simple) continue;
    auto loops = loops_of(shapes[chart].raster);
    double area = 0;
    for (const auto& loop : loops) area += signed_area(loop);
    for (auto& loop : loops) {
      if (area < 0) std::reverse(loop.begin(), loop.end());
      Border border;
      border.chart = chart;
      border.points = resampled(loop, step);
      if (border.size() < kFewest) continue;
      for (int i = 0; i < border.size(); ++i) {
        border.directions.push_back(
            direction_of(border.point(i + kAround) - border.point(i - kAround)));
      }
      borders.push_back(std::move(border));
    }
  }
  return borders;
}

OnBorder nearest_on(const Border& border, Vec2 point, int near) {
  constexpr int kReach = 3;
  OnBorder best{{}, {1, 0}};
  double least = std::numeric_limits<double>::infinity();
  for (int i = near - kReach; i < near + kReach; ++i) {
    const Vec2 from = border.point(i), along = border.point(i + 1) - from;
    const double square = dot(along, along);
    if (square <= 0) continue;
    const double t = std::clamp(dot(point - from, along) / square, 0.0, 1.0);
    const Vec2 on = from + t * along;
    const double distance = dot(point - on, point - on);
    if (distance < least) {
      least = distance;
      best = {on, (1 / std::sqrt(square)) * along};
    }
  }
  return best;
}

std::vector<BorderMatch> match_borders(std::span<const Border> borders, double step, int threads,
                                       const Effort& effort) {
  std::vector<std::vector<BorderMatch>> found(borders.size());
  parallel_for(borders.size(), threads, [&](std::size_t job) {
    const std::size_t i = borders.size() - 1 - job;  // long jobs first
    for (std::size_t j = 0; j <= i && !effort.spent(); ++j) {
      const bool swap = borders[i].size() > borders[j].size();
      const std::size_t a = swap ? j : i, b = swap ? i : j;
      for (const Run& run : RunFinder(borders[a], borders[b]).find()) {
        BorderMatch match = fitted(borders[a], borders[b], run, step);
        if (match.count == 0) continue;
        match.a = static_cast<std::uint32_t>(a);
        match.b = static_cast<std::uint32_t>(b);
        found[i].push_back(match);
      }
    }
  });
  std::vector<BorderMatch> matches;
  for (const auto& of_one : found) matches.insert(matches.end(), of_one.begin(), of_one.end());
  keep_strongest(matches, borders);
  return matches;
}

}  // namespace wrapatlas
