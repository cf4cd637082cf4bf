// Guided separation: charts that overlap are moved, one at a time, to where they cost least, while
// pairs that go on overlapping become dearer.
#pragma once

#include <cstdint>
#include <vector>

#include "guided/best_shift.h"
#include "guided/cover.h"
#include "guided/effort.h"
#include "guided/field.h"
#include "guided/piece.h"
#include "guided/piece_library.h"
#include "guided/random.h"

namespace wrapatlas {

/// Where one chart lies: a piece of it, and the cell its cell (0,0) is on.
struct Place {
  int angle = 0;  ///< number of the library's
  int x = 0, y = 0;
};

struct SeparateOptions {
  int stall_rounds = 40;   ///< rounds without 2 % less overlap after which it gives up
  int window = 0;          ///< cells that a chart may move at a time; 0: anywhere
  double any_angles = 16;  ///< without a window: so many angles are looked at in a move, about,
  int near_angles = 2;     ///< and so many to each side of the chart's own
};

class Separator {
 public:
  Separator(PieceLibrary& library, const Domain& domain, Random& random);

  /// Moves charts until none overlap. Otherwise false, with the places of least overlap met.
  /// `effort` counts the moves and says when it is enough.
  bool run(std::vector<Place>& places, const SeparateOptions& options, Effort& effort);
  /// Cells of the least overlap met at the end of a round of the last run.
  [[nodiscard]] std::int64_t least() const { return least_; }
  /// The charts that overlap in what the last run ended with, if it was not cut short.
  [[nodiscard]] std::vector<std::size_t> overlapping() const;

 private:
  void take(const std::vector<Place>& places);
  void put(std::size_t chart, const Place& place);
  void move_anywhere(std::size_t chart, const SeparateOptions& options);
  void move_nearby(std::size_t chart, const SeparateOptions& options);
  void fill_field(std::size_t chart, const Stretch& x, const Stretch& y);
  void raise_weights();
  [[nodiscard]] bool overlaps(std::size_t chart) const;
  [[nodiscard]] std::int64_t total() const;
  [[nodiscard]] std::size_t pair(std::size_t a, std::size_t b) const { return a * count_ + b; }

  PieceLibrary& library_;
  Domain domain_;
  Random& random_;
  std::size_t count_;
  std::vector<Place> places_;
  std::vector<Cover> covers_;
  std::vector<std::int32_t> overlap_;  ///< cells, per pair
  std::vector<float> weight_;          ///< per pair, 1 at rest
  Field field_;
  std::int64_t least_ = 0;
};

}  // namespace wrapatlas
