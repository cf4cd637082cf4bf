#include "guided/piece_library.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "charts/hull.h"

namespace wrapatlas {

namespace {

double thickness_of(const Chart& chart) {
  double outline = 0;
  for (const OutlineEdge& edge : chart.outline) {
    outline += length(chart.points[edge.to] - chart.points[edge.from]);
  }
  return outline > 0 ? 2 * chart.area / outline : 0;
}

}  // namespace

std::vector<ChartShape> make_shapes(std::span<const Chart> charts) {
  std::vector<ChartShape> shapes;
  for (const Chart& chart : charts) {
    const std::vector<Vec2> hull = convex_hull(chart.points);
    shapes.push_back({make_raster_shape(chart), -smallest_box_direction(hull), chart.area,
                      std::max(chart.area, hull_area(hull)), thickness_of(chart)});
  }
  return shapes;
}

double total_area(std::span<const ChartShape> shapes) {
  double area = 0;
  for (const ChartShape& shape : shapes) area += shape.area;
  return area;
}

PieceLibrary::PieceLibrary(std::span<const ChartShape> shapes, const RasterScale& scale, int angles,
                           int max_side, const PieceOptions& options)
    : shapes_(shapes),
      scale_(scale),
      angles_(angles),
      max_side_(max_side),
      cores_(options.cores),
      pieces_(shapes.size()) {
  const double cells_per_unit = std::max(scale.cells_per_unit.x, scale.cells_per_unit.y);
  growth_.resize(shapes.size());
  reach_.resize(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double missing = (options.least_thickness - shapes[i].thickness * cells_per_unit) / 2;
    set_growth(i, std::max(scale.growth, missing));
  }
}

void PieceLibrary::set_growth(std::size_t chart, double cells) {
  double radius = 0;
  for (const Vec2 p : shapes_[chart].raster.points) radius = std::max(radius, length(p));
  const double cells_per_unit = std::max(scale_.cells_per_unit.x, scale_.cells_per_unit.y);
  const double longest = std::ceil(2 * (radius * cells_per_unit + cells)) + 1;
  growth_[chart] = cells;
  reach_[chart] = static_cast<int>(std::min<double>(longest, max_side_));
  pieces_[chart].clear();
}

const Piece& PieceLibrary::piece(std::size_t chart, int angle) {
  std::unique_ptr<Piece>& slot = pieces_[chart][angle];
  if (!slot) {
    const ChartShape& shape = shapes_[chart];
    const double radians = shape.base_angle + 2 * std::numbers::pi * angle / angles_;
    RasterScale scale = scale_;
    scale.growth = growth_[chart];
    const ChartRaster raster = rasterize_cells(shape.raster, scale, radians, max_side_);
    slot = std::make_unique<Piece>(make_piece(raster));
    if (cores_ && raster.width > 0) slot->core = core_of(*raster.unturned);
  }
  return *slot;
}

}  // namespace wrapatlas
