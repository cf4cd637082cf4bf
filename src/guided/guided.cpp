// Few charts: a quick packing, then separation; from 40 on best fit where that comes to nothing.
// More than 200: best fit, then separation if there is time.
// Many: best fit, from different orders.

#include "guided/guided.h"

#include <algorithm>
#include <cmath>

#include "guided/assemble.h"
#include "guided/best_fit_search.h"
#include "guided/lines.h"
#include "guided/pages.h"
#include "guided/record.h"
#include "guided/refine.h"
#include "pack/aspects.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

/// Separation looks at all other charts at every move.
constexpr std::size_t kMostSeparated = 200;
/// Up to so many charts separation goes on from best fit.
constexpr std::size_t kMostImproved = 1000;

/// Up to so many charts separation begins from a quick packing alone.
constexpr std::size_t kFewCharts = 40;

/// Texels to a cell of the final grid: one, but for large atlases, and for small ones of few
/// charts, where whole texels are coarse beside the charts.
double fine_cell(const PackOptions& options, std::size_t charts) {
  const int finest = charts > kMostSeparated ? 4096 : 2048;
  const int coarsest = charts > kFewCharts ? 1 : 512;
  const int longest = std::max(options.width, options.height);
  if (options.grid > 0) return double(longest) / options.grid;
  return double(longest) / std::clamp(longest, coarsest, finest);
}

/// Charts may be the pieces of one sheet: if all of them fit together they are packed like that.
void search_assembly(std::span<const ChartShape> shapes, const PackOptions& options,
                     std::span<const Frame> frames, Record& record) {
  constexpr double kMatchShare = 0.05, kWholeShare = 0.3, kRefineShare = 0.9;  // of the time
  if (!record.timed()) return;
  const double seconds = kMatchShare * options.time * thread_count(options.threads);
  const auto assembly = assemble(shapes, frames, options, seconds, record.effort(kWholeShare));
  if (!assembly) return;
  const Frame& frame = frames[assembly->frame];
  Effort effort = record.effort(kRefineShare);
  Random random(options.seed);
  RefineOptions how;
  how.exact = true;
  Refined fine = refine(shapes, frame, options, assembly->layout, how, effort, random);
  if (fine.packing) record.offer(std::move(*fine.packing), 1);
}

/// What all ways begin with and report to.
struct Task {
  std::span<const Chart> charts;
  const PackOptions& options;
  std::vector<Frame> frames;
  FirstPacker first;
  Record record;
  std::optional<Error> failure;  ///< of the first packer

  /// Offers a packing by modulo, which is quick and finds one where there is one. Where nothing
  /// wraps the older packers may come to more.
  void offer_first() {
    double area = 0;
    for (const Chart& chart : charts) area += chart.area;
    std::vector<Method> methods{Method::modulo};
    if (options.wrap == Wrap::none) methods.insert(methods.end(), {Method::zsgs04, Method::swg03});
    std::size_t number = 0;
    for (const Method method : methods) {
      if (record.best() && record.enough(1)) return;
      PackOptions quick = options;
      quick.method = method;
      quick.progress = record.reporter();
      auto packing = first(charts, quick, area);
      if (packing) {
        record.offer(std::move(*packing), number++);
      } else if (!record.best()) {
        failure = packing.error();
        return;
      }
      if (record.stopped()) return;
    }
  }
};

/// Of many charts some may fit nowhere on a coarse grid, and separation then comes to nothing, or
/// to little before long. If so, best fit is asked for something to go on from.
void separate_or_fit(Task& task, std::span<const ChartShape> shapes, Lines& lines) {
  constexpr double kSuccess = 1.02, kShare = 0.4;  // of the time, for what may come to nothing
  const double before = task.record.efficiency();
  lines.run_until_stuck(kShare);
  if (task.record.efficiency() > kSuccess * before) return;
  search_best_fit(shapes, task.options, task.frames, task.record, false);
  if (task.record.best()) lines.begin_with(*task.record.best(), false);
  lines.run_until_stuck();
}

void separate_few(Task& task) {
  task.offer_first();
  if (task.record.stopped()) return;
  task.frames = without_mirrored(task.frames, task.options.wrap, task.record.best());
  const std::vector<ChartShape> shapes = make_shapes(task.charts);
  // With so little time for so many charts separation may come to nothing.
  constexpr double kShort = 0.5, kShortPerChart = 0.03;  // seconds
  const double enough = std::max(kShort, kShortPerChart * static_cast<double>(shapes.size()));
  const bool is_short = task.record.timed() && task.options.time < enough;
  if (is_short) search_best_fit(shapes, task.options, task.frames, task.record, false);
  search_assembly(shapes, task.options, task.frames, task.record);
  const bool is_hard = !is_short && shapes.size() > kFewCharts;
  if (is_hard && task.frames.size() > 1) {
    const std::span<const Frame> frames(task.frames);
    search_best_fit(shapes, task.options, frames.first(1), task.record, false);
  }
  Lines lines(shapes, task.options, task.frames, task.record);
  if (task.record.best()) lines.begin_with(*task.record.best(), false);
  if (is_hard && task.frames.size() == 1) {
    separate_or_fit(task, shapes, lines);
  } else {
    lines.run_until_stuck();
  }
  lines.go_on();
}

void fit_many(Task& task) {
  task.frames = without_mirrored(task.frames, task.options.wrap, {});
  const std::vector<ChartShape> shapes = make_shapes(task.charts);
  const bool separate = shapes.size() <= kMostImproved && task.frames.size() == 1 &&
                        (task.record.timed() || task.options.moves > 0);
  search_best_fit(shapes, task.options, task.frames, task.record, !separate);
  if (!task.record.best() && !task.record.stopped()) task.offer_first();
  if (separate && task.record.best()) {
    Lines lines(shapes, task.options, task.frames, task.record);
    lines.begin_with(*task.record.best(), true);
    lines.run();
  }
}

}  // namespace

Result<Packing> pack_guided(std::span<const Chart> charts, const PackOptions& options,
                            FirstPacker first) {
  const auto start = Effort::Clock::now();
  auto frames = make_frames(options, fine_cell(options, charts.size()));
  if (!frames) return frames.error();
  if (options.pages != 1 || options.density > 0) {
    return pack_pages(make_shapes(charts), options, without_mirrored(*frames, options.wrap, {}));
  }
  Task task{charts, options, std::move(*frames), first, Record(options), {}};
  if (charts.size() <= kMostSeparated) {
    separate_few(task);
  } else {
    fit_many(task);
  }
  if (!task.record.best()) {
    if (task.failure) return *task.failure;
    return Error{ErrorKind::interrupted, "", "stopped before a packing was found", ""};
  }
  Packing packing = std::move(*task.record.best());
  packing.interrupted = packing.interrupted || task.record.stopped();
  packing.raster_seconds = 0;
  packing.place_seconds = std::chrono::duration<double>(Effort::Clock::now() - start).count();
  return packing;
}

}  // namespace wrapatlas
