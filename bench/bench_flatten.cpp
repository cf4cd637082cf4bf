// Flattening: LABF after one, two, three solves beside LSCM, on the same charts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands.h"
#include "report.h"
#include "segment/segment.h"
#include "wrapatlas/model.h"

namespace wrapatlas::bench {
namespace {

struct Way {
  const char* name;
  FlattenOptions options;
};
constexpr Way kWays[] = {{"labf, 1 solve", {FlattenMethod::labf, 1}},
                         {"labf, 2 solves", {FlattenMethod::labf, 2}},
                         {"labf, 3 solves", {FlattenMethod::labf, 3}},
                         {"labf, 4 solves", {FlattenMethod::labf, 4}},
                         {"lscm", {FlattenMethod::lscm, 1}}};

/// What one way makes of all charts.
struct Sums {
  double l2 = 0, angle = 0, area = 0, seconds = 0;
  std::vector<double> residuals, l2s;
  std::size_t charts = 0, flipped = 0, stood_in = 0;
};

/// The charts of all models in the folder that unwrap() would make, without their flattening.
std::vector<CutChart> load_discs(const FlattenBenchOptions& options) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(options.folder)) {
    if (format_from_path(entry.path())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<CutChart> discs;
  for (std::size_t i = 0; i < paths.size(); i += static_cast<std::size_t>(options.stride)) {
    const auto model = load_model(paths[i]);
    if (!model) continue;
    const auto surface = build_surface(model->mesh);
    if (!surface) continue;
    auto cut = segment_surface(*surface, {});
    if (!cut) continue;
    for (Draft& draft : cut->charts) {
      if (draft.disc.triangles.size() > 1) discs.push_back(std::move(draft.disc));
    }
  }
  return discs;
}

void measure(const CutChart& disc, const Way& way, Sums& sums) {
  const Stopwatch stopwatch;
  const auto flat = flatten_disc(disc.points, disc.triangles, way.options);
  sums.seconds += stopwatch.seconds();
  if (!flat) return;
  ++sums.charts;
  sums.stood_in += flat->method == way.options.method ? 0 : 1;
  if (way.options.method == flat->method && way.options.method == FlattenMethod::labf) {
    sums.residuals.push_back(flat->wheel_residual);
  }
  const Distortion distortion = measure_distortion(disc.points, flat->uv, disc.triangles);
  sums.flipped += distortion.flipped;
  // Of charts with a flip too: the root mean square over all other triangles.
  double squares = 0, area = 0;
  const std::vector<double> stretch = triangle_stretch(disc.points, flat->uv, disc.triangles);
  for (std::size_t t = 0; t < stretch.size(); ++t) {
    const auto& [a, b, c] = disc.triangles[t];
    const double size =
        length(cross(disc.points[b] - disc.points[a], disc.points[c] - disc.points[a]));
    if (!std::isfinite(stretch[t])) continue;
    squares += size * stretch[t] * stretch[t];
    area += size;
  }
  sums.l2s.push_back(std::sqrt(squares / area));
  sums.l2 += sums.l2s.back();
  sums.angle += distortion.angle;
  sums.area += distortion.area;
}

std::string power(double value) { return fmt::format("{:.1e}", value); }

}  // namespace

int bench_flatten(const FlattenBenchOptions& options) {
  fmt::print("options: flatten, {} every {}, charts of unwrap at stretch 2\n", options.folder,
             options.stride);
  const std::vector<CutChart> discs = load_discs(options);
  std::size_t triangles = 0;
  for (const CutChart& disc : discs) triangles += disc.triangles.size();
  if (discs.empty()) {
    fmt::print(stderr, "no model in {}\n", options.folder);
    return 3;
  }
  fmt::print("{} charts, {} triangles; means over charts\n", discs.size(), triangles);
  Table table({"way", "L2", "L2, median", "angle", "area", "flipped", "lscm stood in",
               "wheel error, median", "largest", "us per triangle"});
  for (const Way& way : kWays) {
    Sums sums;
    for (const CutChart& disc : discs) measure(disc, way, sums);
    const double count = std::max<double>(1, double(sums.charts));
    const bool has_wheels = !sums.residuals.empty();
    table.add(
        {way.name, fmt::format("{:.4f}", sums.l2 / count),
         sums.l2s.empty() ? "" : fmt::format("{:.4f}", median(sums.l2s)),
         fmt::format("{:.5f}", sums.angle / count), fmt::format("{:.4f}", sums.area / count),
         std::to_string(sums.flipped), std::to_string(sums.stood_in),
         has_wheels ? power(median(sums.residuals)) : "",
         has_wheels ? power(*std::max_element(sums.residuals.begin(), sums.residuals.end())) : "",
         fmt::format("{:.1f}", 1e6 * sums.seconds / double(triangles))});
  }
  table.print();
  return 0;
}

}  // namespace wrapatlas::bench
