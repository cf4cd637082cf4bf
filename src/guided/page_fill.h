// Charts onto pages at one scale: see docs/algorithms/pages.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

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
};

struct PageFilling {
  std::vector<Placement> placements;  ///< one per chart
  int pages = 0;                      ///< none is empty
  std::int64_t cells = 0;             ///< covered, of all pages
};

/// Fills one page after the other: each gets, in the given order (by decreasing area, roughly),
/// what it has room for. So every chart is on the first page that had room for it, but for those
/// that were not tried where others of their size had failed. Nothing if a chart is left after
/// `most` pages (0: any number), if one does not fit on an empty page, or if `stop` says so.
std::optional<PageFilling> fill_pages(const PageTask& task, double scale,
                                      std::span<const std::uint32_t> order, int most,
                                      const std::function<bool()>& stop);

/// The chart that allows the smallest scale on a page of its own, if that is less than `scale`.
struct TooLarge {
  std::size_t chart = 0;
  double largest_scale = 0;  ///< 0: none was found
};
std::optional<TooLarge> find_too_large(const PageTask& task, double scale,
                                       const std::function<bool()>& stop);

}  // namespace wrapatlas
