// The pieces of all charts at one scale, made when first asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "guided/piece.h"
#include "raster/chart_raster.h"
#include "wrapatlas/charts.h"

namespace wrapatlas {

/// What of a chart the search needs, whatever the scale.
struct ChartShape {
  RasterShape raster;
  double base_angle = 0;  ///< radians; angles are counted from here
  double area = 0;        ///< input units^2
  double extent = 0;      ///< input units^2, of its convex hull
  double thickness = 0;   ///< input units: of a strip as long as half its outline
};

/// Angles are counted from the smallest box.
std::vector<ChartShape> make_shapes(std::span<const Chart> charts);

double total_area(std::span<const ChartShape> shapes);

struct PieceOptions {
  /// Cells; thinner charts are grown to it, so that on a coarse grid they do not fall between the
  /// cells' centres.
  double least_thickness = 0;
  bool cores = true;  ///< to be made: of use where charts may go anywhere (see Piece)
};

/// Angle number k of a chart is base_angle + 2 pi k / angles. Not for several threads at once.
class PieceLibrary {
 public:
  PieceLibrary(std::span<const ChartShape> shapes, const RasterScale& scale, int angles,
               int max_side, const PieceOptions& options = {});

  [[nodiscard]] std::size_t charts() const { return shapes_.size(); }
  [[nodiscard]] int angles() const { return angles_; }
  /// No piece of the chart is longer, at any angle.
  [[nodiscard]] int reach(std::size_t chart) const { return reach_[chart]; }
  /// Stays valid until the chart's growth is set.
  const Piece& piece(std::size_t chart, int angle);

  /// Cells by which the chart is grown.
  [[nodiscard]] double growth(std::size_t chart) const { return growth_[chart]; }
  void set_growth(std::size_t chart, double cells);

 private:
  std::span<const ChartShape> shapes_;
  RasterScale scale_;
  std::vector<double> growth_;  ///< cells, per chart
  int angles_;
  int max_side_;
  bool cores_;
  std::vector<int> reach_;
  std::vector<std::unordered_map<int, std::unique_ptr<Piece>>> pieces_;
};

}  // namespace wrapatlas
