#include "validate/close_pairs.h"

#include <algorithm>
#include <tuple>

#include "validate/connectivity.h"

namespace wrapatlas::validate {
namespace {

constexpr std::size_t kMostPairsPerShare = 1 << 15;
constexpr std::size_t kMostFoldCandidates = 4096;

/// The entries of a leaf, with exact corners and boxes, sorted for a sweep along x.
struct Placed {
  Triangle corners;
  Box2 box;
  std::uint32_t chart, stack;
  const Entry* entry;
};

std::vector<Placed> place(const Space& space, std::span<const Entry> entries) {
  std::vector<Placed> placed;
  placed.reserve(entries.size());
  for (const Entry& entry : entries) {
    const Item& item = space.items[entry.item];
    Placed p{space.image(entry), {}, item.chart, item.stack, &entry};
    for (const Vec2 corner : p.corners) p.box.add(corner);
    placed.push_back(p);
  }
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.box.min.x, a.entry->item, a.entry->image_x, a.entry->image_y) <
           std::tie(b.box.min.x, b.entry->item, b.entry->image_x, b.entry->image_y);
  });
  return placed;
}

PairRecord record_of(Violation kind, const Placed& a, const Placed& b, double amount) {
  const bool keep = std::tie(a.chart, a.entry->item) <= std::tie(b.chart, b.entry->item);
  const Placed &first = keep ? a : b, &second = keep ? b : a;
  return {kind,
          first.chart,
          second.chart,
          first.entry->item,
          second.entry->item,
          second.entry->image_x - first.entry->image_x,
          second.entry->image_y - first.entry->image_y,
          amount};
}

bool all_one_group(std::span<const Entry> entries) {
  return std::all_of(entries.begin(), entries.end(),
                     [&](const Entry& e) { return e.same_group(entries.front()); });
}

class GapFinder : public Visitor {
 public:
  GapFinder(const Space& space, const PairLimits& limits)
      : space_(space), limits_(limits), smallest_gap(limits.reach) {}

  [[nodiscard]] bool settled(std::span<const Entry> entries) const override {
    return worst.full() || all_one_group(entries);
  }

  void leaf(std::span<const Entry> entries, const Box2& /*region*/) override {
    compare_all(place(space_, entries));
  }

 private:
  /// A crowd of one group beside a few others must not cost the square of the crowd.
  void compare_all(const std::vector<Placed>& placed) {
    const auto [crowd, rest] = split_off_crowd(placed);
    if (crowd.empty()) {
      for (std::size_t i = 0; i < placed.size() && !worst.full(); ++i) {
        compare_onwards(placed[i], std::span(placed).subspan(i + 1));
      }
      return;
    }
    compare_two(crowd, rest);
    compare_all(rest);
  }

  void compare_two(const std::vector<Placed>& some, const std::vector<Placed>& others) {
    const std::vector<Placed> one = near_to(others, some), other = near_to(some, others);
    if (one.empty() || other.empty()) return;
    if (const auto [crowd, rest] = split_off_crowd(other); !rest.empty() && !crowd.empty()) {
      compare_two(one, crowd);
      compare_two(one, rest);
      return;
    }
    std::size_t i = 0, j = 0;
    while (i < one.size() && j < other.size() && !worst.full()) {
      if (one[i].box.min.x <= other[j].box.min.x) {
        compare_onwards(one[i++], std::span(other).subspan(j));
      } else {
        compare_onwards(other[j++], std::span(one).subspan(i));
      }
    }
  }

  /// The largest group, if it is a good part of many, and all others; else nothing and all.
  static std::pair<std::vector<Placed>, std::vector<Placed>> split_off_crowd(
      const std::vector<Placed>& placed) {
    constexpr std::size_t kMany = 256;
    if (placed.size() <= kMany) return {{}, placed};
    std::vector<Placed> crowd, rest;
    const Entry most = largest_group(placed);
    for (const Placed& p : placed) (p.entry->same_group(most) ? crowd : rest).push_back(p);
    if (4 * crowd.size() < placed.size()) return {{}, placed};
    return {std::move(crowd), std::move(rest)};
  }

  /// Those of `some` that are not too far from the box around `others`.
  [[nodiscard]] std::vector<Placed> near_to(const std::vector<Placed>& others,
                                            const std::vector<Placed>& some) const {
    Box2 all;
    for (const Placed& p : others) {
      all.add(p.box.min);
      all.add(p.box.max);
    }
    const double near = std::max(limits_.padding, smallest_gap);
    std::vector<Placed> kept;
    for (const Placed& p : some) {
      const double x = std::max(p.box.min.x - all.max.x, all.min.x - p.box.max.x);
      const double y = std::max(p.box.min.y - all.max.y, all.min.y - p.box.max.y);
      if (x <= near && y <= near) kept.push_back(p);
    }
    return kept;
  }

  static Entry largest_group(const std::vector<Placed>& placed) {
    std::vector<Entry> entries;
    for (const Placed& p : placed) entries.push_back(*p.entry);
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.group, a.image_x, a.image_y) < std::tie(b.group, b.image_x, b.image_y);
    });
    std::size_t best = 0, longest = 0;
    for (std::size_t i = 0, begin = 0; i < entries.size(); ++i) {
      if (!entries[i].same_group(entries[begin])) begin = i;
      if (i - begin >= longest) {
        longest = i - begin + 1;
        best = begin;
      }
    }
    return entries[best];
  }

  /// With those that begin right of where `a` begins, in that order.
  void compare_onwards(const Placed& a, std::span<const Placed> others) {
    for (const Placed& b : others) {
      const double near = std::max(limits_.padding, smallest_gap);
      if (b.box.min.x - a.box.max.x > near) break;
      if (a.entry->same_group(*b.entry)) continue;
      const double vertical = std::max(b.box.min.y - a.box.max.y, a.box.min.y - b.box.max.y);
      if (vertical <= near) compare(a, b);
    }
  }

  void compare(const Placed& a, const Placed& b) {
    const bool same_image =
        a.entry->image_x == b.entry->image_x && a.entry->image_y == b.entry->image_y;
    const bool pieces = a.stack == b.stack && same_image;
    if (pieces && a.chart != b.chart) return;
    if (surely_apart(a.corners, b.corners, std::max(limits_.padding, smallest_gap))) return;
    const Violation overlap = a.chart == b.chart ? Violation::self_overlap : Violation::overlap;
    const double tolerance = kSlack + limits_.rounding[a.chart] + limits_.rounding[b.chart];
    const double depth = overlap_depth(a.corners, b.corners, tolerance);
    if (depth > 0) worst.add(record_of(overlap, a, b, depth));
    if (pieces) return;
    const double distance = depth > 0 ? 0 : closest_points(a.corners, b.corners).distance;
    smallest_gap = std::min(smallest_gap, distance);
    if (distance < limits_.padding - tolerance) {
      worst.add(record_of(Violation::gap, a, b, distance));
    }
  }

  const Space& space_;
  const PairLimits& limits_;

 public:
  WorstList worst{kMostPairsPerShare};
  double smallest_gap;
};

class FoldFinder : public Visitor {
 public:
  FoldFinder(const Space& space, const PairLimits& limits) : space_(space), limits_(limits) {}

  [[nodiscard]] bool settled(std::span<const Entry> entries) const override {
    return entries.size() < 2;
  }

  void leaf(std::span<const Entry> entries, const Box2& region) override {
    if (entries.size() > kMostFoldCandidates) {
      complete = false;
      return;
    }
    const std::vector<Placed> placed = place(space_, entries);
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const Placed& a = placed[i];
      for (std::size_t j = i + 1; j < placed.size(); ++j) {
        const Placed& b = placed[j];
        if (b.box.min.x >= a.box.max.x) break;
        if (a.entry->group != b.entry->group || a.chart != b.chart) continue;
        const double low = std::max(a.box.min.y, b.box.min.y);
        const double high = std::min(a.box.max.y, b.box.max.y);
        // An overlap that is not in this region is found in the leaf that it is in.
        if (low >= high || high < region.min.y || b.box.min.x > region.max.x) continue;
        const double tolerance = kSlack + 2 * limits_.rounding[a.chart];
        const double depth = overlap_depth(a.corners, b.corners, tolerance);
        if (depth > 0) worst.add(record_of(Violation::self_overlap, a, b, depth));
      }
    }
  }

  WorstList worst{std::numeric_limits<std::size_t>::max()};  // charts are few enough
  bool complete = true;

 private:
  const Space& space_;
  const PairLimits& limits_;
};

class StackFinder : public Visitor {
 public:
  StackFinder(const Space& space, const PairLimits& limits, DisjointSets& stacks)
      : space_(space), limits_(limits), sets_(stacks) {}

  [[nodiscard]] bool settled(std::span<const Entry> entries) const override {
    return all_one_group(entries);
  }

  void leaf(std::span<const Entry> entries, const Box2& /*region*/) override {
    const std::vector<Placed> placed = place(space_, entries);
    std::vector<std::uint32_t> roots;
    for (const Placed& p : placed) roots.push_back(sets_.find(p.chart));
    std::sort(roots.begin(), roots.end());
    auto apart = std::unique(roots.begin(), roots.end()) - roots.begin();
    for (std::size_t i = 0; i < placed.size() && apart > 1; ++i) {
      const Placed& a = placed[i];
      for (std::size_t j = i + 1; j < placed.size() && apart > 1; ++j) {
        const Placed& b = placed[j];
        if (b.box.min.x >= a.box.max.x) break;
        if (b.box.min.y >= a.box.max.y || b.box.max.y <= a.box.min.y) continue;
        if (sets_.find(a.chart) == sets_.find(b.chart)) continue;
        const double tolerance = kSlack + limits_.rounding[a.chart] + limits_.rounding[b.chart];
        if (overlap_depth(a.corners, b.corners, tolerance) > 0) {
          sets_.join(a.chart, b.chart);
          --apart;
        }
      }
    }
  }

 private:
  const Space& space_;
  const PairLimits& limits_;
  DisjointSets& sets_;
};

/// Worse first within a pair and kind: deeper, closer; then by number, so that one order holds.
auto worst_first(const PairRecord& r) {
  const double badness = r.kind == Violation::gap ? r.amount : -r.amount;
  return std::tuple(r.chart_a, r.chart_b, r.kind == Violation::gap, r.kind, badness, r.item_a,
                    r.item_b, r.shift_x, r.shift_y);
}

bool same_pair(const PairRecord& a, const PairRecord& b) {
  return a.chart_a == b.chart_a && a.chart_b == b.chart_b && a.kind == b.kind;
}

}  // namespace

void WorstList::add(const PairRecord& record) {
  if (full_) return;
  records_.push_back(record);
  if (records_.size() < compact_at_) return;
  compact();
  compact_at_ = std::max<std::size_t>(4096, 2 * records_.size());
  full_ = records_.size() > most_;
}

void WorstList::compact() {
  std::sort(records_.begin(), records_.end(), [](const PairRecord& a, const PairRecord& b) {
    return worst_first(a) < worst_first(b);
  });
  records_.erase(std::unique(records_.begin(), records_.end(), same_pair), records_.end());
}

void WorstList::append(const WorstList& other) {
  records_.insert(records_.end(), other.records_.begin(), other.records_.end());
  full_ = full_ || other.full_;
}

Result<ClosePairs> find_close_pairs(std::span<const Item> items, Vec2 period,
                                    const PairLimits& limits) {
  const Space space{items, period, 0.5 * limits.reach + 0.01};
  auto visitors =
      divide(space, limits.threads, [&] { return std::make_unique<GapFinder>(space, limits); });
  if (!visitors) return visitors.error();
  ClosePairs found{{}, limits.reach, true};
  WorstList all(std::numeric_limits<std::size_t>::max());
  for (const auto& visitor : *visitors) {
    auto& finder = static_cast<GapFinder&>(*visitor);
    finder.worst.compact();
    all.append(finder.worst);
    finder.worst = WorstList(0);
    found.smallest_gap = std::min(found.smallest_gap, finder.smallest_gap);
  }
  all.compact();
  found.complete = !all.full();
  for (const PairRecord& record : all.records()) {  // what overlaps has no gap to speak of
    const bool told = !found.records.empty() && record.kind == Violation::gap &&
                      found.records.back().chart_a == record.chart_a &&
                      found.records.back().chart_b == record.chart_b;
    if (!told) found.records.push_back(record);
  }
  return found;
}

Result<ClosePairs> find_folds(std::span<const Item> items, const PairLimits& limits) {
  const Space space{items, {}, 0};
  auto visitors =
      divide(space, limits.threads, [&] { return std::make_unique<FoldFinder>(space, limits); });
  if (!visitors) return visitors.error();
  ClosePairs found;
  WorstList all(std::numeric_limits<std::size_t>::max());
  for (const auto& visitor : *visitors) {
    all.append(static_cast<FoldFinder&>(*visitor).worst);
    found.complete = found.complete && static_cast<FoldFinder&>(*visitor).complete;
  }
  all.compact();
  found.records = all.records();
  return found;
}

Result<std::vector<std::uint32_t>> find_stacks(std::span<const Item> items, std::size_t charts,
                                               const PairLimits& limits) {
  const Space space{items, {}, 0};
  DisjointSets sets(charts);  // shared by all shares, so one thread
  auto visitors =
      divide(space, 1, [&] { return std::make_unique<StackFinder>(space, limits, sets); });
  if (!visitors) return visitors.error();
  std::vector<std::uint32_t> stacks(charts);
  for (std::uint32_t i = 0; i < charts; ++i) stacks[i] = sets.find(i);
  return stacks;
}

}  // namespace wrapatlas::validate
