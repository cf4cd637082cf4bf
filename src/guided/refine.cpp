#include "guided/refine.h"

#include <algorithm>

namespace wrapatlas {
namespace {

constexpr double kSmallest = 0.5;  ///< of the first scale: below it, the layout is given up

}  // namespace

std::optional<FineLayout> refine(std::span<const ChartShape> shapes, const Frame& frame,
                                 const PackOptions& options, const Layout& start,
                                 const RefineOptions& how, Effort& effort, Random& random) {
  const Domain domain{frame.width, frame.height, wraps_u(options.wrap), wraps_v(options.wrap)};
  SeparateOptions separate;
  separate.window = how.window;
  separate.stall_rounds = how.stall_rounds;
  separate.angle_step = 12;
  separate.effort = &effort;
  std::optional<FineLayout> best;
  Layout layout = start;
  double step = how.first_step;
  while (!effort.spent()) {
    RasterScale scale;
    scale.cells_per_unit = {layout.scale / frame.cell.x, layout.scale / frame.cell.y};
    scale.growth = frame.growth;
    scale.coverage = options.coverage;
    PieceLibrary library(shapes, scale, kAngleSteps, 4 * std::max(frame.width, frame.height));
    std::vector<Place> places = to_places(layout, library, domain);
    bool fits = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
      fits = fits && admits(domain, library.piece(i, places[i].angle));
    }
    Separator separator(library, domain, random);
    if (fits && separator.run(places, separate)) {
      layout.spots = to_spots(places, library, domain);
      best.emplace();
      best->layout = layout;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Piece& piece = library.piece(i, places[i].angle);
        best->covered_cells += piece.cells;
        best->placements.push_back(
            place_on(frame, piece.angle, piece.offset, places[i].x, places[i].y));
      }
    } else if (!best) {
      // The next attempt begins where this one came closest.
      if (fits && !how.exact) layout.spots = to_spots(places, library, domain);
      layout.scale *= 1 - how.first_step;
      if (layout.scale < kSmallest * start.scale) break;
      continue;
    } else {
      layout = best->layout;
      step /= 2;
      if (step < how.last_step) break;
    }
    layout.scale = best->layout.scale * (1 + step);
  }
  return best;
}

}  // namespace wrapatlas
