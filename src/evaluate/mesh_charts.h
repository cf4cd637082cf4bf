// The charts of a mesh that takes part in an evaluation: its own, or made once and kept on disk.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "evaluate/mesh_result.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// A file that takes part.
struct InputMesh {
  std::filesystem::path path;
  std::string id, group;
};

struct MeshCharts {
  Mesh mesh;
  ChartSet charts;
  MeshFacts facts;
};

/// Reads the file and gives its charts. A mesh that has to be unwrapped is so once: it is kept in
/// `cache` under a name that holds what it depends on, the file's bytes and the setting, and is
/// always read from there, so that it is the same the first time and later. Errors: input, output,
/// interrupted (`stop` said so).
Result<MeshCharts> load_mesh_charts(const InputMesh& input, const Setting& setting,
                                    const std::filesystem::path& cache,
                                    const std::function<bool()>& stop);

/// The charts of a mesh that was measured. Error: input.
Result<ChartSet> load_charts(const MeshFacts& facts, const std::filesystem::path& cache);

}  // namespace wrapatlas
