#include "guided/page_fill.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "guided/best_fit.h"
#include "guided/piece.h"
#include "guided/random.h"

namespace wrapatlas {
namespace {

/// Whether a page is worth another try. Charts come by decreasing extent: once some in a row found
/// no room, those of about their size are mostly passed over.
class Patience {
 public:
  [[nodiscard]] bool tries(double extent) {
    if (left_out_ >= wait_ || extent < kSmaller * failed_extent_) return true;
    ++left_out_;
    return false;
  }
  void failed(double extent) {
    left_out_ = 0;
    failed_extent_ = failures_ == 0 ? extent : std::min(failed_extent_, extent);
    ++failures_;
    wait_ = failures_ < kFree ? 0 : std::min(2 * wait_ + 1, kLongestWait);
  }
  void succeeded() {
    failures_ /= 2;
    wait_ /= 8;
    left_out_ = 0;
  }

 private:
  static constexpr int kFree = 4;  ///< failures in a row without consequences
  static constexpr int kLongestWait = 1 << 20;
  static constexpr double kSmaller = 0.9;

  int failures_ = 0, wait_ = 0, left_out_ = 0;
  double failed_extent_ = 0;
};

double cells_of(const Frame& frame) { return double(frame.width) * frame.height; }

/// Cells that a chart covers at the least.
double least_cells(const PageTask& task, double area, double scale) {
  if (task.coverage != Coverage::conservative) return 0;
  return area * scale * scale / (task.frame.cell.x * task.frame.cell.y);
}

}  // namespace

std::int64_t PageFilling::covered() const {
  return std::accumulate(cells.begin(), cells.end(), std::int64_t{0});
}

std::vector<std::uint32_t> order_by_extent(std::span<const ChartShape> shapes,
                                           std::vector<std::uint32_t> charts, std::uint64_t blur) {
  constexpr double kBlur = 0.5;
  Random random(blur);
  std::vector<double> size(shapes.size());
  for (const std::uint32_t chart : charts) {
    size[chart] = shapes[chart].extent * (blur == 0 ? 1 : std::exp(kBlur * (random.unit() - 0.5)));
  }
  std::stable_sort(charts.begin(), charts.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return size[a] > size[b]; });
  return charts;
}

std::optional<PageFilling> fill_pages(const PageTask& task, double scale,
                                      std::span<const std::uint32_t> order, int most,
                                      const std::function<bool()>& stop, HowFar* how_far) {
  PageFilling filling;
  filling.placements.resize(task.shapes.size());
  std::vector<std::uint32_t> rest(order.begin(), order.end()), next;
  double rest_cells = 0;
  for (const std::uint32_t chart : rest) {
    const double least = least_cells(task, task.shapes[chart].area, scale);
    if (least > cells_of(task.frame)) return {};
    rest_cells += least;
  }
  while (!rest.empty()) {
    const int pages = filling.pages();
    if (most > 0 && rest_cells > (most - pages) * cells_of(task.frame)) return {};
    const bool last = pages + 1 == most;
    BestFitPage page(task.frame, task.wrap, task.coverage, scale, task.care);
    std::int64_t taken = 0;
    Patience patience;
    next.clear();
    for (const std::uint32_t chart : rest) {
      if (stop()) return {};
      const ChartShape& shape = task.shapes[chart];
      const double least = least_cells(task, shape.area, scale);
      std::optional<BestFitPage::Spot> spot;
      const double free = cells_of(task.frame) - static_cast<double>(taken);
      if (least <= free && (last || patience.tries(shape.extent))) {
        spot = page.place(shape, task.angles[chart]);
        if (!spot && taken == 0) {
          spot = page.place_alone(shape.raster, task.angles[chart]);
          if (!spot) return {};
        }
        if (!spot) patience.failed(shape.extent);
      }
      if (!spot) {
        if (last) {
          if (how_far != nullptr) how_far->left_out = chart;
          return {};
        }
        next.push_back(chart);
        continue;
      }
      patience.succeeded();
      filling.placements[chart] = spot->placement;
      filling.placements[chart].page = pages;
      taken += spot->cells;
      rest_cells -= least;
      if (how_far != nullptr) how_far->placed += shape.area;
    }
    filling.cells.push_back(taken);
    rest.swap(next);
  }
  return filling;
}

namespace {

bool fits_alone(const PageTask& task, std::size_t chart, double scale) {
  const Frame& frame = task.frame;
  const Domain domain = domain_of(frame, task.wrap);
  const RasterScale raster_scale = raster_scale_on(frame, scale, task.coverage);
  for (const double angle : task.angles[chart]) {
    const ChartRaster raster =
        rasterize_cells(task.shapes[chart].raster, raster_scale, angle,
                        kLongestInDomains * std::max(domain.width, domain.height));
    if (raster.width > 0 && admits(domain, make_bare_piece(raster))) return true;
  }
  return false;
}

/// No chart of this radius (in input units, from the middle of its box) is ever too large.
double harmless_radius(const Frame& frame, double scale) {
  const Vec2 texels = frame.lengths();
  const double border = (frame.growth + 1) * std::max(frame.cell.x, frame.cell.y);
  return (std::min(texels.x, texels.y) / 2 - border) / scale;
}

double radius_of(const RasterShape& shape) {
  double radius = 0;
  for (const Vec2 point : shape.points) radius = std::max(radius, length(point));
  return radius;
}

}  // namespace

std::optional<TooLarge> find_too_large(const PageTask& task, double scale,
                                       const std::function<bool()>& stop) {
  constexpr double kTolerance = 1e-3;
  std::optional<TooLarge> worst;
  for (std::size_t chart = 0; chart < task.shapes.size() && !stop(); ++chart) {
    if (radius_of(task.shapes[chart].raster) < harmless_radius(task.frame, scale)) continue;
    if (fits_alone(task, chart, scale)) continue;
    double fits = scale, fails = scale;
    while (fits > 1e-6 * scale && !fits_alone(task, chart, fits)) {
      fails = fits;
      fits /= 2;
    }
    if (!fits_alone(task, chart, fits)) return TooLarge{chart, 0};
    while (fails > (1 + kTolerance) * fits) {
      const double middle = (fits + fails) / 2;
      (fits_alone(task, chart, middle) ? fits : fails) = middle;
    }
    worst = TooLarge{chart, fits};
    scale = fits;
  }
  return worst;
}

}  // namespace wrapatlas
