// How far one outline can be moved towards another.
#pragma once

#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

struct OutlineSegment {
  Vec2 from, to;
};

struct Outline {
  std::vector<OutlineSegment> segments;
  Box2 box;  ///< of the segments

  void add(Vec2 from, Vec2 to) {
    segments.push_back({from, to});
    box.add(from);
    box.add(to);
  }
};

/// `moved` stands at `offset` and goes by t * `way`, t from 0 on. Gives the least t at which it
/// meets `still`, or `most` if that is not before. Outlines that cross or touch have met at 0; to
/// glide along each other is no meeting. One that lies wholly within another is taken to lie in a
/// hole of it. All lengths in one unit. For m and n
/// segments within reach O((m + n) log n + pairs of them that overlap as seen along the way).
double first_contact(const Outline& still, const Outline& moved, Vec2 offset, Vec2 way,
                     double most);

}  // namespace wrapatlas
