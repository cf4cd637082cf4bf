// The independent exact check of a finished atlas. Shares no code with raster/ and pack/.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

struct CheckOptions {
  int width = 1024, height = 1024;  ///< texels of the atlas
  Wrap wrap = Wrap::none;
  Wrap cut = Wrap::none;    ///< axes whose sides charts were cut at: no margin is owed there
  double padding = 0;       ///< texels that must lie between charts
  double margin = 0;        ///< texels to a side that neither wraps nor was cut at
  double tolerance = 1e-3;  ///< texels by which a chart may differ from a similarity copy
  bool stacked_ok = false;  ///< charts that overlap in the reference may overlap here
  /// If more than 1: UV tiles 0 .. pages - 1 are pages of their own, ten to a row as UDIM numbers
  /// them. A chart is on the one that holds its smallest corner, and is judged among those there.
  int pages = 1;
  bool v_points_down = false;     ///< in the atlas; rows of pages count the other way then
  std::size_t max_findings = 20;  ///< how many violations to describe in words
  int threads = 0;
};

enum class Violation {
  overlap,
  gap,
  self_overlap,
  bounds,
  margin,
  missing_face,
  not_similar,
  mirrored,
  scale
};

struct Finding {
  Violation kind;
  std::uint32_t chart_a = kNone, chart_b = kNone;
  std::uint32_t face_a = kNone, face_b = kNone;
  double amount = 0;  ///< texels (overlap depth, distance), or the scale's ratio
  std::string text;   ///< one line in words
};

struct CheckReport {
  std::size_t charts = 0, faces = 0, faces_without_uv = 0;
  std::size_t violations = 0;  ///< all, also those past max_findings
  std::vector<Finding> findings;
  std::vector<std::string> remarks;  ///< defects of the input that are not the packing's fault
  double gap_reach = 0;              ///< texels: gaps from here on are not looked for
  double smallest_gap = 0;  ///< texels, between charts closer than gap_reach; else gap_reach
  std::size_t pages = 1;    ///< in use
  double efficiency = 0;    ///< covered area / (pages * width * height)
  double scale = 0;         ///< texels per reference UV unit; 0 without a reference
  [[nodiscard]] bool ok() const { return violations == 0; }
};

/// Checks a finished atlas by exact triangles (see docs/algorithms/validation.md). `reference`
/// may be null: then only overlap, gap, bounds and margin are judged, and pieces that fit together
/// at the border of the atlas count as one chart that was cut there. Errors: input (meshes that
/// cannot be compared).
Result<CheckReport> check_atlas(const Mesh& atlas, const Mesh* reference,
                                const CheckOptions& options);

/// What pack() promised with these options of the packing that it made, for check_atlas: sizes,
/// wrap, padding, margin, pages. `cut`: of export_cut's atlas, which must hold without any
/// wrapping, and whose charts reach the sides that they were cut at. `stacked_ok` and
/// `v_points_down` are for the caller to say.
CheckOptions promises_of(const PackOptions& options, const Packing& packing, bool cut);

}  // namespace wrapatlas
