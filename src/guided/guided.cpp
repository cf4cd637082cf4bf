// Several lines of coarse search side by side; what they find is refined on the final grid, and the
// best valid packing so far is kept.

#include "guided/guided.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "charts/hull.h"
#include "guided/coarse.h"
#include "guided/refine.h"
#include "pack/frame.h"
#include "pack/parallel.h"

namespace wrapatlas {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Cells of the coarse grid: enough for each chart to have a shape.
int coarse_side(std::size_t charts) {
  constexpr double kCellsPerChart = 200;
  return std::clamp(static_cast<int>(std::sqrt(kCellsPerChart * static_cast<double>(charts))), 144,
                    512);
}

/// Texels to a cell of the final grid.
double fine_cell(const PackOptions& options) {
  constexpr int kFinest = 2048;
  const int longest = std::max(options.width, options.height);
  if (options.grid > 0) return double(longest) / options.grid;
  return std::max(1.0, double(longest) / kFinest);
}

std::vector<ChartShape> make_shapes(std::span<const Chart> charts) {
  std::vector<ChartShape> shapes;
  for (const Chart& chart : charts) {
    shapes.push_back(
        {make_raster_shape(chart), -smallest_box_direction(convex_hull(chart.points)), chart.area});
  }
  return shapes;
}

/// The best packing of all lines; knows when to stop, and says how far the work is.
class Record {
 public:
  Record(const PackOptions& options, double area, const Frame& frame)
      : options_(options), area_(area), frame_(frame) {}

  /// Of layouts of one scale the one of the smallest number wins, whichever line comes first.
  void offer(FineLayout&& layout, std::size_t number) {
    const std::lock_guard lock(mutex_);
    const double scale = layout.layout.scale, best = best_ ? best_->layout.scale : 0;
    if (scale < best || (scale == best && number > best_number_)) return;
    best_ = std::move(layout);
    best_number_ = number;
  }
  [[nodiscard]] double efficiency() const {
    return best_ ? best_->layout.scale * best_->layout.scale * area_ / frame_.texels() : 0;
  }
  [[nodiscard]] const std::optional<FineLayout>& best() const { return best_; }
  [[nodiscard]] bool stopped() const { return stopped_; }

  [[nodiscard]] bool poll() {
    if (!options_.progress || stopped_) return stopped_;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || seconds_since(last_) < 0.05) return stopped_;
    last_ = Clock::now();
    const double fraction =
        options_.time > 0 ? std::min(seconds_since(start_) / options_.time, 1.0) : 0.5;
    if (!options_.progress({fraction, efficiency()})) stopped_ = true;
    return stopped_;
  }

 private:
  const PackOptions& options_;
  double area_;
  const Frame& frame_;
  std::mutex mutex_;
  std::optional<FineLayout> best_;
  std::size_t best_number_ = 0;
  Clock::time_point start_ = Clock::now(), last_{};
  std::atomic<bool> stopped_{false};
};

/// One line of search.
struct Line {
  CoarseSearch coarse;
  Random random;
  std::size_t number = 0;
  std::size_t offers = 0;  ///< refined layouts so far
  double refined = 0;      ///< efficiency of the coarse layout last refined
};

class Guide {
 public:
  Guide(std::span<const ChartShape> shapes, const PackOptions& options, const Frame& frame,
        Record& record)
      : shapes_(shapes), options_(options), frame_(frame), record_(record) {
    CoarseOptions coarse;
    coarse.side = coarse_side(shapes.size());
    coarse.grown = options.padding / 2 + 0.3 * frame.cell.x;
    const Vec2 lengths{frame.width * frame.cell.x, frame.height * frame.cell.y};
    // Not as many as threads where the result must not depend on them.
    const int lines = timed() ? thread_count(options.threads) : 2;
    for (int i = 0; i < lines; ++i) {
      const std::uint64_t seed = options.seed * 1000003 + static_cast<std::uint64_t>(i);
      lines_.push_back({CoarseSearch(shapes, lengths, wraps_u(options.wrap), wraps_v(options.wrap),
                                     coarse, seed),
                        Random(seed ^ 0xf1e2d3c4), static_cast<std::size_t>(i)});
    }
  }

  void run() {
    const auto start = Clock::now();
    const auto at = [&](double share) {
      return start + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(options_.time * share));
    };
    each_line([&](Line& line) {
      Effort effort = make_effort();
      line.coarse.run(effort, true);
      improve(line, effort);
    });
    if (!timed() && options_.moves == 0) return;
    for (int epoch = 1; epoch <= kEpochs && !record_.stopped(); ++epoch) {
      share_best();
      each_line([&](Line& line) {
        Effort effort = make_effort(), last = make_effort();
        if (timed()) {
          effort.until(at(0.9 * epoch / kEpochs));
          last.until(at(1));
        } else {
          effort.moves(options_.moves / (kEpochs * static_cast<std::int64_t>(lines_.size())) + 1);
        }
        line.coarse.run(effort, false);
        if (line.coarse.efficiency() > line.refined) improve(line, last);
      });
    }
  }

 private:
  [[nodiscard]] bool timed() const { return options_.time > 0 && options_.moves == 0; }
  [[nodiscard]] Effort make_effort() {
    return Effort([this] { return record_.poll(); });
  }
  template <typename Job>
  void each_line(Job job) {
    parallel_for(lines_.size(), thread_count(options_.threads),
                 [&](std::size_t i) { job(lines_[i]); });
  }
  void improve(Line& line, Effort& effort) {
    if (!line.coarse.found()) return;
    line.refined = line.coarse.efficiency();
    auto fine = refine(shapes_, frame_, options_, line.coarse.best(), {}, effort, line.random);
    if (fine) record_.offer(std::move(*fine), line.offers++ * lines_.size() + line.number);
  }
  void share_best() {
    const auto best = std::max_element(
        lines_.begin(), lines_.end(),
        [](const Line& a, const Line& b) { return a.coarse.efficiency() < b.coarse.efficiency(); });
    for (Line& line : lines_) {
      if (line.coarse.efficiency() < best->coarse.efficiency()) line.coarse.adopt(best->coarse);
    }
  }

  static constexpr int kEpochs = 8;

  std::span<const ChartShape> shapes_;
  const PackOptions& options_;
  const Frame& frame_;
  Record& record_;
  std::vector<Line> lines_;
};

}  // namespace

std::optional<Packing> pack_guided(std::span<const Chart> charts, const PackOptions& options) {
  const auto start = Clock::now();
  auto frame = make_frame(options.width, options.height, fine_cell(options), options);
  if (!frame) return {};
  const std::vector<ChartShape> shapes = make_shapes(charts);
  double area = 0;
  for (const ChartShape& shape : shapes) area += shape.area;
  Record record(options, area, *frame);
  Guide guide(shapes, options, *frame, record);
  guide.run();
  if (!record.best()) return {};
  Packing packing;
  packing.width = frame->texture_width;
  packing.height = frame->texture_height;
  packing.wrap = options.wrap;
  packing.scale = record.best()->layout.scale;
  packing.placements = record.best()->placements;
  packing.efficiency = record.efficiency();
  packing.raster_efficiency =
      static_cast<double>(record.best()->covered_cells) / (double(frame->width) * frame->height);
  packing.grid_width = frame->width;
  packing.grid_height = frame->height;
  packing.interrupted = record.stopped();
  packing.place_seconds = seconds_since(start);
  return packing;
}

}  // namespace wrapatlas
