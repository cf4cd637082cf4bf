// From a bare mesh to charts: cut into few, flattened, ready to be packed.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/parameterize.h"
#include "wrapatlas/result.h"
#include "wrapatlas/surface.h"

namespace wrapatlas {

enum class StretchMeasure {
  l2,    ///< the root mean square over a chart (the paper's threshold, as we read it)
  linf,  ///< the largest of any direction at any place of it
};

/// How far it has come.
struct UnwrapProgress {
  double fraction = 0;     ///< of the surface that is in finished charts, an estimate in [0, 1]
  std::size_t charts = 0;  ///< so far
};

struct UnwrapOptions {
  double max_stretch = 2;  ///< of a chart, >= 1
  StretchMeasure stretch = StretchMeasure::l2;
  /// If > 0: charts go on being joined beyond max_stretch until there are no more than this, or
  /// none can be: pieces of surface that do not touch, unions of more than 60,000 triangles, those
  /// that overlap themselves when they are flat.
  std::uint32_t max_charts = 0;
  /// If > 0: no chart, but one of a single face, is longer than what fits into a square of this
  /// times the side of one that has the area of the whole surface. Without wrap a square atlas
  /// with a chart of extent e cannot be used to more than 1/e^2.
  double max_extent = 0;
  SurfaceOptions surface;
  FlattenOptions flatten;
  int threads = 0;  ///< 0: as many as the machine has; the result does not depend on it
  /// Called now and then from any thread, one call at a time; false: stop.
  std::function<bool(const UnwrapProgress&)> progress;
};

/// UnwrapOptions::max_extent for an atlas that wraps so: 1.5 where it does on any axis, as long
/// charts may lie across the border; else 0.8, as a page has to hold them.
double default_extent(Wrap wrap);

struct UnwrappedChart {
  std::uint32_t faces = 0;
  double area = 0;           ///< in space
  double border_length = 0;  ///< in space; both sides of a seam count
  Distortion distortion;
  bool used_lscm = false;  ///< angle based flattening gave no triangles
  bool is_good = true;     ///< false: a single face that cannot be flattened within the limits
};

struct Unwrapping {
  /// The mesh given, with UVs at each corner: in units of its positions, each chart with about the
  /// area it has in space, no two at the same place.
  Mesh mesh;
  std::vector<std::uint32_t> face_chart;  ///< per face of the mesh
  std::vector<double> face_stretch;       ///< per face of the mesh: triangle_stretch; 0: folded
  std::vector<UnwrappedChart> charts;     ///< faces that are no part of the surface come last
  SurfaceReport surface;
  double surface_seconds = 0, segment_seconds = 0,
         flatten_seconds = 0;  ///< the last is within the second, and summed over threads
};

/// Cuts the mesh into charts (Sander et al. 2003, with splitting and merging on stretch), flattens
/// each (Zayer, Lévy & Seidel 2007) until none is distorted beyond max_stretch, overlaps itself or
/// has a flipped triangle. The same bits for any number of threads. The mesh must pass
/// validate_mesh; UVs it has are not looked at but for SurfaceOptions::uv_seams. Errors: usage (bad
/// options), input (no faces, or none of any area), interrupted.
Result<Unwrapping> unwrap(const Mesh& mesh, const UnwrapOptions& options = {});

}  // namespace wrapatlas
