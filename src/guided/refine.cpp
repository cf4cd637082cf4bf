#include "guided/refine.h"

#include <algorithm>

namespace wrapatlas {
namespace {

constexpr double kLeastScale = 0.5;  ///< of the first scale: below it, the layout is given up

}  // namespace

std::optional<Packing> refine(std::span<const ChartShape> shapes, const Frame& frame,
                              const PackOptions& options, const Layout& start,
                              const RefineOptions& how, Effort& effort, Random& random) {
  const Domain domain = domain_of(frame, options.wrap);
  SeparateOptions separate;
  separate.window = how.window;
  separate.stall_rounds = how.stall_rounds;
  separate.angle_step = 12;
  separate.effort = &effort;
  const double area = total_area(shapes);
  std::optional<Packing> best;
  Layout layout = start, good;
  double step = how.first_step;
  while (!effort.spent()) {
    PieceLibrary library(shapes, raster_scale_on(frame, layout.scale, options.coverage),
                         kAngleSteps, kLongestInDomains * std::max(frame.width, frame.height));
    std::vector<Place> places = to_places(layout, library, domain);
    bool fits = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
      fits = fits && admits(domain, library.piece(i, places[i].angle));
    }
    Separator separator(library, domain, random);
    if (fits && separator.run(places, separate)) {
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
      if (fits && !how.exact) layout.spots = to_spots(places, library, domain);
      layout.scale *= 1 - how.first_step;
      if (layout.scale < std::max(how.least_scale, kLeastScale * start.scale)) break;
      continue;
    } else {
      layout = good;
      step /= 2;
      if (step < how.last_step) break;
    }
    layout.scale = good.scale * (1 + step);
  }
  return best;
}

}  // namespace wrapatlas
