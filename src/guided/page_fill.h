// Charts onto pages at one scale: see docs/algorithms/pages.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "guided/best_fit.h"
#include "guided/piece_library.h"
#include "pack/frame.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// What every attempt at filling pages has in common.
struct PageTask {
  std::span<const ChartShape> shapes;
  std::span<const std::vector<double>> angles;  ///< radians, per chart
  const Frame& frame;
  Wrap wrap;
  Coverage coverage;
  BestFitCare care;
};

struct PageFilling {
  std::vector<Placement> placements;  ///< one per chart
  std::vector<std::int64_t> cells;    ///< covered, per page; no page is empty

  [[nodiscard]] int pages() const { return static_cast<int>(cells.size()); }
  [[nodiscard]] std::int64_t covered() const;
};

/// What an attempt that failed tells.
struct HowFar {
  double placed = 0;                      ///< area of the charts that were placed, input units^2
  std::optional<std::uint32_t> left_out;  ///< the chart that the last page had no room for
};

/// Fills one page after the other: each gets, in the given order (by decreasing extent, roughly),
/// what it has room for. So every chart is on the first page that had room for it, but for those
/// that were not tried where others of their size had failed. Nothing if a chart is left after
/// `most` pages (0: any number), if one does not fit on an empty page, or if `stop` says so.
/// `how_far`, if not null: what was placed is added to it, whatever comes of it.
std::optional<PageFilling> fill_pages(const PageTask& task, double scale,
                                      std::span<const std::uint32_t> order, int most,
                                      const std::function<bool()>& stop, HowFar* how_far = nullptr);

/// Charts by decreasing extent, thin rings and arcs before what has room inside them; blurred a
/// little if `blur` is not 0.
std::vector<std::uint32_t> order_by_extent(std::span<const ChartShape> shapes,
                                           std::vector<std::uint32_t> charts, std::uint64_t blur);

/// The chart that allows the smallest scale on a page of its own, if that is less than `scale`.
struct TooLarge {
  std::size_t chart = 0;
  double largest_scale = 0;  ///< 0: none was found
};
std::optional<TooLarge> find_too_large(const PageTask& task, double scale,
                                       const std::function<bool()>& stop);

}  // namespace wrapatlas
