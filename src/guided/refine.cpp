#include "guided/refine.h"

#include <algorithm>
#include <limits>

#include "guided/wrapped.h"

namespace wrapatlas {
namespace {

constexpr double kLeastScale = 0.5;  ///< of the first scale: below it, the layout is given up
/// Scales in a row at which the overlap has not fallen to this share of what it was before them.
constexpr int kMostInVain = 5;
constexpr double kHelped = 0.9;
constexpr int kMostTurned = kAngleSteps / 128;  ///< about what a layout's angles are rounded to

/// Turns charts that cannot lie in the domain at their angle, as a long one that winds around the
/// torus may lie on itself, to the nearest one at which they can. False: there is none near.
bool turn_to_fit(Layout& layout, PieceLibrary& library, const Domain& domain,
                 const Effort& effort) {
  for (std::size_t i = 0; i < layout.spots.size(); ++i) {
    const int first = layout.spots[i].angle;
    for (int k = 0; !admits(domain, library.piece(i, layout.spots[i].angle)); ++k) {
      if (k == 2 * kMostTurned || effort.spent()) {
        layout.spots[i].angle = first;
        return false;
      }
      const int turned = k % 2 == 0 ? k / 2 + 1 : -(k / 2 + 1);
      layout.spots[i].angle = modulo(first + turned, kAngleSteps);
    }
  }
  return true;
}

}  // namespace

Refined refine(std::span<const ChartShape> shapes, const Frame& frame, const PackOptions& options,
               const Layout& start, const RefineOptions& how, Effort& effort, Random& random) {
  const Domain domain = domain_of(frame, options.wrap);
  SeparateOptions separate;
  separate.window = how.window;
  separate.stall_rounds = how.stall_rounds;
  PieceOptions pieces;
  pieces.cores = false;  // no chart moves far
  const double area = total_area(shapes);
  Refined refined;
  std::optional<Packing>& best = refined.packing;
  Layout layout = start, good;
  double step = how.step_up;
  double least = std::numeric_limits<double>::max();  // overlap at any scale
  // A scale that is not tried again: the first one, on the way down, as the layout gets better on
  // the way; the last that failed, on the way up.
  double failed = std::numeric_limits<double>::infinity();
  int in_vain = 0;
  while (!effort.spent()) {
    PieceLibrary library(shapes, raster_scale_on(frame, layout.scale, options.coverage),
                         kAngleSteps, kLongestInDomains * std::max(frame.width, frame.height),
                         pieces);
    const bool fits = turn_to_fit(layout, library, domain, effort);
    std::vector<Place> places = to_places(layout, library, domain);
    Separator separator(library, domain, random);
    if (fits && separator.run(places, separate, effort)) {
      layout.spots = to_spots(places, library, domain);
      good = layout;
      std::int64_t covered_cells = 0;
      std::vector<Placement> placements;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Piece& piece = library.piece(i, places[i].angle);
        covered_cells += piece.cells;
        placements.push_back(place_on(frame, piece.angle, piece.offset, places[i].x, places[i].y));
      }
      best = make_packing(frame, options.wrap, layout.scale, area, std::move(placements),
                          covered_cells);
    } else if (!best) {
      // The next attempt begins where this one came closest.
      if (effort.spent()) break;
      if (fits && !how.exact) layout.spots = to_spots(places, library, domain);
      if (fits && how.gives_up) {
        const auto overlap = static_cast<double>(separator.least());
        if (overlap < kHelped * least) {
          least = overlap;
          in_vain = 0;
        } else if (++in_vain == kMostInVain) {
          refined.held = separator.overlapping();
          break;
        }
      }
      failed = start.scale;
      layout.scale *= 1 - how.step_down;
      if (layout.scale < std::max(how.least_scale, kLeastScale * start.scale)) break;
      continue;
    } else {
      failed = layout.scale;
      layout = good;
    }
    step = std::min(step, (failed / good.scale - 1) / 2);
    if (step < how.last_step) break;
    layout.scale = good.scale * (1 + step);
  }
  return refined;
}

}  // namespace wrapatlas
