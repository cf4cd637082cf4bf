// pack(): angles, grid, scale search and aspect search around the placing methods.

#include "wrapatlas/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>

#include "charts/hull.h"
#include "guided/guided.h"
#include "pack/aspects.h"
#include "pack/placer.h"
#include "pack/raster_cache.h"
#include "pack/scale_search.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Error usage(std::string what, std::string remedy) {
  return {ErrorKind::usage, "", std::move(what), std::move(remedy)};
}

Status check_pages(const PackOptions& options) {
  if (!(options.density >= 0) || !std::isfinite(options.density)) {
    return usage(fmt::format("a density of {} is out of range", options.density),
                 "use texels per UV unit, or 0 to seek the scale");
  }
  if (options.pages < 0 || options.pages > kMostPages) {
    return usage(fmt::format("{} pages are out of range", options.pages),
                 fmt::format("use 1 to {}", kMostPages));
  }
  if (options.pages == 0 && options.density == 0) {
    return usage("any number of pages, and no density", "give one of them");
  }
  if (options.method != Method::guided && (options.pages != 1 || options.density > 0)) {
    return usage("this packer has one page, and seeks the scale", "use the method guided");
  }
  return Done{};
}

Status check_options(const PackOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kMostTexels ||
      options.height > kMostTexels) {
    return usage(fmt::format("resolution {} x {} is out of range", options.width, options.height),
                 "use 1 to 65536 texels a side");
  }
  if (!(options.padding >= 0 && options.padding <= 4096)) {
    return usage(fmt::format("a padding of {} texels is out of range", options.padding),
                 "use 0 to 4096");
  }
  if (!(options.margin <= kMostTexels)) {
    return usage(fmt::format("a margin of {} texels is out of range", options.margin),
                 "use 0 to 65536");
  }
  if (options.rotations < 1 || options.rotations > 3600) {
    return usage(fmt::format("{} rotations are out of range", options.rotations), "use 1 to 3600");
  }
  if (options.grid < 0 || options.grid > kMaxRasterSide) {
    return usage(fmt::format("a grid of {} cells is out of range", options.grid),
                 fmt::format("use 1 to {}, or 0 to let the program choose", kMaxRasterSide));
  }
  if (options.block < 1 || options.block > 64) {
    return usage(fmt::format("a block of {} texels is out of range", options.block), "use 1 to 64");
  }
  if (!(options.start_upper > 0 && options.start_upper <= 1)) {
    return usage("the upper end of the scale search must lie in (0, 1]", "the paper uses 0.9");
  }
  if (!(options.lambda >= 0 && options.lambda <= 1e6)) {
    return usage(fmt::format("a lambda of {} is out of range", options.lambda),
                 "use 0 to 1e6; the paper uses 1.1");
  }
  if (options.method != Method::modulo && options.method != Method::guided &&
      options.wrap != Wrap::none) {
    return usage("this packer cannot wrap", "use --wrap none with this method");
  }
  if (!(options.time >= 0 && options.time <= 1e6) || options.moves < 0) {
    return usage("a search has to have a time from 0 to 1e6 seconds and 0 or more moves", "");
  }
  return check_pages(options);
}

std::vector<double> chart_angles(const Chart& chart, const PackOptions& options) {
  if (options.method == Method::lprm02) {
    return {std::numbers::pi / 2 - diameter_direction(convex_hull(chart.points))};
  }
  double base = 0;
  if (options.rotation_base == RotationBase::box) {
    base = -smallest_box_direction(convex_hull(chart.points));
  }
  std::vector<double> angles;
  for (int i = 0; i < options.rotations; ++i) {
    angles.push_back(base + 2 * std::numbers::pi * i / options.rotations);
  }
  return angles;
}

/// Whether the chart is a line but for rounding. Charts a little wider than this can be packed.
bool is_line(const Chart& chart) {
  constexpr double kThinnest = 1e-8;
  return !(chart.area > kThinnest * chart.max_radius * chart.max_radius);
}

PlaceFunction place_function(Method method) {
  switch (method) {
    case Method::lprm02:
      return place_lprm02;
    case Method::swg03:
      return place_swg03;
    case Method::zsgs04:
      return place_zsgs04;
    case Method::modulo:
    case Method::guided:  // has a search of its own
      return place_modulo;
  }
  return place_modulo;
}

/// Says how far the work is, one caller at a time, and remembers a wish to stop.
class ProgressMeter {
 public:
  ProgressMeter(const PackOptions& options, std::size_t searches)
      : report_(options.progress), searches_(static_cast<double>(searches)) {}

  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] bool poll() {
    if (report_ && !stopped_) report();
    return stopped_;
  }
  /// A search takes about twelve attempts; the estimate never runs ahead of the search.
  void attempt_done(double efficiency) {
    const std::lock_guard lock(mutex_);
    work_ += (1 - work_ / searches_) / 12;
    best_ = std::max(best_, efficiency);
  }

 private:
  void report() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || seconds_since(last_) < 0.05) return;
    last_ = Clock::now();
    if (!report_({std::min(work_ / searches_, 1.0), best_})) stopped_ = true;
  }

  const std::function<bool(const Progress&)>& report_;
  double searches_;
  std::mutex mutex_;
  double work_ = 0, best_ = 0;
  Clock::time_point last_{};
  std::atomic<bool> stopped_{false};
};

/// One shape of texture, and the best packing found for it.
struct Search {
  Frame frame;
  double factor = 0;  ///< 0: none
  std::vector<CellPlacement> placements;
  std::shared_ptr<ScaleRasters> rasters;
  int packings = 0;
  double seconds = 0;         ///< all of it
  double raster_seconds = 0;  ///< of it, until rasters were there
};

class Packer {
 public:
  Packer(std::span<const Chart> charts, const PackOptions& options, double full_scale,
         RasterCache& cache)
      : options_(options), full_scale_(full_scale), cache_(cache), by_area_(charts.size()) {
    std::iota(by_area_.begin(), by_area_.end(), 0U);
    std::stable_sort(by_area_.begin(), by_area_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return charts[a].area > charts[b].area;
    });
    for (const Chart& chart : charts) {
      radius_ = std::max(radius_, chart.max_radius);
      area_ += chart.area;
    }
  }

  void run(Search& search, ProgressMeter& meter) const {
    const auto start = Clock::now();
    ScaleSearchOptions scale_options;
    scale_options.upper = options_.start_upper;
    std::vector<CellPlacement> placements;
    search_scale(
        scale_options,
        [&](double factor) {
          auto rasters = rasters_at(search.frame, factor);
          ++search.packings;
          const bool success =
              !hopeless(search.frame, factor) && attempt(search, *rasters, meter, placements);
          if (success && factor > search.factor) {
            search.factor = factor;
            search.rasters = std::move(rasters);
            search.placements.swap(placements);
          }
          meter.attempt_done(efficiency(search));
          return success;
        },
        [&meter] { return meter.stopped(); });
    search.seconds = seconds_since(start);
  }

  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] double scale(double factor) const { return factor * full_scale_; }
  [[nodiscard]] double efficiency(const Search& search) const {
    const double s = scale(search.factor);
    return s * s * area_ / search.frame.texels();
  }

 private:
  [[nodiscard]] std::shared_ptr<ScaleRasters> rasters_at(const Frame& frame, double factor) const {
    return cache_.at(raster_scale_on(frame, scale(factor), options_.coverage));
  }

  /// Each grown chart covers at least its area and a disc of half the padding.
  [[nodiscard]] bool hopeless(const Frame& frame, double factor) const {
    if (options_.coverage != Coverage::conservative) return false;
    const double disc = std::numbers::pi * options_.padding * options_.padding / 4;
    const double charts = scale(factor) * scale(factor) * area_;
    return charts + disc * static_cast<double>(by_area_.size()) > frame.texels();
  }

  bool attempt(Search& search, ScaleRasters& rasters, ProgressMeter& meter,
               std::vector<CellPlacement>& placements) const {
    const Frame& frame = search.frame;
    PlaceTask task;
    task.width = frame.width;
    task.height = frame.height;
    task.wrap = options_.wrap;
    task.chart_count = by_area_.size();
    task.rasters = [&](std::size_t chart) {
      const auto start = Clock::now();
      const auto of_chart = rasters.of(chart);
      search.raster_seconds += seconds_since(start);
      return of_chart;
    };
    task.by_area = by_area_;
    const Vec2 cells = rasters.scale().cells_per_unit;
    const double reach = 2 * (radius_ * std::max(cells.x, cells.y) + frame.growth) + 2;
    task.reach = static_cast<int>(std::min<double>(reach, cache_.max_side()));
    task.lambda = options_.lambda;
    task.inner = options_.inner;
    task.all_sides = options_.all_sides;
    task.stop = [&meter] { return meter.poll(); };
    return place_function(options_.method)(task, placements);
  }

  const PackOptions& options_;
  double full_scale_;
  RasterCache& cache_;
  std::vector<std::uint32_t> by_area_;
  double radius_ = 0, area_ = 0;
};

/// Cells along the longer side of the grid, where the user leaves the choice to us: the paper's
/// 256, and finer where charts are so many that the average one would have too few cells.
int choose_grid(const PackOptions& options, std::size_t charts) {
  if (options.grid > 0) return options.grid;
  constexpr double kCellsPerChart = 64;
  const double cells = std::sqrt(kCellsPerChart * static_cast<double>(charts));
  const int longest = std::max(options.width, options.height);
  const int finest = std::clamp(longest, 256, 2048);
  return std::clamp(static_cast<int>(cells), 256, finest);
}

/// Without placements if the search found none.
Packing to_packing(const Search& search, const Packer& packer, const PackOptions& options) {
  const Frame& frame = search.frame;
  std::vector<Placement> placements;
  std::int64_t covered = 0;
  for (std::size_t chart = 0; chart < search.placements.size(); ++chart) {
    const CellPlacement& cell = search.placements[chart];
    const ChartRaster& raster = search.rasters->of(chart)[static_cast<std::size_t>(cell.rotation)];
    covered += raster.cells;
    placements.push_back(place_on(frame, raster.angle, raster.offset, cell.x, cell.y));
  }
  Packing packing = make_packing(frame, options.wrap, packer.scale(search.factor), packer.area(),
                                 std::move(placements), covered);
  packing.packings = search.packings;
  packing.raster_seconds = search.raster_seconds;
  packing.place_seconds = search.seconds - search.raster_seconds;
  return packing;
}

/// Per shape of texture what a method finds that places all charts at one scale after another.
Result<std::vector<Packing>> search_shapes(std::span<const Chart> charts,
                                           const PackOptions& options, double area) {
  const int longest = std::max(options.width, options.height);
  auto frames = make_frames(options, double(longest) / choose_grid(options, charts.size()));
  if (!frames) return frames.error();
  std::vector<RasterShape> shapes;
  std::vector<std::vector<double>> angles;
  for (const Chart& chart : charts) {
    shapes.push_back(make_raster_shape(chart));
    angles.push_back(chart_angles(chart, options));
  }
  int max_side = 0;
  for (const Frame& frame : *frames) {
    max_side =
        std::max({max_side, kLongestInDomains * frame.width, kLongestInDomains * frame.height});
  }
  // Ratios search the same scales at about the same time; one search alone meets none twice.
  const std::size_t scales_kept = frames->size() > 1 ? 12 : 1;
  RasterCache cache(std::move(shapes), std::move(angles), max_side, scales_kept);
  const double full_scale = std::sqrt(double(options.width) * options.height / area);
  const Packer packer(charts, options, full_scale, cache);
  ProgressMeter meter(options, frames->size());
  std::vector<Search> searches(frames->size());
  for (std::size_t i = 0; i < searches.size(); ++i) searches[i].frame = (*frames)[i];
  parallel_for(searches.size(), thread_count(options.threads),
               [&](std::size_t i) { packer.run(searches[i], meter); });
  std::vector<Packing> packings;
  for (const Search& search : searches) {
    packings.push_back(to_packing(search, packer, options));
    packings.back().interrupted = meter.stopped();
  }
  return packings;
}

/// The densest of them.
Result<Packing> pack_by_scales(std::span<const Chart> charts, const PackOptions& options,
                               double area) {
  const auto all = search_shapes(charts, options, area);
  if (!all) return all.error();
  Packing best = *std::max_element(
      all->begin(), all->end(),
      [](const Packing& a, const Packing& b) { return a.efficiency < b.efficiency; });
  if (best.placements.empty()) {
    if (best.interrupted) {
      return Error{ErrorKind::interrupted, "", "stopped before a packing was found", ""};
    }
    return Error{ErrorKind::no_packing, "",
                 fmt::format("no scale was found at which {} charts fit {} x {} texels",
                             charts.size(), options.width, options.height),
                 "raise --resolution, or lower --padding and --margin"};
  }
  best.packings = 0;
  best.raster_seconds = best.place_seconds = 0;
  for (const Packing& packing : *all) {
    best.packings += packing.packings;
    best.raster_seconds += packing.raster_seconds;
    best.place_seconds += packing.place_seconds;
  }
  return best;
}

/// What pack() and pack_each_shape() ask of their arguments.
Result<double> checked_area(std::span<const Chart> charts, const PackOptions& options) {
  if (const Status ok = check_options(options); !ok) return ok.error();
  if (charts.empty()) return usage("there are no charts to pack", "give at least one");
  double area = 0;
  for (const Chart& chart : charts) area += chart.area;
  if (std::all_of(charts.begin(), charts.end(), is_line) || !std::isfinite(area)) {
    return Error{ErrorKind::input, "charts", "they have no area, or none that is finite",
                 "unwrap the mesh again: its UVs are collapsed"};
  }
  return area;
}

}  // namespace

Result<Packing> pack(std::span<const Chart> charts, const PackOptions& options) {
  const auto area = checked_area(charts, options);
  if (!area) return area.error();
  if (options.method == Method::guided) return pack_guided(charts, options, pack_by_scales);
  return pack_by_scales(charts, options, *area);
}

Result<std::vector<Packing>> pack_each_shape(std::span<const Chart> charts,
                                             const PackOptions& options) {
  const auto area = checked_area(charts, options);
  if (!area) return area.error();
  if (options.method == Method::guided) {
    return usage("guided searches shapes together, not each", "use another method");
  }
  return search_shapes(charts, options, *area);
}

}  // namespace wrapatlas
