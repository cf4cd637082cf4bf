#include "validate/divide.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace wrapatlas::validate {
namespace {

constexpr std::size_t kLeafSize = 24;
constexpr std::size_t kShares = 64;
constexpr int kMaxDepth = 80;
constexpr double kMostImages = 1 << 22;

struct Node {
  std::vector<Entry> entries;
  Box2 region;
  int depth = 0;
};

float below(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}
float above(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

Box2 grown(Box2 box, double by) { return {box.min - Vec2{by, by}, box.max + Vec2{by, by}}; }

Box2 box_of(const Entry& e) { return {{e.low_x, e.low_y}, {e.high_x, e.high_y}}; }

Box2 common_box(const Box2& a, const Box2& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

struct Range {
  double first, last;
};

/// Which images of [low, high] meet [0, period].
Range images(double low, double high, double period) {
  if (period == 0) return {0, 0};
  return {std::floor(low / period), std::floor(high / period)};
}

Result<Node> root_of(const Space& space) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Node root;
  root.region = {
      {space.period.x > 0 ? 0 : -kFar, space.period.y > 0 ? 0 : -kFar},
      {space.period.x > 0 ? space.period.x : kFar, space.period.y > 0 ? space.period.y : kFar}};
  root.entries.reserve(space.items.size() + space.items.size() / 8);
  double listed = 0;
  for (std::uint32_t i = 0; i < space.items.size(); ++i) {
    const Item& item = space.items[i];
    Box2 box;
    for (const Vec2 p : item.corners) box.add(p);
    box = grown(box, space.spread);
    const Range u = images(box.min.x, box.max.x, space.period.x);
    const Range v = images(box.min.y, box.max.y, space.period.y);
    const double count = (u.last - u.first + 1) * (v.last - v.first + 1);
    listed += count - 1;
    if (!(std::abs(u.first) + std::abs(u.last) + std::abs(v.first) + std::abs(v.last) < 1e8) ||
        listed > kMostImages) {
      return Error{ErrorKind::input, fmt::format("face {}", item.face),
                   "its UVs span too many repeats of the texture to be compared",
                   "shrink the UVs to the size of the atlas"};
    }
    for (auto x = static_cast<std::int32_t>(u.first); x <= static_cast<std::int32_t>(u.last); ++x) {
      for (auto y = static_cast<std::int32_t>(v.first); y <= static_cast<std::int32_t>(v.last);
           ++y) {
        const Vec2 shift{x * space.period.x, y * space.period.y};
        Entry entry{below(box.min.x - shift.x),
                    below(box.min.y - shift.y),
                    above(box.max.x - shift.x),
                    above(box.max.y - shift.y),
                    i,
                    item.group,
                    x,
                    y};
        if (count == 1 ||
            touches_box(space.image(entry), grown(root.region, 1.001 * space.spread))) {
          root.entries.push_back(entry);
        }
      }
    }
  }
  return root;
}

class Divider {
 public:
  explicit Divider(const Space& space) : space_(space) {}

  /// Two halves with distinctly fewer pairs, or nothing.
  bool split(const Node& node, Node halves[2]) {
    if (node.entries.size() <= kLeafSize || node.depth >= kMaxDepth) return false;
    Box2 all;
    for (const Entry& e : node.entries) {
      all.add({e.low_x, e.low_y});
      all.add({e.high_x, e.high_y});
    }
    const Box2 region = common_box(node.region, all);
    const bool wide = region.size().x >= region.size().y;
    return split_along(node, region, wide, halves) || split_along(node, region, !wide, halves);
  }

 private:
  double median(const Node& node, const Box2& region, bool along_x) {
    const double low = along_x ? region.min.x : region.min.y;
    const double high = along_x ? region.max.x : region.max.y;
    centres_.clear();
    const std::size_t step = 1 + node.entries.size() / 4096;  // a sample will do
    for (std::size_t i = 0; i < node.entries.size(); i += step) {
      const Entry& e = node.entries[i];
      const double from = along_x ? e.low_x : e.low_y, to = along_x ? e.high_x : e.high_y;
      centres_.push_back(0.5 * (std::clamp(from, low, high) + std::clamp(to, low, high)));
    }
    const auto middle = centres_.begin() + static_cast<std::ptrdiff_t>(centres_.size() / 2);
    std::nth_element(centres_.begin(), middle, centres_.end());
    return *middle;
  }

  bool split_along(const Node& node, const Box2& region, bool along_x, Node halves[2]) {
    const double at = median(node, region, along_x);
    for (int side = 0; side < 2; ++side) {
      halves[side].region = region;
      halves[side].depth = node.depth + 1;
      halves[side].entries.clear();
    }
    (along_x ? halves[0].region.max.x : halves[0].region.max.y) = at;
    (along_x ? halves[1].region.min.x : halves[1].region.min.y) = at;
    for (const Entry& e : node.entries) {
      const bool left = (along_x ? e.low_x : e.low_y) <= at;
      const bool right = (along_x ? e.high_x : e.high_y) >= at;
      if (left && (!right || reaches(e, halves[0].region))) halves[0].entries.push_back(e);
      if (right && (!left || reaches(e, halves[1].region))) halves[1].entries.push_back(e);
    }
    const auto pairs = [](const Node& n) {
      return static_cast<double>(n.entries.size()) * static_cast<double>(n.entries.size());
    };
    return pairs(halves[0]) + pairs(halves[1]) <= 0.85 * pairs(node);
  }

  /// The box of a long triangle says little about which parts of space it is in.
  [[nodiscard]] bool reaches(const Entry& e, const Box2& region) const {
    const Vec2 own = box_of(e).size(), size = region.size();
    if (own.x < 0.5 * size.x && own.y < 0.5 * size.y) return true;
    return touches_box(space_.image(e), grown(region, 1.001 * space_.spread));
  }

  const Space& space_;
  std::vector<double> centres_;
};

void walk(Divider& divider, const Node& node, Visitor& visitor) {
  if (node.entries.empty() || visitor.settled(node.entries)) return;
  Node halves[2];
  if (!divider.split(node, halves)) {
    visitor.leaf(node.entries, node.region);
    return;
  }
  walk(divider, halves[0], visitor);
  halves[0] = {};
  walk(divider, halves[1], visitor);
}

/// Divides the largest nodes first come, first served, until there are enough shares.
std::vector<Node> shares_of(const Space& space, Node root) {
  Divider divider(space);
  const std::size_t small = std::max<std::size_t>(2048, root.entries.size() / kShares);
  std::vector<Node> open, shares;
  open.push_back(std::move(root));
  while (!open.empty()) {
    Node node = std::move(open.back());
    open.pop_back();
    Node halves[2];
    if (node.entries.size() <= small || !divider.split(node, halves)) {
      shares.push_back(std::move(node));
      continue;
    }
    node = {};
    open.push_back(std::move(halves[1]));
    open.push_back(std::move(halves[0]));
  }
  return shares;
}

}  // namespace

Triangle Space::image(const Entry& entry) const {
  const Triangle& t = items[entry.item].corners;
  const Vec2 shift{entry.image_x * period.x, entry.image_y * period.y};
  return {t[0] - shift, t[1] - shift, t[2] - shift};
}

Result<std::vector<std::unique_ptr<Visitor>>> divide(
    const Space& space, int threads,
    const std::function<std::unique_ptr<Visitor>()>& make_visitor) {
  auto root = root_of(space);
  if (!root) return root.error();
  std::vector<Node> shares = shares_of(space, std::move(*root));
  std::vector<std::unique_ptr<Visitor>> visitors;
  for (std::size_t i = 0; i < shares.size(); ++i) visitors.push_back(make_visitor());

  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;  // memory may run out
  const auto work = [&] {
    try {
      Divider divider(space);
      for (std::size_t i = next++; i < shares.size(); i = next++) {
        walk(divider, shares[i], *visitors[i]);
        shares[i] = {};
      }
    } catch (...) {
      next = shares.size();
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::thread> helpers;
  const std::size_t wanted =
      threads > 0 ? static_cast<std::size_t>(threads) : std::thread::hardware_concurrency();
  try {
    for (std::size_t i = 1; i < std::min(wanted, shares.size()); ++i) helpers.emplace_back(work);
  } catch (const std::system_error&) {
    // The system gives no more threads: those there are do the work.
  }
  work();
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
  return visitors;
}

}  // namespace wrapatlas::validate
