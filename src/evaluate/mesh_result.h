// What is kept of one mesh of an evaluation: its charts in numbers, and a row for each packing.
#pragma once

#include <string>
#include <vector>

#include "evaluate/setting.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

struct MeshFacts {
  std::string id;     ///< its name within the evaluation: letters that a file name may have
  std::string group;  ///< kind of mesh, or folder
  std::string file;   ///< as given
  std::size_t faces = 0, charts = 0;
  bool unwrapped = false;     ///< else the charts are the file's own, and these are 0:
  double l2 = 0, linf = 0;    ///< stretch, the largest of any chart
  double border = 0;          ///< length of all seams in space over the root of the area
  double unwrap_seconds = 0;  ///< of one thread
  std::string charts_file;    ///< the name in the results' charts/; empty: `file` has them
};

/// One packing that was sought. Times are of one thread, in seconds.
struct Run {
  std::string contender;
  bool searched_shape = false;  ///< guided looked for the shape itself
  Packing packing;              ///< placements only where they are kept for pictures
  double seconds = 0;
  std::size_t violations = 0;  ///< of the exact check
  double deepest = 0;          ///< texels: the deepest overlap it found
  std::string error;           ///< empty: none

  [[nodiscard]] bool is_square() const {
    return !searched_shape && packing.width == packing.height;
  }
};

struct MeshResult {
  MeshFacts facts;
  std::vector<Run> runs;
  std::string error;  ///< why there are no runs; else empty
};

Json facts_json(const MeshFacts& facts);
MeshFacts facts_from(const Json& json);

Json result_json(const MeshResult& result);

/// Errors: input (not what result_json writes).
Result<MeshResult> result_from(const std::string& text);

/// Rows of the results table, and the line of its column names. RFC 4180.
std::string csv_header();
std::string csv_rows(const MeshResult& result, const Setting& setting);

}  // namespace wrapatlas
