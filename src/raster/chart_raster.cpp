#include "raster/chart_raster.h"

#include <algorithm>
#include <cmath>

#include "raster/inside_fill.h"
#include "raster/row_scan.h"
#include "raster/silhouette.h"

namespace wrapatlas {
namespace {

/// Cells whose centre lies in a triangle, or which the triangle enters.
void cover_triangle(const std::array<Vec2, 3>& corner, Coverage coverage, BitLanes& rows) {
  const auto [low, high] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
  for (int y = row_of(low, rows); y <= row_of(high, rows); ++y) {
    Interval cells;
    if (coverage == Coverage::conservative) {
      for (std::size_t i = 0; i < 3; ++i)
        cells.add(segment_in_band(corner[i], corner[(i + 1) % 3], y));
      set_entered(rows, y, cells);
    } else {
      for (std::size_t i = 0; i < 3; ++i)
        cells.add(segment_at(corner[i], corner[(i + 1) % 3], y + 0.5));
      set_centres(rows, y, cells);
    }
  }
}

/// The covered part of a raster: centre coverage can leave its outermost rows and columns bare.
BitLanes cropped(const BitLanes& rows, int first_row, int last_row, int first_cell, int last_cell) {
  BitLanes result(last_row - first_row + 1, last_cell - first_cell + 1);
  for (int y = 0; y < result.lanes; ++y) {
    for_each_run(rows.lane(first_row + y), rows.length, [&](int begin, int end) {
      set_span(result.lane(y), begin - first_cell, end - first_cell);
    });
  }
  return result;
}

/// Cuts bare rows and columns off, and moves the raster's origin with them.
void crop(BitLanes& rows, Vec2& offset) {
  int first_row = rows.lanes, last_row = -1, first_cell = rows.length, last_cell = -1;
  for (int y = 0; y < rows.lanes; ++y) {
    const int last = last_set(rows.lane(y), rows.length);
    if (last < 0) continue;
    first_row = std::min(first_row, y);
    last_row = y;
    first_cell = std::min(first_cell, next_set(rows.lane(y), rows.length, 0));
    last_cell = std::max(last_cell, last);
  }
  if (first_row == 0 && first_cell == 0 && last_row == rows.lanes - 1 &&
      last_cell == rows.length - 1) {
    return;
  }
  rows = cropped(rows, first_row, last_row, first_cell, last_cell);
  offset = offset - Vec2{double(first_cell), double(first_row)};
}

}  // namespace

RasterShape make_raster_shape(const Chart& chart) {
  RasterShape shape;
  shape.simple = chart.overlap == 0 && chart.against_grain.empty();
  if (!chart.box.empty()) shape.centre = 0.5 * (chart.box.min + chart.box.max);
  std::vector<std::uint32_t> renumbered(chart.points.size(), kNone);
  const auto use = [&](std::uint32_t point) {
    if (renumbered[point] == kNone) {
      renumbered[point] = static_cast<std::uint32_t>(shape.points.size());
      shape.points.push_back(chart.points[point] - shape.centre);
    }
    return renumbered[point];
  };
  shape.edges.reserve(chart.outline.size());
  for (const OutlineEdge& edge : chart.outline) {
    const std::uint32_t from = use(edge.from);
    shape.edges.push_back({from, use(edge.to), edge.winding});
    if (std::abs(edge.winding) > 1) shape.simple = false;
  }
  for (const std::uint32_t triangle : chart.against_grain) {
    const auto& corner = chart.triangles[triangle];
    const std::uint32_t a = use(corner[0]), b = use(corner[1]);
    shape.triangles.push_back({a, b, use(corner[2])});
  }
  return shape;
}

ChartRaster rasterize_cells(const RasterShape& shape, const RasterScale& scale, double angle,
                            int max_side) {
  const double growth = std::max(scale.growth, 0.0);
  const double cos_angle = std::cos(angle), sin_angle = std::sin(angle);
  thread_local std::vector<Vec2> points;
  points.resize(shape.points.size());
  Box2 box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = shape.points[i];
    points[i] = {(cos_angle * p.x - sin_angle * p.y) * scale.cells_per_unit.x,
                 (sin_angle * p.x + cos_angle * p.y) * scale.cells_per_unit.y};
    box.add(points[i]);
  }
  if (box.empty()) box.add({0, 0});

  ChartRaster raster;
  raster.angle = angle;
  const Vec2 size = box.size() + Vec2{2 * growth, 2 * growth};
  if (!(std::max(size.x, size.y) <= std::min(max_side, kMaxRasterSide))) return raster;
  raster.width = std::max(1, static_cast<int>(std::ceil(size.x)));
  raster.height = std::max(1, static_cast<int>(std::ceil(size.y)));
  const Vec2 shift = Vec2{growth, growth} - box.min;
  for (Vec2& p : points) p = p + shift;
  // Points of the chart reach cell space through M (p - centre) + shift.
  const Vec2 centre = {
      (cos_angle * shape.centre.x - sin_angle * shape.centre.y) * scale.cells_per_unit.x,
      (sin_angle * shape.centre.x + cos_angle * shape.centre.y) * scale.cells_per_unit.y};
  raster.offset = shift - centre;

  BitLanes rows(raster.height, raster.width);
  fill_inside(shape, points, rows);
  for (const auto& corner : shape.triangles) {
    cover_triangle({points[corner[0]], points[corner[1]], points[corner[2]]}, scale.coverage, rows);
  }
  const auto cover_edge = [&](Vec2 a, Vec2 b) {
    if (scale.coverage == Coverage::conservative) {
      cover_capsule(a, b, growth, rows);
    } else if (growth > 0) {
      cover_capsule_centres(a, b, growth, rows);
    }
  };
  for (const RasterShape::Edge& edge : shape.edges) cover_edge(points[edge.from], points[edge.to]);
  for (const auto& corner : shape.triangles) {
    for (std::size_t i = 0; i < 3; ++i) cover_edge(points[corner[i]], points[corner[(i + 1) % 3]]);
  }
  raster.cells = count_set(rows);
  if (raster.cells == 0) {
    rows.set(std::min(raster.height - 1, raster.height / 2),
             std::min(raster.width - 1, raster.width / 2));
    raster.cells = 1;
  }
  if (scale.coverage == Coverage::center) {
    crop(rows, raster.offset);
    raster.width = rows.length;
    raster.height = rows.lanes;
  }
  raster.centre = centre + raster.offset;
  raster.unturned = std::make_shared<const BitLanes>(std::move(rows));
  return raster;
}

ChartRaster rasterize(const RasterShape& shape, const RasterScale& scale, double angle,
                      int max_side) {
  ChartRaster raster = rasterize_cells(shape, scale, angle, max_side);
  if (raster.width == 0) return raster;
  raster.rows = lane_silhouette(*raster.unturned, raster.cells);
  raster.columns = cross_silhouette(*raster.unturned, raster.cells);
  return raster;
}

}  // namespace wrapatlas
