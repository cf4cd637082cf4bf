// Two segments, one of which is translated, meet first at an end of one of them. So it is enough to
// compare each two at the ends of the interval in which they overlap, as seen along the way.

#include "pack/first_contact.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

/// A segment in coordinates across the way and along it.
struct ContactSpan {
  double low, high;        ///< across, low < high
  double at_low, at_high;  ///< along

  [[nodiscard]] double at(double across) const {
    if (across <= low) return at_low;
    if (across >= high) return at_high;
    return at_low + (at_high - at_low) * ((across - low) / (high - low));
  }
};

bool meet(const Box2& a, const Box2& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

/// `box` wherever it comes on its way by `step`.
Box2 swept(const Box2& box, Vec2 step) {
  Box2 all = box;
  all.add(box.min + step);
  all.add(box.max + step);
  return all;
}

Box2 moved_by(const Box2& box, Vec2 step) { return {box.min + step, box.max + step}; }

/// The segments within a window. Those along the way are left out: their neighbours speak for them.
std::vector<ContactSpan> spans_of(const Outline& outline, Vec2 offset, const Box2& window,
                                  Vec2 along) {
  std::vector<ContactSpan> spans;
  for (const OutlineSegment& segment : outline.segments) {
    const Vec2 a = segment.from + offset, b = segment.to + offset;
    Box2 box;
    box.add(a);
    box.add(b);
    if (!meet(box, window)) continue;
    const double across_a = cross(along, a), across_b = cross(along, b);
    if (across_a < across_b) {
      spans.push_back({across_a, across_b, dot(along, a), dot(along, b)});
    } else if (across_b < across_a) {
      spans.push_back({across_b, across_a, dot(along, b), dot(along, a)});
    }
  }
  return spans;
}

}  // namespace

double first_contact(const Outline& still, const Outline& moved, Vec2 offset, Vec2 way,
                     double most) {
  const double distance = length(way);
  if (!(distance > 0) || still.segments.empty() || moved.segments.empty()) return most;
  const Vec2 along = (1 / distance) * way, reach = most * way;
  // What is nearer than rounding can tell touches.
  const double touching = 1e-9 * (distance + length(still.box.size()) + length(moved.box.size()));
  const Vec2 skin{touching, touching};
  const auto grown = [&](const Box2& box) { return Box2{box.min - skin, box.max + skin}; };
  const Box2 moved_box = grown(moved_by(moved.box, offset));
  const auto still_spans = spans_of(still, {0, 0}, swept(moved_box, reach), along);
  if (still_spans.empty()) return most;
  auto moved_spans = spans_of(moved, offset, swept(grown(still.box), Vec2{0, 0} - reach), along);
  std::sort(moved_spans.begin(), moved_spans.end(),
            [](const ContactSpan& a, const ContactSpan& b) { return a.low < b.low; });
  double widest = 0;
  for (const ContactSpan& span : moved_spans) widest = std::max(widest, span.high - span.low);

  double least = most * distance;
  for (const ContactSpan& a : still_spans) {
    auto b = std::lower_bound(moved_spans.begin(), moved_spans.end(), a.low - widest,
                              [](const ContactSpan& span, double low) { return span.low < low; });
    for (; b != moved_spans.end() && b->low < a.high; ++b) {
      const double low = std::max(a.low, b->low), high = std::min(a.high, b->high);
      if (!(low < high)) continue;
      const double gap_low = a.at(low) - b->at(low), gap_high = a.at(high) - b->at(high);
      const auto [nearer, farther] = std::minmax(gap_low, gap_high);
      if (nearer < -touching) {
        if (farther > touching) return 0;  // they cross
        continue;                          // left behind
      }
      least = std::min(least, std::max(nearer, 0.0));
    }
  }
  return std::min(most, least / distance);
}

}  // namespace wrapatlas
