// Packing: one common scale, and for each chart a rotation and a translation.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/geometry.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

enum class Method { lprm02, swg03, zsgs04, modulo, guided };

/// Which axes of the atlas are cyclic.
enum class Wrap { none, u, v, uv };
inline bool wraps_u(Wrap wrap) { return wrap == Wrap::u || wrap == Wrap::uv; }
inline bool wraps_v(Wrap wrap) { return wrap == Wrap::v || wrap == Wrap::uv; }
inline Wrap wrap_on(bool u, bool v) {
  if (u) return v ? Wrap::uv : Wrap::u;
  return v ? Wrap::v : Wrap::none;
}

/// When does a grid cell belong to a chart?
enum class Coverage {
  center,        ///< if its centre does: the paper's rule; charts may overlap by part of a cell
  conservative,  ///< if any part of the chart, grown by half the padding, touches it: safe
};

/// Where the angles of a chart are counted from.
enum class RotationBase {
  input,  ///< from its UV axes as they came (the paper)
  box,    ///< from the sides of its smallest enclosing rectangle
};

/// The shape of the atlas, at the area of width * height.
enum class Aspect {
  fixed,   ///< width x height
  search,  ///< the best of the paper's 31 ratios from 1:8 to 8:1; by guided also those between
  pow2,    ///< the best of those whose sides are powers of two, from 1:16 to 16:1
};

/// How far a packing has come; passed to PackOptions::progress.
struct Progress {
  double fraction = 0;         ///< of the work, an estimate in [0, 1]
  double best_efficiency = 0;  ///< 0 while there is none
};

inline constexpr int kMostTexels = 65536;  ///< along a side of an atlas
inline constexpr int kMostPages = 1000;

struct PackOptions {
  Method method = Method::guided;
  Wrap wrap = Wrap::uv;  ///< the baselines know `none` only
  int width = 1024;      ///< texels of the final texture; 1 to kMostTexels
  int height = 1024;     ///< the same
  Aspect aspect = Aspect::fixed;
  double padding = 2;  ///< texels between charts, Euclidean; 0 to 4096
  double margin = -1;  ///< texels to a side that does not wrap; to 65536; < 0: half the padding
  int block = 1;       ///< 1 to 64: no two charts share a block of this many texels a side
  int rotations = 16;  ///< 1 to 3600: angles a chart is tried at, uniform over the circle
  RotationBase rotation_base = RotationBase::input;
  int grid = 0;  ///< cells along the longer side of the search grid, up to 8192; 0: chosen
  Coverage coverage = Coverage::conservative;
  double start_upper = 1.0;  ///< upper end of the scale search at its start, in (0, 1] (paper: 0.9)
  double lambda = 1.1;       ///< penalty of outer placements (modulo), 0 to 1e6
  bool inner = true;         ///< modulo: also try the four inner strategies
  bool all_sides = false;    ///< zsgs04: try all four sides for every chart
  double time = 1;           ///< guided: seconds to search, 0 to 1e6; 0: until it is stuck once
  std::int64_t moves = 0;    ///< guided: if > 0, so many moves of charts instead of `time`,
                             ///< but for more than 1,000 charts: see docs/algorithms/guided.md
  int threads = 0;           ///< 0: as many as the machine has
  std::uint64_t seed = 0;    ///< guided: of its random numbers; the others draw none

  /// guided: texels per input UV unit, a scale that is kept exactly; 0: the largest is sought.
  double density = 0;
  /// Pages of width * height that may be used, 1 to kMostPages; all but guided have one. 0: as many
  /// as are needed, for a given density alone.
  int pages = 1;

  /// Called now and then from any thread, one call at a time; false ends the search early with
  /// the best packing so far.
  std::function<bool(const Progress&)> progress;
};

/// UV units by which rounding to 32-bit floats may move a coordinate where there are so many pages.
double page_rounding(int pages);

/// Where a page lies in UV space, as UDIM numbers them: ten to a row, tile 1001 + column + 10 row.
struct PageTile {
  int column = 0, row = 0;
};
inline constexpr int kPageColumns = 10;
inline PageTile page_tile(int page) { return {page % kPageColumns, page / kPageColumns}; }

/// Chart -> texel space of its page: texel = scale * R(angle) * uv + translation.
struct Placement {
  double angle = 0;  ///< radians, counter-clockwise in UV axes
  Vec2 translation;  ///< texels
  int page = 0;      ///< from 0 on
};

struct Packing {
  int width = 0, height = 0;  ///< texels; differ from the options' where the aspect was searched
  Wrap wrap = Wrap::none;
  double scale = 0;                   ///< texels per input UV unit, common to all charts
  std::vector<Placement> placements;  ///< one per chart, in the order given
  int pages = 1;                      ///< in use, each of width x height; none is empty
  double efficiency = 0;         ///< (sum of chart areas at `scale`) / (pages * width * height)
  double raster_efficiency = 0;  ///< covered cells / cells of the grid, of all pages
  int grid_width = 0, grid_height = 0;
  int packings = 0;                              ///< placement runs made
  bool interrupted = false;                      ///< progress asked to stop
  double raster_seconds = 0, place_seconds = 0;  ///< summed over threads

  [[nodiscard]] Similarity transform(std::size_t chart) const {
    const Placement& p = placements[chart];
    return Similarity::from(scale, p.angle, p.translation);
  }
};

/// Packs all charts into one page, or several. Promise (coverage `conservative`): any two charts of
/// a page, and any chart and its own image under the wrap, are at least `padding` texels apart, and
/// `margin` from a side that does not wrap. A chart of zero extent is placed like a dot.
/// Without a density: one scale, as large as it finds, at which all go onto `pages` pages. With
/// one: as few pages as it finds.
/// Errors: usage (bad options), input (no chart has an area but for rounding), no_packing (nothing
/// fits at any scale tried; or, at the density asked for, a chart is larger than a page, or more
/// pages are needed than allowed), interrupted (stopped before the first packing). No charts at all
/// is a usage error.
/// The same charts and options give the same bits for any number of threads and on any machine;
/// from guided only if `moves` is not 0, or `time` is: else it goes by the clock.
Result<Packing> pack(std::span<const Chart> charts, const PackOptions& options);

/// What pack() finds on each shape of texture that options.aspect asks for, the most square first;
/// pack() gives the densest of them. Where none was found there are no placements, and the scale is
/// 0. Charts are rasterised once for all shapes: the seconds of it count for the shape that first
/// needed them. Errors: those of pack() but no_packing; usage for guided, whose shapes share one
/// search.
Result<std::vector<Packing>> pack_each_shape(std::span<const Chart> charts,
                                             const PackOptions& options);

/// Efficiency without padding on the same layout: all charts are enlarged by one factor k >= 1,
/// each about the centre of its placed box and at its angle, until two touch, or one its own image
/// under the wrap or a side that does not wrap; the value is efficiency * k^2. So what is above
/// `efficiency` is what padding and grid cost at the least. At least `efficiency`, and equal to it
/// where charts touch or cross already; at most 1 but for rounding. Exact: the first contact of the
/// outlines (and of triangles against the grain), on no grid; only a chart that comes to be 8 pages
/// long ends it early. `charts` as they were packed, in their order. Source: ours, see
/// src/pack/unpadded.cpp. Of n charts those that overlap as seen along one axis are compared: of
/// like size about n^1.5 pairs, n^2 at the worst; E edges of two that come near take O(E log E),
/// for outlines like combs O(E^2).
double unpadded_efficiency(std::span<const Chart> charts, const Packing& packing);

}  // namespace wrapatlas
