// How long the packers take: beside the times of Noell & Stricker (EGSR 2011, section 5), which
// were measured on a 3.07 GHz processor of 2010 with charts of meshes like ours, not the same.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "chart_files.h"
#include "commands.h"
#include "report.h"
#include "wrapatlas/pack.h"

namespace wrapatlas::bench {
namespace {

struct MethodRow {
  Method method;
  const char* name;
  double paper_square, paper_aspects;  ///< seconds
};
constexpr std::array<MethodRow, 4> kMethods{{{Method::lprm02, "lprm02", 0.29, 5.45},
                                             {Method::swg03, "swg03", 3.58, 38.11},
                                             {Method::zsgs04, "zsgs04", 3.44, 34.25},
                                             {Method::modulo, "modulo", 4.70, 55.35}}};

constexpr double kTargetSquare = 0.05;  // seconds, median, one search on one thread
constexpr double kTargetAspects = 1.0;  // seconds, median, 31 ratios on two cores
constexpr double kTargetRaster = 0.25;  // share of the time

PackOptions paper_setting() {
  PackOptions options;
  options.width = options.height = options.grid = 256;
  options.padding = 0;
  options.coverage = Coverage::center;
  return options;
}

PackOptions safe_setting() {
  PackOptions options;
  options.width = options.height = 1024;
  options.grid = 256;
  options.padding = 2;
  options.coverage = Coverage::conservative;
  return options;
}

struct Times {
  std::vector<double> seconds;  ///< median of each file
  double raster = 0, place = 0, efficiency = 0;
  int failures = 0;
};

Times measure(const std::vector<ChartFile>& files, const PackOptions& options, int runs) {
  Times times;
  for (const ChartFile& file : files) {
    Result<Packing> packing = Error{};
    const double seconds = median_seconds(runs, [&] { packing = pack(file.set.charts, options); });
    if (!packing) {
      fmt::print(stderr, "{}: {}\n", file.name, packing.error().message());
      ++times.failures;
      continue;
    }
    times.seconds.push_back(seconds);
    times.raster += packing->raster_seconds;
    times.place += packing->place_seconds;
    times.efficiency += packing->efficiency;
  }
  return times;
}

std::string percent(double part, double whole) {
  return whole > 0 ? fmt::format("{:.1f} %", 100 * part / whole) : "-";
}

int print_table(const char* title, const std::vector<ChartFile>& files, PackOptions options,
                int runs) {
  const bool aspects = options.aspect != Aspect::fixed;
  fmt::print("\n{}, {}: median of {} {} a file, {} {}\n", title,
             aspects ? "31 aspect ratios" : "square, one scale search", runs,
             runs == 1 ? "run" : "runs", options.threads,
             options.threads == 1 ? "thread" : "threads");
  Table table({"method", "median ms", "max ms", "raster share", "efficiency", "paper s",
               "paper / median", "target ms", "met"});
  int failures = 0;
  for (const MethodRow& row : kMethods) {
    options.method = row.method;
    options.wrap = row.method == Method::modulo ? Wrap::uv : Wrap::none;
    const Times times = measure(files, options, runs);
    failures += times.failures;
    if (times.seconds.empty()) continue;
    const double middle = median(times.seconds);
    const double paper = aspects ? row.paper_aspects : row.paper_square;
    const double target = aspects ? kTargetAspects : kTargetSquare;
    const double work = times.raster + times.place;
    const bool met = middle <= target && times.raster <= kTargetRaster * work;
    table.add(
        {row.name, fmt::format("{:.1f}", 1e3 * middle),
         fmt::format("{:.1f}", 1e3 * *std::max_element(times.seconds.begin(), times.seconds.end())),
         percent(times.raster, work),
         percent(times.efficiency, static_cast<double>(times.seconds.size())),
         fmt::format("{:.2f}", paper), fmt::format("{:.0f} x", paper / middle),
         row.method == Method::modulo ? fmt::format("{:.0f}", 1e3 * target) : "",
         row.method == Method::modulo ? (met ? "yes" : "no") : ""});
  }
  table.print();
  return failures;
}

}  // namespace

int bench_pack(const ChartOptions& charts, const PackBenchOptions& bench) {
  const std::vector<ChartFile> files = load_chart_files(charts.folder, charts.stride);
  if (files.empty()) {
    fmt::print(stderr, "{}: no models with UVs here\n", charts.folder);
    return 3;
  }
  std::size_t count = 0;
  for (const ChartFile& file : files) count += file.set.charts.size();
  fmt::print("options: pack, {} files of {}, {} charts; 16 rotations, grid 256\n", files.size(),
             charts.folder, count);
  fmt::print(
      "Raster share: of the time summed over files (target {:.0f} %). Efficiency: mean.\n"
      "Paper: its seconds on its machine and meshes. Targets are for modulo.\n",
      100 * kTargetRaster);
  int failures = 0;
  for (const auto& [title, setting] :
       {std::pair{"The paper's setting (cell centres, no padding, 256 x 256)", paper_setting()},
        std::pair{"The safe setting (conservative, padding 2, 1024 x 1024)", safe_setting()}}) {
    PackOptions options = setting;
    options.threads = 1;
    failures += print_table(title, files, options, charts.runs);
    if (bench.aspect_runs == 0) continue;
    options.threads = bench.aspect_threads;
    options.aspect = Aspect::search;
    failures += print_table(title, files, options, bench.aspect_runs);
  }
  return failures == 0 ? 0 : 1;
}

}  // namespace wrapatlas::bench
