// The side of the smallest square atlas at which charts keep their size.
#pragma once

namespace wrapatlas {

/// Sides to pack at, one after the other, whole fours. The scale of a packing is about a line over
/// the side, that begins above 0 as padding takes its share, and scatters by some percent: the line
/// through the last packings says where to go, and what was seen to be too small or enough keeps it
/// between. The first packings may be quick ones, as they rule no side out.
class SideSearch {
 public:
  static constexpr int kMost = 16384;  ///< the largest side tried

  /// About the side that is looked for, > 0; may be far above kMost.
  explicit SideSearch(double first) : side_(rounded(first)) {}

  [[nodiscard]] int side() const { return side_; }
  [[nodiscard]] bool is_quick() const { return quick_left_ > 0; }
  /// The smallest side so far at which the scale was 1 or more; 0: none.
  [[nodiscard]] int enough() const { return enough_; }

  /// Goes on to the next side, after a packing at side() of that scale; 0: there was no room at
  /// any. False: it is over, with enough(), or as not even kMost is.
  bool go_on(double scale);

 private:
  [[nodiscard]] int rounded(double side) const;
  [[nodiscard]] double promised(double scale);

  int too_small_ = 0, enough_ = 0;  ///< the search is between them; 0: not known
  int side_;
  int quick_left_ = 3, full_left_ = 6;
  int last_side_ = 0;
  double last_scale_ = 0, slope_ = 0;  ///< of the scale over the side; 0: not known
};

}  // namespace wrapatlas
