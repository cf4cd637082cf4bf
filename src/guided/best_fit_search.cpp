#include "guided/best_fit_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "guided/best_fit.h"
#include "guided/page_fill.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

/// Scales tried at once, whatever the number of threads, so that the result does not depend on it.
constexpr std::size_t kAtOnce = 2;
constexpr double kTolerance = 0.004;  ///< of the factor of the scale
constexpr double kSame = 1e-9;        ///< difference of factors
constexpr double kLikely = 0.8;       ///< a factor that most often succeeds
constexpr double kSmallest = 1e-3;    ///< give up when not even this does
/// From so many charts on what fits at one scale also fits at smaller ones, as good as always.
constexpr std::size_t kMany = 2000;
/// Up to so many an attempt that fails is made once more, with the chart that was left out earlier.
constexpr std::size_t kFew = 200;

class BestFitSearch {
 public:
  /// `share`: of the time, after which it ends.
  BestFitSearch(std::span<const ChartShape> shapes, const PackOptions& options, const Frame& frame,
                Record& record, double share)
      : shapes_(shapes),
        options_(options),
        frame_(frame),
        record_(record),
        share_(share),
        area_(total_area(shapes)) {
    full_scale_ = full_scale();
    for (const ChartShape& shape : shapes_) {
      angles_.push_back(best_fit_angles(shape.base_angle, options.rotations));
    }
    order_ = order_of(0);
  }

  void find_scale() {
    // Of no use is what is no denser than what another frame or method has come to.
    best_factor_ = found_factor_ = factor_of(record_.efficiency());
    double lower = best_factor_, upper = 1, likely = kLikely;
    while (!done() && upper - lower > std::min(kTolerance, upper / 10)) {
      std::array<double, kAtOnce> factors{lower + (upper - lower) / 3,
                                          lower + 2 * (upper - lower) / 3};
      if (lower == 0) factors = {likely, likely + (upper - likely) / 2};
      if (guess_ > lower && guess_ < upper) {
        factors = {guess_, std::min(guess_ + 0.75 * kTolerance, guess_ + (upper - guess_) / 2)};
      }
      guess_ = 0;
      const std::size_t success = try_all(factors);
      if (success < kAtOnce) {
        lower = factors[success];
        if (success + 1 < kAtOnce) upper = raised(factors[success + 1], upper);
      } else {
        upper = raised(factors[0], upper);
        likely = 0.75 * factors[0];
        if (upper < kSmallest) break;
      }
    }
  }

  /// Tries slightly larger scales with the charts in other orders.
  void vary() {
    constexpr double kStep = 1.002;
    for (std::uint64_t round = 1; best_factor_ > 0 && !done(); ++round) {
      parallel_for(kAtOnce, thread_count(options_.threads), [&](std::size_t i) {
        attempt(best_factor_ * kStep, order_of(round * kAtOnce + i), [this] { return done(); });
      });
      settle();
    }
  }

 private:
  [[nodiscard]] PageTask task() const {
    return {shapes_,       angles_,           frame_,
            options_.wrap, options_.coverage, care_for(shapes_.size(), hurried())};
  }

  /// At which the charts would fill the pages, or the largest of them one.
  [[nodiscard]] double full_scale() const {
    if (options_.pages <= 1) return std::sqrt(frame_.texels() / area_);
    double largest = 0;
    for (const ChartShape& shape : shapes_) largest = std::max(largest, shape.area);
    return std::sqrt(frame_.texels() / std::max(area_ / options_.pages, largest));
  }

  [[nodiscard]] double factor_of(double efficiency) const {
    const double pages = std::max(1, options_.pages);
    return std::sqrt(efficiency * pages * frame_.texels() / area_) / full_scale_;
  }

  /// A chart order: by extent, blurred a little for all numbers but 0.
  [[nodiscard]] std::vector<std::uint32_t> order_of(std::uint64_t number) const {
    std::vector<std::uint32_t> charts(shapes_.size());
    std::iota(charts.begin(), charts.end(), 0U);
    return order_by_extent(shapes_, std::move(charts),
                           number == 0 ? 0 : options_.seed * 7919 + number);
  }

  /// Success is not monotone: a scale that failed leaves some room above it (see scale_search.h).
  [[nodiscard]] double raised(double factor, double upper) const {
    return shapes_.size() >= kMany ? factor : factor + (upper - factor) / 4;
  }

  [[nodiscard]] bool hurried() const {
    constexpr double kShort = 3;  // seconds
    return record_.timed() && options_.time < kShort;
  }
  [[nodiscard]] bool done() { return record_.enough(share_); }

  /// The largest of the factors that succeeds, or their number.
  std::size_t try_all(const std::array<double, kAtOnce>& factors) {
    std::array<std::atomic<bool>, kAtOnce> succeeded{};
    std::array<std::vector<std::uint32_t>, kAtOnce> orders;
    // The largest first: once it succeeds the others need not.
    parallel_for(kAtOnce, thread_count(options_.threads), [&](std::size_t k) {
      const std::size_t i = kAtOnce - 1 - k;
      const auto stop = [&] {
        for (std::size_t larger = i + 1; larger < kAtOnce; ++larger) {
          if (succeeded[larger]) return true;
        }
        return done();
      };
      if (has_failed(factors[i])) return;
      orders[i] = order_;
      HowFar how_far;
      succeeded[i] = attempt(factors[i], orders[i], stop, &how_far);
      if (!succeeded[i] && how_far.left_out && shapes_.size() <= kFew) {
        bring_forward(orders[i], *how_far.left_out);
        succeeded[i] = attempt(factors[i], orders[i], stop);
      }
      if (!succeeded[i] && !stop()) note_failure(factors[i], how_far.placed);
    });
    settle();
    for (std::size_t i = kAtOnce; i-- > 0;) {
      if (!succeeded[i]) continue;
      if (orders[i] != order_) failed_.clear();
      order_ = orders[i];
      return i;
    }
    return kAtOnce;
  }

  /// A chart comes when half of those before it are placed.
  static void bring_forward(std::vector<std::uint32_t>& order, std::uint32_t chart) {
    const auto at = std::find(order.begin(), order.end(), chart);
    std::rotate(order.begin() + (at - order.begin()) / 2, at, at + 1);
  }

  /// In this order and in the one made from it, in which it would fail again.
  [[nodiscard]] bool has_failed(double factor) {
    const std::lock_guard lock(mutex_);
    return std::any_of(failed_.begin(), failed_.end(),
                       [&](double other) { return std::abs(factor - other) < kSame; });
  }
  /// `placed`: the area of what found room. Of many charts it tells how much finds room at other
  /// scales, the better the closer they are.
  void note_failure(double factor, double placed) {
    const std::lock_guard lock(mutex_);
    failed_.push_back(factor);
    if (shapes_.size() < kMany || (guess_ > 0 && guessed_from_ < factor)) return;
    guessed_from_ = factor;
    guess_ = factor * std::sqrt(placed / area_);
  }

  template <typename Stop>
  bool attempt(double factor, const std::vector<std::uint32_t>& order, Stop stop,
               HowFar* how_far = nullptr) {
    if (factor <= best_factor_) return false;
    auto filling = fill_pages(task(), factor * full_scale_, order, options_.pages, stop, how_far);
    if (!filling) return false;
    const std::lock_guard lock(mutex_);
    if (factor > found_factor_) {
      found_factor_ = factor;
      // A larger scale is better, be a page empty or not.
      record_.offer(
          make_packing(frame_, options_.wrap, factor * full_scale_, area_,
                       std::move(filling->placements), filling->covered(), options_.pages),
          1);
    }
    return true;
  }
  /// Between rounds, so that what a round does is the same however its attempts are timed.
  void settle() { best_factor_ = found_factor_; }

  std::span<const ChartShape> shapes_;
  const PackOptions& options_;
  const Frame& frame_;
  Record& record_;
  double share_;
  double area_ = 0, full_scale_ = 0;
  std::vector<std::vector<double>> angles_;
  std::vector<std::uint32_t> order_;  ///< by extent, but for charts that had to be brought forward
  std::mutex mutex_;
  double best_factor_ = 0, found_factor_ = 0;
  std::vector<double> failed_;  ///< factors
  double guess_ = 0;            ///< a factor that may just succeed, of this round; 0: none
  double guessed_from_ = 0;     ///< the smallest one that failed in this round
};

/// A packing soon, on a coarse grid: where time is short for so many pages, what is found first is
/// else far from the best.
void draft(std::span<const ChartShape> shapes, const PackOptions& options, const Frame& fine,
           Record& record) {
  constexpr double kCoarser = 4, kShare = 0.7;
  const auto frame =
      make_frame(fine.texture_width, fine.texture_height, kCoarser * fine.cell.x, options);
  if (frame) BestFitSearch(shapes, options, *frame, record, kShare).find_scale();
}

}  // namespace

void search_best_fit(std::span<const ChartShape> shapes, const PackOptions& options,
                     std::span<const Frame> frames, Record& record, bool go_on) {
  if (record.timed() && options.pages > 1) draft(shapes, options, frames.front(), record);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(frames.size());
    BestFitSearch search(shapes, options, frames[i], record, share);
    search.find_scale();
    if (go_on && frames.size() == 1 && record.timed()) search.vary();
  }
}

}  // namespace wrapatlas
