#include "guided/joiner.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace wrapatlas {
namespace {

constexpr double kSameAngle = 0.07;  ///< radians
constexpr double kSamePlace = 2;     ///< steps
constexpr double kCell = 2;          ///< steps, for the overlap of charts

}  // namespace

Joiner::Joiner(std::span<const ChartShape> shapes, double step)
    : charts_(shapes.size()),
      step_(step),
      borders_(sample_borders(shapes, step)),
      groups_(shapes, kCell * step) {}

bool Joiner::all_have_borders() const {
  std::size_t with = 0;  // a chart's borders follow each other
  for (std::size_t i = 0; i < borders_.size(); ++i) {
    if (i == 0 || borders_[i].chart != borders_[i - 1].chart) ++with;
  }
  return with == charts_;
}

/// What takes the group of b to where the match wants it, in the plane of the group of a.
Pose Joiner::motion(std::size_t m) const {
  const Pose from_b = groups_.pose(chart_b(m)).inverse();
  return groups_.pose(chart_a(m)).after(matches_[m].b_to_a).after(from_b);
}

bool Joiner::same(const Pose& a, const Pose& b, Vec2 at) const {
  return std::abs(std::remainder(a.angle - b.angle, 2 * std::numbers::pi)) < kSameAngle &&
         length(a.apply(at) - b.apply(at)) < kSamePlace * step_;
}

/// Is a match within a group kept?
bool Joiner::holds(std::size_t m) const {
  return same(motion(m), {}, groups_.pose(chart_b(m)).shift);
}

void Joiner::join_all(int threads, const Effort& effort) {
  matches_ = match_borders(borders_, step_, threads, effort);
  std::vector<std::size_t> open(matches_.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  std::vector<double> support(matches_.size(), -1);  // to be found anew when a group has grown
  while (!effort.spent()) {
    std::erase_if(open, [&](std::size_t m) { return group_a(m) == group_b(m); });
    if (open.empty()) return;
    update_support(open, support);
    const std::size_t best =
        *std::max_element(open.begin(), open.end(),
                          [&](std::size_t x, std::size_t y) { return support[x] < support[y]; });
    const std::uint32_t group = group_a(best);
    if (!groups_.join(group, group_b(best), motion(best))) {
      std::erase(open, best);
      continue;
    }
    settle(group, {});
    groups_.settled(group);
    for (const std::size_t m : open) {
      if (group_a(m) == group || group_b(m) == group) support[m] = -1;
    }
  }
}

/// The strength of all matches that hold if one does, where it is not known. `open`: numbers of
/// matches, from strong to weak.
void Joiner::update_support(std::span<const std::size_t> open, std::vector<double>& support) const {
  constexpr std::size_t kMostTried = 32;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> between;
  for (const std::size_t m : open) {
    if (support[m] < 0) between[std::minmax(group_a(m), group_b(m))].push_back(m);
  }
  struct Wish {
    Pose motion;  // of the second group
    Vec2 at;
  };
  std::vector<Wish> wishes;
  for (const auto& [pair, ones] : between) {
    wishes.clear();
    for (const std::size_t m : ones) {
      const bool second_is_b = group_a(m) == pair.first;
      wishes.push_back({second_is_b ? motion(m) : motion(m).inverse(),
                        groups_.pose(second_is_b ? chart_b(m) : chart_a(m)).shift});
    }
    for (std::size_t i = 0; i < ones.size(); ++i) {
      support[ones[i]] = 0;
      for (std::size_t k = 0; k < ones.size() && i < kMostTried; ++k) {
        if (same(wishes[i].motion, wishes[k].motion, wishes[k].at)) {
          support[ones[i]] += matches_[ones[k]].strength;
        }
      }
    }
  }
}

std::vector<Period> Joiner::periods(std::uint32_t group) const {
  constexpr double kShortest = 4 * kSamePlace;  // steps
  std::vector<Period> result;
  for (std::size_t m = 0; m < matches_.size(); ++m) {
    if (group_a(m) != group || group_b(m) != group) continue;
    const Pose miss = motion(m);
    if (std::abs(std::remainder(miss.angle, 2 * std::numbers::pi)) > kSameAngle) continue;
    const Vec2 from = groups_.pose(chart_b(m)).shift;
    const Vec2 shift = miss.apply(from) - from;
    if (length(shift) < kShortest * step_) continue;
    result.push_back({m, shift, matches_[m].strength});
  }
  return result;
}

void Joiner::relocate(std::uint32_t group, Vec2 sides) {
  struct Wish {
    Pose pose;
    double strength;
  };
  const auto agree = [&](const Pose& a, const Pose& b) {
    const Vec2 apart{std::remainder(a.shift.x - b.shift.x, sides.x),
                     std::remainder(a.shift.y - b.shift.y, sides.y)};
    return std::abs(std::remainder(a.angle - b.angle, 2 * std::numbers::pi)) < kSameAngle &&
           length(apart) < kSamePlace * step_;
  };
  std::map<std::uint32_t, std::vector<std::size_t>> of_chart;
  for (std::size_t m = 0; m < matches_.size(); ++m) {
    if (group_a(m) != group || group_b(m) != group || chart_a(m) == chart_b(m)) continue;
    of_chart[chart_a(m)].push_back(m);
    of_chart[chart_b(m)].push_back(m);
  }
  std::vector<Wish> wishes;
  for (const auto& [chart, matches] : of_chart) {
    wishes.clear();
    for (const std::size_t m : matches) {
      const Pose& b_to_a = matches_[m].b_to_a;
      const bool is_a = chart_a(m) == chart;
      wishes.push_back({is_a ? groups_.pose(chart_b(m)).after(b_to_a.inverse())
                             : groups_.pose(chart_a(m)).after(b_to_a),
                        matches_[m].strength});
    }
    const auto support = [&](const Pose& pose) {
      double sum = 0;
      for (const Wish& wish : wishes) sum += agree(wish.pose, pose) ? wish.strength : 0;
      return sum;
    };
    double most = support(groups_.pose(chart));
    Pose best = groups_.pose(chart);
    for (const Wish& wish : wishes) {
      const double sum = support(wish.pose);
      if (sum > most) {
        most = sum;
        best = wish.pose;
      }
    }
    groups_.move(chart, best.after(groups_.pose(chart).inverse()));
  }
}

double Joiner::contact(std::uint32_t group, std::span<const Period> periods) const {
  double whole = 0;
  std::vector<std::vector<bool>> touched;
  for (const Border& border : borders_) {
    touched.emplace_back(border.points.size());
    if (groups_.group(border.chart) == group) whole += border.size();
  }
  const auto touch = [&](std::size_t m) {
    const BorderMatch& match = matches_[m];
    for (int t = 0; t < match.count; ++t) {
      const Border &a = borders_[match.a], &b = borders_[match.b];
      touched[match.a][static_cast<std::size_t>(a.index(match.begin_a + t))] = true;
      touched[match.b][static_cast<std::size_t>(b.index(match.begin_b - t))] = true;
    }
  };
  for (std::size_t m = 0; m < matches_.size(); ++m) {
    if (group_a(m) == group && group_b(m) == group && holds(m)) touch(m);
  }
  for (const Period& period : periods) touch(period.match);
  double sum = 0;
  for (const auto& border : touched) {
    sum += static_cast<double>(std::count(border.begin(), border.end(), true));
  }
  return whole > 0 ? sum / whole : 0;
}

void Joiner::settle(std::uint32_t group, std::span<const Period> periods) {
  constexpr int kSweeps = 10;
  struct Link {
    std::size_t match;
    Vec2 shift;
  };
  std::map<std::uint32_t, std::vector<Link>> links;
  const auto link = [&](std::size_t m, Vec2 shift) {
    if (chart_a(m) == chart_b(m)) return;  // it moves itself as well
    links[chart_a(m)].push_back({m, shift});
    links[chart_b(m)].push_back({m, shift});
  };
  for (std::size_t m = 0; m < matches_.size(); ++m) {
    if (group_a(m) != group || group_b(m) != group) continue;
    if (holds(m)) link(m, {});
  }
  for (const Period& period : periods) link(period.match, period.shift);
  links.erase(groups_.members(group).front());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [chart, to_others] : links) {
      MotionFit fit(groups_.pose(chart).shift);
      for (const Link& one : to_others) add_contact(one.match, chart, one.shift, fit);
      groups_.move(chart, fit.solve());
    }
  }
}

/// The points of a chart in a match, and the border they should lie on. `shift`: as of a period.
void Joiner::add_contact(std::size_t m, std::uint32_t chart, Vec2 shift, MotionFit& fit) const {
  const BorderMatch& match = matches_[m];
  const bool is_a = chart_a(m) == chart;
  const Border& own = borders_[is_a ? match.a : match.b];
  const Border& other = borders_[is_a ? match.b : match.a];
  const Similarity here = groups_.pose(chart).map();
  Pose there = groups_.pose(is_a ? chart_b(m) : chart_a(m));
  there.shift = is_a ? there.shift + shift : there.shift - shift;
  const Similarity to_other = there.inverse().map(), back = there.map(), turn = there.turn();
  for (int t = 0; t < match.count; ++t) {
    const int i = is_a ? match.begin_a + t : match.begin_b - t;
    const int j = is_a ? match.begin_b - t : match.begin_a + t;
    const Vec2 p = here.apply(own.point(i));
    const OnBorder on = nearest_on(other, to_other.apply(p), j);
    fit.add(p, back.apply(on.point), turn.apply(on.along));
  }
}

}  // namespace wrapatlas
