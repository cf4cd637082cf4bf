// The search for a dense layout on a coarse grid: charts keep their size and the domain shrinks
// around them, a cell at a time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "guided/effort.h"
#include "guided/layout.h"
#include "guided/random.h"
#include "guided/separate.h"

namespace wrapatlas {

struct CoarseOptions {
  int side = 0;         ///< cells along the side of a square domain packed to 85 %
  int angles = 128;     ///< that a chart can have; divides kAngleSteps
  double start = 0.55;  ///< efficiency on the first domain, if that has room for all charts
  double grown = 0;     ///< texels by which charts are grown
  int stall_rounds = 100;
  int hasty_rounds = 40;   ///< instead, where it is to run until it is stuck
  int patience = 40;       ///< disturbances that lead to nothing before it begins anew
  bool any_shape = false;  ///< of domain: the search begins with the one given, and may leave it
};

/// A layout found on the coarse grid, to be refined.
struct CoarseFind {
  double aspect = 1;  ///< of its domain, width by height
  Layout layout;      ///< with its scale for a domain of area 1

  /// The layout for a domain of this size in texels, and of the aspect, about.
  [[nodiscard]] Layout on(Vec2 lengths) const;
};

/// One line of search on one shape of domain.
class CoarseSearch {
 public:
  /// `lengths`: of the domain, texels.
  CoarseSearch(std::span<const ChartShape> shapes, Vec2 lengths, bool wraps_x, bool wraps_y,
               const CoarseOptions& options, std::uint64_t seed);

  /// Begins with this layout, in place of charts anywhere or of what was found so far.
  void begin_with(const Layout& layout);
  /// Goes on until the effort is spent, or `until_stuck` and a domain has not been filled. Gives up
  /// where no domain is large enough, for charts very long beside their area.
  void run(Effort& effort, bool until_stuck);

  [[nodiscard]] bool found() const { return !best_.places.empty(); }
  /// The smallest domain filled so far. Precondition: found().
  [[nodiscard]] CoarseFind best();
  /// Up to so many layouts, of domains smaller than the best, in which charts overlap a little, as
  /// they may not on a finer grid; of those met since a domain was last filled. Precondition:
  /// found().
  [[nodiscard]] std::vector<CoarseFind> near(std::size_t count);
  /// Share of the domain that its charts cover, an estimate.
  [[nodiscard]] double efficiency() const;
  /// Draws charts that held each other on a finer grid a little larger, and goes on from the best
  /// layout, which is the best no more. False: all of them are as large as they may be.
  bool enlarge(std::span<const std::size_t> charts);
  /// Takes over a layout of the same charts and shape of domain, and what is drawn larger.
  void adopt(const CoarseSearch& other);

 private:
  /// Where charts lie on a domain.
  struct Attempt {
    Domain domain;
    std::vector<Place> places;
  };
  struct Near {
    std::int64_t overlap;  ///< cells
    Attempt attempt;
  };

  [[nodiscard]] Domain of_area(double area, double aspect) const;
  void turn();
  [[nodiscard]] Domain smaller(const Domain& than, int steps);
  [[nodiscard]] bool fit_angles(const Domain& domain, std::vector<Place>& places);
  void begin_anew();
  [[nodiscard]] CoarseFind find_of(const Attempt& attempt);
  void forget();
  void keep_near(std::int64_t overlap, const std::vector<Place>& places);
  void retreat();
  [[nodiscard]] std::size_t any_chart();
  void disturb(std::vector<Place>& places, const Domain& domain);

  std::span<const ChartShape> shapes_;
  double texels_;  ///< of the domain
  double aspect_;  ///< of the domain, width by height
  bool wraps_x_, wraps_y_;
  CoarseOptions options_;
  double cells_per_unit_ = 0, area_ = 0;
  std::unique_ptr<PieceLibrary> library_;
  Random random_;
  double first_area_ = 0;  ///< of the first domain, cells
  Domain domain_;          ///< now tried
  Attempt from_;           ///< what is tried on it
  double drift_ = 0;       ///< of the aspect from one domain to the next, log2
  int stride_ = 1;         ///< steps from one domain to the next
  bool gave_up_ = false;   ///< no domain was large enough
  int failures_ = 0;       ///< since a domain was filled
  Attempt filled_;         ///< the smallest domain since it began anew; without places: none
  /// The layouts that did not fill a domain a step smaller, that of least overlap first.
  std::vector<Near> near_;
  std::vector<double> chances_;  ///< of charts to be disturbed, each with those before it
  std::vector<int> enlarged_;    ///< how often, per chart
  Attempt best_;                 ///< the smallest domain ever; without places: none
};

}  // namespace wrapatlas
