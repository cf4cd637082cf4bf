// The chart sets that benchmarks run over.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wrapatlas/charts.h"

namespace wrapatlas::bench {

struct ChartFile {
  std::string name;
  ChartSet set;
};

/// The folder to use where none is given: the chart sets beside the repository, or the samples.
std::filesystem::path default_chart_folder();

/// All models with UVs below `folder` (or the one file), in the order of their names; every
/// `stride`-th of them. Others are left out with a word on stderr.
std::vector<ChartFile> load_chart_files(const std::filesystem::path& folder, int stride);

}  // namespace wrapatlas::bench
