#include "raster/row_scan.h"

namespace wrapatlas {
namespace {

/// The capsule between two heights is the hull of two discs; its x extent there is that of the
/// discs and of the two straight sides.
struct Capsule {
  Vec2 a, b;
  double radius;
  Vec2 side;  ///< from the axis to its right side, length radius

  Capsule(Vec2 from, Vec2 to, double r) : a(from), b(to), radius(r) {
    const Vec2 along = to - from;
    const double norm = length(along);
    if (norm > 0) {
      side = {radius / norm * along.y, -radius / norm * along.x};
      if (side.x < 0) side = {-side.x, -side.y};
    }
  }
};

}  // namespace

void cover_capsule(Vec2 a, Vec2 b, double radius, BitLanes& rows) {
  const int begin = row_of(std::min(a.y, b.y) - radius, rows);
  const int end = row_of(std::max(a.y, b.y) + radius, rows);
  if (radius == 0) {
    for (int y = begin; y <= end; ++y) set_entered(rows, y, segment_in_band(a, b, y));
    return;
  }
  const Capsule capsule(a, b, radius);
  for (int y = begin; y <= end; ++y) {
    Interval x = disc_between(a, radius, y, y + 1.0);
    x.add(disc_between(b, radius, y, y + 1.0));
    x.add(segment_in_band(a + capsule.side, b + capsule.side, y));
    x.add(segment_in_band(a - capsule.side, b - capsule.side, y));
    set_entered(rows, y, x);
  }
}

void cover_capsule_centres(Vec2 a, Vec2 b, double radius, BitLanes& rows) {
  const Capsule capsule(a, b, radius);
  const int begin = row_of(std::min(a.y, b.y) - radius, rows);
  const int end = row_of(std::max(a.y, b.y) + radius, rows);
  for (int y = begin; y <= end; ++y) {
    const double centre = y + 0.5;
    Interval x = disc_between(a, radius, centre, centre);
    x.add(disc_between(b, radius, centre, centre));
    x.add(segment_at(a + capsule.side, b + capsule.side, centre));
    x.add(segment_at(a - capsule.side, b - capsule.side, centre));
    set_centres(rows, y, x);
  }
}

}  // namespace wrapatlas
