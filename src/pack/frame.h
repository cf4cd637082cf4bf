// The search grid and how it lies on the texture.
#pragma once

#include "raster/chart_raster.h"
#include "wrapatlas/geometry.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// Grid cell (i, j) is the texel rectangle [origin + cell * i, origin + cell * (i + 1)), per axis.
/// On axes that wrap the cells tile the texture's length exactly. On others the grid is inset so
/// that a chart grown by half the padding, kept inside it, keeps its margin.
struct Frame {
  int texture_width = 0, texture_height = 0;  ///< texels
  int width = 0, height = 0;                  ///< cells
  Vec2 cell;                                  ///< texels per cell
  Vec2 origin;                                ///< texels
  double growth = 0;                          ///< cells by which charts are grown

  /// Texels that the cells cover.
  [[nodiscard]] Vec2 lengths() const { return {width * cell.x, height * cell.y}; }
  [[nodiscard]] double texels() const { return double(texture_width) * texture_height; }
};

/// Lays a grid over a texture. `cell` is the wished size in texels; it is rounded to what the wrap
/// and the block size allow. Errors: usage.
Result<Frame> make_frame(int texture_width, int texture_height, double cell,
                         const PackOptions& options);

/// A chart may wind around the torus, but not for ever: at most so many times the longer side.
inline constexpr int kLongestInDomains = 4;

/// How the cells of a frame relate to a chart's units. `scale`: texels per unit.
RasterScale raster_scale_on(const Frame& frame, double scale, Coverage coverage);

/// A chart whose raster has its cell (0,0) on cell (x, y) of the grid. `offset`: ChartRaster's.
Placement place_on(const Frame& frame, double angle, Vec2 offset, int x, int y);

/// A finished packing on pages of one frame. `area`: of all charts, input units^2; `covered`:
/// cells.
Packing make_packing(const Frame& frame, Wrap wrap, double scale, double area,
                     std::vector<Placement> placements, std::int64_t covered, int pages = 1);

/// Cells along a side: positions up to twice that must fit 16 bits (see slide.h).
inline constexpr int kMaxGridSide = 16383;

/// Texels of distance added to the padding so that it still holds after UVs are rounded to float:
/// two charts at u = v = 4 may each be off by half the last bit along both axes.
double padding_slack(int texture_width, int texture_height);

}  // namespace wrapatlas
