#include "guided/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "guided/wrapped.h"

namespace wrapatlas {
namespace {

int cell_of(double centre, double piece_centre, int size, int length, bool wraps) {
  const int cell = static_cast<int>(std::lround(centre * size - piece_centre));
  if (!wraps) return std::clamp(cell, 0, std::max(0, size - length));
  return modulo(cell, size);
}

}  // namespace

Layout to_layout(const Packing& packing, std::span<const ChartShape> shapes, const Frame& frame) {
  Layout layout;
  layout.scale = packing.scale;
  const Vec2 lengths = frame.lengths();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double turns =
        (packing.placements[i].angle - shapes[i].base_angle) / (2 * std::numbers::pi);
    const int angle = modulo(static_cast<int>(std::lround(turns * kAngleSteps)), kAngleSteps);
    const Vec2 centre = packing.transform(i).apply(shapes[i].raster.centre) - frame.origin;
    layout.spots.push_back({angle, {centre.x / lengths.x, centre.y / lengths.y}});
  }
  return layout;
}

std::vector<Place> to_places(const Layout& layout, PieceLibrary& library, const Domain& domain) {
  std::vector<Place> places(layout.spots.size());
  const int step = kAngleSteps / library.angles();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ChartSpot& spot = layout.spots[i];
    const int angle = (spot.angle + step / 2) / step % library.angles();
    const Piece& piece = library.piece(i, angle);
    places[i] = {
        angle, cell_of(spot.centre.x, piece.centre.x, domain.width, piece.width, domain.wraps_x),
        cell_of(spot.centre.y, piece.centre.y, domain.height, piece.height, domain.wraps_y)};
  }
  return places;
}

std::vector<ChartSpot> to_spots(const std::vector<Place>& places, PieceLibrary& library,
                                const Domain& domain) {
  std::vector<ChartSpot> spots(places.size());
  for (std::size_t i = 0; i < spots.size(); ++i) {
    const Piece& piece = library.piece(i, places[i].angle);
    spots[i] = {places[i].angle * (kAngleSteps / library.angles()),
                {(places[i].x + piece.centre.x) / domain.width,
                 (places[i].y + piece.centre.y) / domain.height}};
  }
  return spots;
}

}  // namespace wrapatlas
