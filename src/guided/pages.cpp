#include "guided/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "guided/best_fit.h"
#include "guided/best_fit_search.h"
#include "guided/page_fill.h"
#include "guided/record.h"

namespace wrapatlas {
namespace {

Error no_packing(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::no_packing, std::move(where), std::move(what), std::move(remedy)};
}

std::string pages_text(int pages, const PackOptions& options) {
  return fmt::format("{} of {} x {} texels", pages == 1 ? "1 page" : fmt::format("{} pages", pages),
                     options.width, options.height);
}

/// Is each chart small enough for a page of its own, on one of the frames at least?
Status check_sizes(std::span<const ChartShape> shapes, const PackOptions& options,
                   std::span<const Frame> frames, Record& record) {
  std::vector<std::vector<double>> angles;
  for (const ChartShape& shape : shapes) {
    angles.push_back(best_fit_angles(shape.base_angle, options.rotations));
  }
  std::optional<TooLarge> least;
  for (const Frame& frame : frames) {
    const PageTask task{shapes, angles, frame, options.wrap, options.coverage};
    const auto found =
        find_too_large(task, options.density, [&record] { return record.poll(); });
    if (!found) return Done{};
    if (!least || found->largest_scale > least->largest_scale) least = found;
  }
  Error error = no_packing(
      fmt::format("chart {}", least->chart),
      fmt::format("at this density it is larger than a page of {} x {} texels", options.width,
                  options.height),
      least->largest_scale > 0
          ? fmt::format("{:.4g} times the density would fit, or raise --resolution",
                        std::floor(1e4 * least->largest_scale / options.density) / 1e4)
          : "raise --resolution, or lower --padding and --margin");
  error.density_that_fits = least->largest_scale;
  return error;
}

Error too_many_pages(const Packing& packing, const PackOptions& options) {
  const double smaller = std::sqrt(double(options.pages) / packing.pages);
  return no_packing(
      "", fmt::format("at this density {} do not hold the charts", pages_text(options.pages, options)),
      fmt::format("{} do; so would {}, roughly, at {:.2g} times the density", packing.pages,
                  options.pages, smaller));
}

Error nothing_found(std::size_t charts, const PackOptions& options) {
  if (options.density > 0) {
    return no_packing("", fmt::format("at this density {} charts need more than {}", charts,
                                      pages_text(kMostPages, options)),
                      "lower the density, or raise --resolution");
  }
  return no_packing("",
                    fmt::format("no scale was found at which {} charts fit {}", charts,
                                pages_text(options.pages, options)),
                    "raise --resolution or --pages, or lower --padding and --margin");
}

/// Leaves out pages at the end that no chart is on.
void drop_empty_pages(Packing& packing) {
  int used = 1;
  for (const Placement& placement : packing.placements) used = std::max(used, placement.page + 1);
  const double fewer = double(packing.pages) / used;
  packing.pages = used;
  packing.efficiency *= fewer;
  packing.raster_efficiency *= fewer;
}

}  // namespace

Result<Packing> pack_pages(std::span<const ChartShape> shapes, const PackOptions& options,
                           std::span<const Frame> frames) {
  const auto start = Effort::Clock::now();
  Record record(options);
  if (options.density > 0) {
    if (const Status small = check_sizes(shapes, options, frames, record); !small) {
      return small.error();
    }
  }
  search_best_fit(shapes, options, frames, record);
  if (!record.best() && record.stopped()) {
    return Error{ErrorKind::interrupted, "", "stopped before a packing was found", ""};
  }
  if (!record.best()) return nothing_found(shapes.size(), options);
  Packing packing = std::move(*record.best());
  drop_empty_pages(packing);
  if (options.pages > 0 && packing.pages > options.pages) return too_many_pages(packing, options);
  packing.interrupted = record.stopped();
  packing.place_seconds = std::chrono::duration<double>(Effort::Clock::now() - start).count();
  return packing;
}

}  // namespace wrapatlas
