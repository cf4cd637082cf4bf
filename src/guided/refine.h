// From a layout found on a coarse grid to a packing that keeps its promises: the last grid is fine
// and conservative, moves are small, and the scale grows until nothing gives any more.
#pragma once

#include <optional>
#include <span>

#include "guided/effort.h"
#include "guided/layout.h"
#include "guided/random.h"
#include "pack/frame.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

struct RefineOptions {
  double step_down = 0.01;    ///< of the scale, relative, until something holds
  double step_up = 0.005;     ///< from then on, at first
  double last_step = 0.0005;  ///< no smaller step up is tried
  int stall_rounds = 10;
  int window = 6;          ///< cells
  double least_scale = 0;  ///< texels per input unit; below it no first success is sought
  bool exact = false;  ///< the layout is right but for its scale: each attempt begins with it anew
  bool gives_up = false;  ///< where charts hold each other, and no scale is likely to help
};

struct Refined {
  std::optional<Packing> packing;  ///< nothing: the effort was spent before, or there is none
  /// If it gave up: the charts that still overlapped. They may hold each other as a hook a ring.
  std::vector<std::size_t> held;
};

/// The layout, slightly moved, at the largest scale at which it is valid on the final grid.
Refined refine(std::span<const ChartShape> shapes, const Frame& frame, const PackOptions& options,
               const Layout& start, const RefineOptions& how, Effort& effort, Random& random);

}  // namespace wrapatlas
