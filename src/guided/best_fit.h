// Best fit: a page is filled chart by chart, each where most of its outline touches what is there.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "guided/contact.h"
#include "guided/free_map.h"
#include "guided/piece_library.h"
#include "pack/frame.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// How thoroughly places are looked for.
struct BestFitCare {
  double cells_along;  ///< of a chart, on the board where its place is sought
  int enough;       ///< tight translations after which a large board need not be looked at further
  bool all_angles;  ///< also for the smallest charts
};
BestFitCare care_for(std::size_t charts, bool hurried);

/// One page at one scale. Charts have to come by decreasing extent, roughly: each is first looked
/// for a place on a board whose cells are as large as its size allows, and then moved into contact
/// on the board of the frame, which alone decides what is free.
class BestFitPage {
 public:
  BestFitPage(const Frame& frame, Wrap wrap, Coverage coverage, double scale,
              const BestFitCare& care);

  struct Spot {
    Placement placement;
    std::int64_t cells = 0;  ///< of the frame's grid that it covers
  };
  /// Puts a chart at the best of the angles (radians), or nowhere if none is found.
  std::optional<Spot> place(const ChartShape& shape, std::span<const double> angles);
  /// Puts a chart that place() found no room for into the corner of the empty page, where its exact
  /// size decides; nowhere only if it is larger than the page at every angle.
  std::optional<Spot> place_alone(const RasterShape& shape, std::span<const double> angles);

 private:
  struct Candidate {
    double angle = 0;
    Vec2 at;  ///< fine cells, of the chart's box centre
    double contact = 0;
  };
  [[nodiscard]] RasterScale raster_scale(std::size_t halvings) const;
  void use_board(std::size_t halvings, double extent);
  void seek(const RasterShape& shape, std::span<const double> angles, bool everywhere);
  std::optional<Spot> settle(const RasterShape& shape, const Candidate& candidate);
  void take(const Piece& piece, int x, int y);
  [[nodiscard]] Occupancy& board() { return halvings_ > 0 ? *boards_[halvings_].cells : fine_; }

  Frame frame_;
  Coverage coverage_;
  double scale_;
  BestFitCare care_;
  Occupancy fine_;
  struct Board {
    std::unique_ptr<Occupancy> cells;  ///< none before it is asked for, and of number 0: fine_
    int first_row = 0;                 ///< above it charts of this size found no place
    double row_extent = 0;             ///< of the charts that first_row is for
  };
  /// By how often their cells are halved: charts of all sizes come in any order of areas.
  std::vector<Board> boards_;
  std::size_t halvings_ =
      0;  ///< of the board at hand: its cells are 2^halvings_ of the frame's long
  FreeMap free_;
  std::vector<Candidate> candidates_;
  std::vector<CellShift> shifts_;
};

/// `count` uniform angles (radians) from a base on.
std::vector<double> best_fit_angles(double base, int count);

}  // namespace wrapatlas
