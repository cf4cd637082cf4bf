// Which charts come too close to each other, and which lie on themselves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "validate/divide.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::validate {

/// The worst place of one kind between two charts (or a chart and its own image).
struct PairRecord {
  Violation kind = Violation::overlap;
  std::uint32_t chart_a = 0, chart_b = 0;
  std::uint32_t item_a = 0, item_b = 0;
  std::int32_t shift_x = 0, shift_y = 0;  ///< b is compared at corners - shift * period
  double amount = 0;                      ///< depth of an overlap, distance of a gap; texels
};

/// One record per kind and pair of charts, the worst; sorted by pair, then kind.
class WorstList {
 public:
  /// More pairs than this are not told apart; `full` says that there were more.
  explicit WorstList(std::size_t most) : most_(most) {}
  void add(const PairRecord& record);
  void compact();
  [[nodiscard]] bool full() const { return full_; }
  [[nodiscard]] const std::vector<PairRecord>& records() const { return records_; }
  void append(const WorstList& other);

 private:
  std::vector<PairRecord> records_;
  std::size_t most_, compact_at_ = 4096;
  bool full_ = false;
};

struct ClosePairs {
  std::vector<PairRecord> records;
  double smallest_gap = 0;  ///< over all pairs closer than `reach`, else reach
  bool complete = true;     ///< false: more pairs exist than are counted
};

struct PairLimits {
  double padding = 0, reach = 0;     ///< texels, reach >= padding
  std::span<const double> rounding;  ///< per chart: how far its corners may be off, texels
  int threads = 0;
};

/// All pairs of charts, and of charts and their images, that overlap or are closer than padding.
/// Items of one chart in the plane but in different groups (pieces of a cut chart) may touch.
Result<ClosePairs> find_close_pairs(std::span<const Item> items, Vec2 period,
                                    const PairLimits& limits);

/// Charts that overlap themselves without any shift: kind self_overlap, one record per chart.
/// Places where very many triangles of one chart meet are passed over (complete = false).
Result<ClosePairs> find_folds(std::span<const Item> items, const PairLimits& limits);

/// Per chart the lowest-numbered chart that it overlaps, directly or through others, in the plane.
Result<std::vector<std::uint32_t>> find_stacks(std::span<const Item> items, std::size_t charts,
                                               const PairLimits& limits);

/// What every judgement leaves to arithmetic, in texels, besides the rounding of the UVs.
inline constexpr double kSlack = 1e-6;

}  // namespace wrapatlas::validate
