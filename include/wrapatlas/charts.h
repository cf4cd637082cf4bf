// Charts: connected pieces of UV, what is packed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "wrapatlas/geometry.h"
#include "wrapatlas/mesh.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// A directed border edge of a chart, with the material on its left for a counter-clockwise chart.
/// `winding` is how often the chart's triangles leave it uncancelled (almost always 1).
struct OutlineEdge {
  std::uint32_t from = 0, to = 0;  ///< into Chart::points
  std::int32_t winding = 1;
};

/// One chart (or one stack of charts that share their texels) in input UV units.
/// Packing reads points, outline, against_grain and area; triangles may be empty for a chart that
/// is known by its outline alone.
struct Chart {
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< into points; winding as in the input
  std::vector<OutlineEdge> outline;
  /// Triangles whose winding differs from the majority's. The chart covers exactly the points of
  /// non-zero winding number of `outline`, and these triangles.
  std::vector<std::uint32_t> against_grain;
  double area = 0;        ///< covered area (overlap within the chart counts once), input units^2
  double overlap = 0;     ///< area covered more than once, counted once less each time
  double max_radius = 0;  ///< largest distance of a point from the box centre
  Box2 box;
};

/// Builds a chart from triangles. Complexity O(n log n + E A) for E outline edges of which A meet
/// one line; beyond 4e7 steps overlap is sampled, to about 1e-4 (docs/algorithms/charts.md).
Chart chart_from_triangles(std::vector<Vec2> points,
                           std::vector<std::array<std::uint32_t, 3>> triangles);

/// Builds a chart from closed loops of points (non-zero winding rule), for callers who have
/// outlines and no mesh. Errors: input (no loop, a loop of fewer
/// than three points, coordinates that are not finite or beyond 1e30).
Result<Chart> chart_from_loops(std::span<const std::vector<Vec2>> loops);

/// What to do with charts that lie on top of each other in the input.
enum class Stacked {
  separate,  ///< pack each on its own
  keep,      ///< keep charts that share texels together: they move as one and go on sharing
};

struct ChartSet {
  std::vector<Chart> charts;
  std::vector<std::uint32_t> face_chart;    ///< per face of the mesh; kNone for a face without UVs
  std::vector<std::uint32_t> corner_point;  ///< per corner: index into its chart's points; or kNone
  std::uint32_t stacked = 0;                ///< charts that overlap another chart of the input
  bool all_stacks_found = true;  ///< false: the search for them reached its limit of steps
  std::uint32_t self_overlapping = 0;
  std::uint32_t degenerate = 0;  ///< charts of zero area
  std::uint32_t faces_without_uv = 0;
  std::uint32_t crossing_faces = 0;  ///< whose UV sides cross: they take up their convex hull
  std::uint32_t first_crossing_face = kNone;

  [[nodiscard]] double total_area() const;
};

/// UV units per unit of surface, the mean over all faces with UVs: the square root of their area in
/// UV over their area in space, each triangle counted as often as it is there. So texels per unit
/// of surface = Packing::scale * uv_density. 0 if one of the areas is 0. O(corners).
double uv_density(const Mesh& mesh);

/// Finds the charts of a mesh: faces are connected if they share an edge at both of whose ends
/// position and UV agree (by value, so files that repeat vertices are fine) and are of one object.
/// Charts are numbered by their first face. Fails if no face has UVs. The mesh must pass
/// validate_mesh. O(n log n).
Result<ChartSet> build_charts(const Mesh& mesh, Stacked stacked = Stacked::separate);

}  // namespace wrapatlas
