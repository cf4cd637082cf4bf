// Few charts: modulo's packing, then separation. More: best fit, then separation if there is time.
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
#include "pack/parallel.h"

namespace wrapatlas {
namespace {

/// Separation looks at all other charts at every move.
constexpr std::size_t kMostSeparated = 200;
/// Up to so many charts separation goes on from best fit.
constexpr std::size_t kMostImproved = 1000;

/// Texels to a cell of the final grid.
double fine_cell(const PackOptions& options, std::size_t charts) {
  const int finest = charts > kMostSeparated ? 4096 : 2048;
  const int longest = std::max(options.width, options.height);
  if (options.grid > 0) return double(longest) / options.grid;
  return std::max(1.0, double(longest) / finest);
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
  auto fine = refine(shapes, frame, options, assembly->layout, how, effort, random);
  if (fine) record.offer(std::move(*fine), 1);
}

}  // namespace

Result<Packing> pack_guided(std::span<const Chart> charts, const PackOptions& options,
                            FirstPacker first) {
  const auto start = Effort::Clock::now();
  const auto frames = make_frames(options, fine_cell(options, charts.size()));
  if (!frames) return frames.error();
  double area = 0;
  for (const Chart& chart : charts) area += chart.area;
  if (options.pages != 1 || options.density > 0) {
    return pack_pages(make_shapes(charts), options, *frames);
  }
  Record record(options);
  const bool separate = charts.size() <= kMostSeparated;
  std::optional<Error> failure;
  const auto take_first = [&] {
    PackOptions modulo = options;
    modulo.method = Method::modulo;
    auto packing = first(charts, modulo, area);
    if (!packing) {
      failure = packing.error();
    } else {
      record.offer(std::move(*packing), 0);
    }
  };
  if (separate) take_first();
  if (failure && failure->kind == ErrorKind::interrupted) return *failure;
  if (record.best() && record.best()->interrupted) return std::move(*record.best());
  const std::vector<ChartShape> shapes = make_shapes(charts);
  if (separate) {
    // With so little time separation may come to nothing.
    constexpr double kShort = 0.5;
    if (record.timed() && options.time < kShort) {
      search_best_fit(shapes, options, *frames, record, false);
    }
    search_assembly(shapes, options, *frames, record);
    Lines lines(shapes, options, *frames, record);
    if (record.best()) lines.begin_with(*record.best(), false);
    lines.run();
  } else {
    const bool improve = charts.size() <= kMostImproved && frames->size() == 1 &&
                         (record.timed() || options.moves > 0);
    search_best_fit(shapes, options, *frames, record, !improve);
    if (!record.best() && !record.stopped()) take_first();
    if (improve && record.best()) {
      Lines lines(shapes, options, *frames, record);
      lines.begin_with(*record.best(), true);
      lines.run();
    }
  }
  if (!record.best()) {
    if (failure) return *failure;
    return Error{ErrorKind::interrupted, "", "stopped before a packing was found", ""};
  }
  Packing packing = std::move(*record.best());
  packing.interrupted = packing.interrupted || record.stopped();
  packing.raster_seconds = 0;
  packing.place_seconds = std::chrono::duration<double>(Effort::Clock::now() - start).count();
  return packing;
}

}  // namespace wrapatlas
