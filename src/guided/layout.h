// Where all charts lie, apart from any grid: what coarse and fine searches hand to each other.
#pragma once

#include <vector>

#include "guided/piece_library.h"
#include "guided/separate.h"
#include "pack/frame.h"

namespace wrapatlas {

/// Angles are counted in this many steps to a turn.
inline constexpr int kAngleSteps = 8192;

struct ChartSpot {
  int angle = 0;  ///< of kAngleSteps, from the chart's base angle
  Vec2 centre;    ///< of the chart, in units of the domain's width and height
};

struct Layout {
  double scale = 0;  ///< texels per input unit
  std::vector<ChartSpot> spots;
};

/// Where the charts of a finished packing lie, seen from the domain of a frame of its shape.
Layout to_layout(const Packing& packing, std::span<const ChartShape> shapes, const Frame& frame);

/// The nearest places on a grid. Angles are rounded to those of the library.
std::vector<Place> to_places(const Layout& layout, PieceLibrary& library, const Domain& domain);

/// What places on a grid mean.
std::vector<ChartSpot> to_spots(const std::vector<Place>& places, PieceLibrary& library,
                                const Domain& domain);

}  // namespace wrapatlas
