#include "guided/separate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "guided/wrapped.h"

namespace wrapatlas {
namespace {

constexpr float kWeightUnit = 8;     ///< field weight of a cell whose pair has weight 1
constexpr float kLargestPair = 120;  ///< field weight of the dearest pair
constexpr float kMostWeight = 1e6F;  ///< of a pair; far beyond what the field can tell apart
constexpr float kDecay = 0.95F;
/// By which a chart's angle may change when it moves nearby, to either side; few, as each angle has
/// to be rasterised, and so that some of them have been before.
constexpr std::array<int, 3> kTurnsNearby{1, 4, 12};

/// Translations along one axis of the whole domain.
int positions(int size, int piece, bool wraps) { return wraps ? size : size - piece + 1; }

/// Where a cell of the domain is in a part of its axis.
int in_part(int cell, const Stretch& part, int size, bool wraps) {
  return wraps ? modulo(cell - part.origin, size) : cell - part.origin;
}

/// The part of an axis that a piece at `begin` with `length` cells covers when moved by up to
/// `window` cells.
Stretch stretch_around(int begin, int length, int window, int size, bool wraps) {
  if (wraps) {
    if (length + 2 * window >= size) {
      const int around = std::min(window, (size - 1) / 2);
      // The whole axis, turned so that the moves are one range of translations.
      return {modulo(begin - around, size), size, true};
    }
    return {modulo(begin - window, size), length + 2 * window, false};
  }
  const int from = std::max(0, begin - window), to = std::min(size - length, begin + window);
  return {from, to + length - from, false};
}

}  // namespace

Separator::Separator(PieceLibrary& library, const Domain& domain, Random& random)
    : library_(library),
      domain_(domain),
      random_(random),
      count_(library.charts()),
      covers_(count_),
      overlap_(count_ * count_),
      weight_(count_ * count_, 1.0F) {}

void Separator::put(std::size_t chart, const Place& place) {
  places_[chart] = place;
  covers_[chart].set(domain_, library_.piece(chart, place.angle), place.x, place.y);
  for (std::size_t other = 0; other < count_; ++other) {
    if (other == chart) continue;
    const auto shared = static_cast<std::int32_t>(Cover::shared(covers_[chart], covers_[other]));
    overlap_[pair(chart, other)] = overlap_[pair(other, chart)] = shared;
  }
}

void Separator::take(const std::vector<Place>& places) {
  places_ = places;
  for (std::size_t i = 0; i < count_; ++i) {
    const Place& p = places_[i];
    covers_[i].set(domain_, library_.piece(i, p.angle), p.x, p.y);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      overlap_[pair(i, j)] = overlap_[pair(j, i)] =
          static_cast<std::int32_t>(Cover::shared(covers_[i], covers_[j]));
    }
  }
}

bool Separator::overlaps(std::size_t chart) const {
  for (std::size_t j = 0; j < count_; ++j) {
    if (overlap_[pair(chart, j)] > 0) return true;
  }
  return false;
}

std::vector<std::size_t> Separator::overlapping() const {
  std::vector<std::size_t> charts;
  for (std::size_t i = 0; i < count_; ++i) {
    if (overlaps(i)) charts.push_back(i);
  }
  return charts;
}

std::int64_t Separator::total() const {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t j = 0; j < i; ++j) sum += overlap_[pair(i, j)];
  }
  return sum;
}

void Separator::fill_field(std::size_t chart, const Stretch& x, const Stretch& y) {
  float largest = 1;
  for (std::size_t j = 0; j < count_; ++j) largest = std::max(largest, weight_[pair(chart, j)]);
  const float unit = std::min(kWeightUnit, kLargestPair / largest);
  field_.reset(domain_, x, y, library_.reach(chart));
  for (std::size_t j = 0; j < count_; ++j) {
    if (j == chart) continue;
    const Place& p = places_[j];
    const int weight = std::max(1, static_cast<int>(std::lround(unit * weight_[pair(chart, j)])));
    field_.add(library_.piece(j, p.angle), p.x, p.y, weight);
  }
  field_.sum();
}

void Separator::move_anywhere(std::size_t chart, const SeparateOptions& options) {
  fill_field(chart, {0, domain_.width, domain_.wraps_x}, {0, domain_.height, domain_.wraps_y});
  field_.sort_by_phase();
  const Place old = places_[chart];
  Place to = old;
  Shift best{cost_at(field_, library_.piece(chart, old.angle).spread, old.x, old.y), old.x, old.y};
  const auto try_angle = [&](int angle) {
    const Piece& piece = library_.piece(chart, angle);
    if (!admits(domain_, piece)) return;
    ShiftRange range;
    range.x_end = positions(domain_.width, piece.width, domain_.wraps_x);
    range.y_end = positions(domain_.height, piece.height, domain_.wraps_y);
    range.y_start = random_.below(range.y_end);
    const std::uint16_t before = best.cost;
    best_shift(field_, piece, range, best);
    if (best.cost < before) to = {angle, best.x, best.y};
  };
  const int count = library_.angles();
  try_angle(old.angle);
  for (int k = 1; k <= options.near_angles && best.cost > 0; ++k) {
    try_angle(modulo(old.angle + k, count));
    if (best.cost > 0) try_angle(modulo(old.angle - k, count));
  }
  const double share = options.any_angles / count;
  const int first = random_.below(count);
  for (int k = 0; k < count && best.cost > 0; ++k) {
    if (random_.unit() < share) try_angle((first + k) % count);
  }
  put(chart, to);
}

void Separator::move_nearby(std::size_t chart, const SeparateOptions& options) {
  const Place old = places_[chart];
  const Piece& piece = library_.piece(chart, old.angle);
  // Room for pieces a little larger, as other angles may have them.
  constexpr int kSpare = 8;
  const Stretch x =
      stretch_around(old.x, piece.width, options.window + kSpare, domain_.width, domain_.wraps_x);
  const Stretch y =
      stretch_around(old.y, piece.height, options.window + kSpare, domain_.height, domain_.wraps_y);
  fill_field(chart, x, y);
  Place to = old;
  // What costs more than here is given up after a few runs. What costs as much may be taken.
  const int here = cost_at(field_, piece.spread, in_part(old.x, x, domain_.width, domain_.wraps_x),
                           in_part(old.y, y, domain_.height, domain_.wraps_y));
  Shift best{static_cast<std::uint16_t>(std::min<int>(here + 1, kMostCost)), 0, 0};
  const auto try_angle = [&](int angle) {
    const Piece& turned = library_.piece(chart, angle);
    if (!admits(domain_, turned)) return;
    // Same centre, then the window.
    const auto range_along = [&](double old_centre, double centre, int old_begin,
                                 const Stretch& part, int length, int size, bool wraps, int& begin,
                                 int& end) {
      const int aligned = old_begin + static_cast<int>(std::lround(old_centre - centre));
      const int at = in_part(aligned, part, size, wraps);
      begin = std::max(at - options.window, 0);
      end = at + options.window + 1;
      const int room = part.cyclic ? part.count : part.count - length + 1;
      end = std::min(end, room);
    };
    ShiftRange range;
    range_along(piece.centre.x, turned.centre.x, old.x, x, turned.width, domain_.width,
                domain_.wraps_x, range.x_begin, range.x_end);
    range_along(piece.centre.y, turned.centre.y, old.y, y, turned.height, domain_.height,
                domain_.wraps_y, range.y_begin, range.y_end);
    if (range.x_begin >= range.x_end || range.y_begin >= range.y_end) return;
    range.y_start = range.y_begin + random_.below(range.y_end - range.y_begin);
    const std::uint16_t before = best.cost;
    best_shift(field_, turned, range, best);
    if (best.cost < before) {
      to = {angle, x.origin + best.x, y.origin + best.y};
      if (domain_.wraps_x) to.x = modulo(to.x, domain_.width);
      if (domain_.wraps_y) to.y = modulo(to.y, domain_.height);
    }
  };
  try_angle(old.angle);
  for (int k = 0; k < 2 && best.cost > 0; ++k) {
    const int step =
        kTurnsNearby[static_cast<std::size_t>(random_.below(int{kTurnsNearby.size()}))];
    try_angle(modulo(old.angle + (k == 0 ? step : -step), library_.angles()));
  }
  put(chart, to);
}

void Separator::raise_weights() {
  const auto most = static_cast<float>(*std::max_element(overlap_.begin(), overlap_.end()));
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    if (overlap_[i] > 0) {
      const float raised = weight_[i] * (1.2F + 0.8F * static_cast<float>(overlap_[i]) / most);
      weight_[i] = std::min(raised, kMostWeight);
    } else {
      weight_[i] = std::max(1.0F, weight_[i] * kDecay);
    }
  }
}

bool Separator::run(std::vector<Place>& places, const SeparateOptions& options, Effort& effort) {
  take(places);
  std::fill(weight_.begin(), weight_.end(), 1.0F);
  least_ = total();
  std::vector<std::size_t> order;
  for (int stall = 0; least_ > 0 && stall < options.stall_rounds; ++stall) {
    order = overlapping();
    shuffle(order, random_);
    for (const std::size_t chart : order) {
      if (!overlaps(chart)) continue;
      if (options.window > 0) {
        move_nearby(chart, options);
      } else {
        move_anywhere(chart, options);
      }
      effort.count_move();
      if (effort.spent()) return least_ == 0;
    }
    const std::int64_t now = total();
    if (now < least_) {
      if (now * 50 < least_ * 49) stall = 0;
      least_ = now;
      places = places_;
    }
    raise_weights();
  }
  if (least_ > 0) take(places);
  return least_ == 0;
}

}  // namespace wrapatlas
