#include "chart_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "wrapatlas/model.h"

namespace wrapatlas::bench {

namespace fs = std::filesystem;

fs::path default_chart_folder() {
  const fs::path source(WRAPATLAS_SOURCE_DIR);
  const fs::path charts = source / "../shared/data/charts";
  std::error_code ignored;
  return fs::is_directory(charts, ignored) ? charts.lexically_normal() : source / "samples";
}

std::vector<ChartFile> load_chart_files(const fs::path& folder, int stride) {
  std::vector<fs::path> paths;
  std::error_code error;
  if (fs::is_regular_file(folder, error)) {
    paths.push_back(folder);
  } else {
    for (fs::recursive_directory_iterator entry(folder, error), end; entry != end && !error;
         entry.increment(error)) {
      if (entry->is_regular_file() && format_from_path(entry->path())) {
        paths.push_back(entry->path());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<ChartFile> files;
  for (std::size_t i = 0; i < paths.size(); i += static_cast<std::size_t>(stride)) {
    const auto model = load_model(paths[i]);
    auto set = model ? build_charts(model->mesh) : Result<ChartSet>(model.error());
    if (set) {
      files.push_back({paths[i].string(), *std::move(set)});
    } else {
      fmt::print(stderr, "{}: left out: {}\n", paths[i].string(), set.error().message());
    }
  }
  return files;
}

}  // namespace wrapatlas::bench
