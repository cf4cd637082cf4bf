// An evaluation: many meshes, each by every contender, kept as they are done.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "evaluate/mesh_charts.h"
#include "evaluate/store.h"

namespace wrapatlas {

/// The files, and of folders all models in them; in order. Each gets a name of its own. Errors:
/// input (nothing there), usage (two files that would have one name).
Result<std::vector<InputMesh>> find_meshes(std::span<const std::string> paths);

struct EvaluateProgress {
  std::size_t done = 0, all = 0;
  double seconds_left = 0;
  const MeshResult* result = nullptr;  ///< of the mesh just done; null: only time has passed
};

struct EvaluateOutcome {
  std::size_t done_before = 0;  ///< meshes whose results were there
  bool interrupted = false;
};

/// Measures what the store does not have yet, one mesh per thread at a time, and writes the table.
/// A mesh that fails is kept with what was wrong; the others go on. `report` is called from any
/// thread, one call at a time; false ends the work: what is in hand is given up. Errors: output.
Result<EvaluateOutcome> evaluate(std::span<const InputMesh> meshes, const Setting& setting,
                                 const Store& store, int threads,
                                 const std::function<bool(const EvaluateProgress&)>& report);

}  // namespace wrapatlas
