#include "guided/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "guided/best_fit.h"
#include "guided/best_fit_search.h"
#include "guided/page_fill.h"
#include "guided/record.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

Error no_packing(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::no_packing, std::move(where), std::move(what), std::move(remedy)};
}

std::string pages_text(int pages, const PackOptions& options) {
  return fmt::format("{} of {} x {} texels", pages == 1 ? "1 page" : fmt::format("{} pages", pages),
                     options.width, options.height);
}

/// The fewest pages at a given scale, on one frame.
class DensitySearch {
 public:
  /// `share`: of the time, after which it ends.
  DensitySearch(const PageTask& task, const PackOptions& options, Record& record, double share)
      : task_(task), options_(options), record_(record), share_(share) {}

  void run() {
    std::vector<std::uint32_t> charts(task_.shapes.size());
    std::iota(charts.begin(), charts.end(), 0U);
    auto filling = fill(order_by_extent(task_.shapes, std::move(charts), 0), kMostPages);
    if (!filling) return;
    best_ = std::move(*filling);
    offer();
    std::uint64_t blur = 1;
    do {
      bool promising = false;
      for (int count = 2; count <= most_filled_anew() && !done(); ++count) {
        if (!may_empty_one_of(count)) continue;
        promising = true;
        if (empty_one_of(count, blur)) count = 1;
        blur += kAtOnce;
      }
      if (!promising) return;
    } while (record_.timed() && !done());
  }

 private:
  static constexpr std::size_t kAtOnce = 2;

  /// Pages that are filled anew to save one of them: few, unless there is time.
  [[nodiscard]] int most_filled_anew() const {
    constexpr int kCheap = 5;
    return record_.timed() ? best_.pages() : std::min(best_.pages(), kCheap);
  }
  [[nodiscard]] bool done() { return record_.enough(share_); }
  std::optional<PageFilling> fill(const std::vector<std::uint32_t>& order, int most) {
    return fill_pages(task_, options_.density, order, most, [this] { return done(); });
  }
  void offer() {
    record_.offer(make_packing(task_.frame, task_.wrap, options_.density, total_area(task_.shapes),
                               best_.placements, best_.covered(), best_.pages()),
                  1);
  }

  /// The pages with the least on them, the emptiest first.
  [[nodiscard]] std::vector<int> emptiest(int count) const {
    std::vector<int> pages(best_.cells.size());
    std::iota(pages.begin(), pages.end(), 0);
    std::stable_sort(pages.begin(), pages.end(), [this](int a, int b) {
      return best_.cells[static_cast<std::size_t>(a)] < best_.cells[static_cast<std::size_t>(b)];
    });
    pages.resize(static_cast<std::size_t>(count));
    return pages;
  }

  /// Would the other pages then be no fuller than the fullest is now?
  [[nodiscard]] bool may_empty_one_of(int count) const {
    double cells = 0;
    for (const int page : emptiest(count)) {
      cells += static_cast<double>(best_.cells[static_cast<std::size_t>(page)]);
    }
    const auto fullest = *std::max_element(best_.cells.begin(), best_.cells.end());
    return cells <= (count - 1) * static_cast<double>(fullest);
  }

  /// Fills the emptiest pages anew, to need one less of them.
  bool empty_one_of(int count, std::uint64_t blur) {
    const std::vector<int> pages = emptiest(count);
    std::vector<int> number(best_.cells.size(), -1);  // among them
    for (int i = 0; i < count; ++i)
      number[static_cast<std::size_t>(pages[static_cast<std::size_t>(i)])] = i;
    std::vector<std::uint32_t> charts;
    for (std::uint32_t i = 0; i < best_.placements.size(); ++i) {
      if (number[static_cast<std::size_t>(best_.placements[i].page)] >= 0) charts.push_back(i);
    }
    std::array<std::optional<PageFilling>, kAtOnce> found;
    parallel_for(kAtOnce, thread_count(options_.threads), [&](std::size_t i) {
      found[i] =
          fill(order_by_extent(task_.shapes, charts, options_.seed * 7919 + blur + i), count - 1);
    });
    for (const auto& filling : found) {
      if (!filling) continue;
      take(*filling, charts, number);
      offer();
      return true;
    }
    return false;
  }

  /// Puts the charts of some pages where a filling of fewer pages has them. `number` is -1 for the
  /// pages that stay.
  void take(const PageFilling& filling, const std::vector<std::uint32_t>& charts,
            const std::vector<int>& number) {
    PageFilling joined;
    std::vector<int> moved(best_.cells.size(), 0);
    for (std::size_t page = 0; page < number.size(); ++page) {
      if (number[page] >= 0) continue;
      moved[page] = joined.pages();
      joined.cells.push_back(best_.cells[page]);
    }
    joined.placements = best_.placements;
    for (Placement& placement : joined.placements) {
      placement.page = moved[static_cast<std::size_t>(placement.page)];
    }
    for (const std::uint32_t chart : charts) {
      joined.placements[chart] = filling.placements[chart];
      joined.placements[chart].page += joined.pages();
    }
    joined.cells.insert(joined.cells.end(), filling.cells.begin(), filling.cells.end());
    best_ = std::move(joined);
  }

  const PageTask& task_;
  const PackOptions& options_;
  Record& record_;
  double share_;
  PageFilling best_;
};

/// Is each chart small enough for a page of its own, on one of the frames at least?
Status check_sizes(std::span<const PageTask> tasks, const PackOptions& options, Record& record) {
  constexpr double kRoundedDown = 0.9995;  // to four digits it is not more
  std::optional<TooLarge> least;
  for (const PageTask& task : tasks) {
    const auto found = find_too_large(task, options.density, [&record] { return record.poll(); });
    if (!found) return Done{};
    if (!least || found->largest_scale > least->largest_scale) least = found;
  }
  Error error =
      no_packing(fmt::format("chart {}", least->chart),
                 fmt::format("at this density it is larger than a page of {} x {} texels",
                             options.width, options.height),
                 least->largest_scale > 0
                     ? fmt::format("{:.4g} times the density would fit, or raise --resolution",
                                   kRoundedDown * least->largest_scale / options.density)
                     : "raise --resolution, or lower --padding and --margin");
  error.density_that_fits = least->largest_scale;
  return error;
}

Error too_many_pages(const Packing& packing, const PackOptions& options) {
  const double smaller = std::sqrt(double(options.pages) / packing.pages);
  return no_packing(
      "",
      fmt::format("at this density {} {} not hold the charts", pages_text(options.pages, options),
                  options.pages == 1 ? "does" : "do"),
      fmt::format("{} do; so would {}, roughly, at {:.2g} times the density", packing.pages,
                  options.pages, smaller));
}

Error nothing_found(std::size_t charts, const PackOptions& options) {
  if (options.density > 0) {
    return no_packing("",
                      fmt::format("at this density {} charts need more than {}", charts,
                                  pages_text(kMostPages, options)),
                      "lower the density, or raise --resolution");
  }
  return no_packing("",
                    fmt::format("no scale was found at which {} charts fit {}", charts,
                                pages_text(options.pages, options)),
                    "raise --resolution or --pages, or lower --padding and --margin");
}

Status fill_at_density(std::span<const ChartShape> shapes, const PackOptions& options,
                       std::span<const Frame> frames, Record& record) {
  std::vector<std::vector<double>> angles;
  for (const ChartShape& shape : shapes) {
    angles.push_back(best_fit_angles(shape.base_angle, options.rotations));
  }
  std::vector<PageTask> tasks;
  for (const Frame& frame : frames) {
    tasks.push_back(
        {shapes, angles, frame, options.wrap, options.coverage, care_for(shapes.size(), false)});
  }
  if (const Status small = check_sizes(tasks, options, record); !small) return small.error();
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(tasks.size());
    DensitySearch(tasks[i], options, record, share).run();
  }
  return Done{};
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
    if (const Status ok = fill_at_density(shapes, options, frames, record); !ok) return ok.error();
  } else {
    search_best_fit(shapes, options, frames, record, true);
  }
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
