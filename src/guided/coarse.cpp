#include "guided/coarse.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

constexpr double kAimed = 0.85;  ///< efficiency at which the domain has CoarseOptions::side cells
constexpr double kStart = 0.55;  ///< efficiency of the first domain
constexpr int kLongest = 16;     ///< times CoarseOptions::side: charts and domains up to that
constexpr double kLeastChance = 1e-3;
constexpr int kFirstStride = 3;  ///< steps at a time until the first domain that was not filled

std::vector<Place> scaled(const std::vector<Place>& places, PieceLibrary& library,
                          const Domain& from, const Domain& to) {
  Layout layout;
  layout.spots = to_spots(places, library, from);
  return to_places(layout, library, to);
}

}  // namespace

CoarseSearch::CoarseSearch(std::span<const ChartShape> shapes, Vec2 lengths, bool wraps_x,
                           bool wraps_y, const CoarseOptions& options, std::uint64_t seed)
    : shapes_(shapes),
      lengths_(lengths),
      wraps_x_(wraps_x),
      wraps_y_(wraps_y),
      options_(options),
      area_(total_area(shapes)),
      random_(seed) {
  cells_per_unit_ = options_.side * std::sqrt(kAimed / area_);
  RasterScale scale;
  scale.cells_per_unit = {cells_per_unit_, cells_per_unit_};
  scale.growth = options_.grown * options_.side / std::sqrt(lengths_.x * lengths_.y);
  scale.coverage = Coverage::center;
  library_ =
      std::make_unique<PieceLibrary>(shapes_, scale, options_.angles, kLongest * options_.side);
  double sum = 0;
  for (const ChartShape& shape : shapes_) {
    // Of the root of the root of the area: large charts matter more than tiny ones.
    sum += std::sqrt(std::sqrt(shape.area / area_)) + kLeastChance;
    chances_.push_back(sum);
  }
  start_step_ = static_cast<int>(std::lround(2 * options_.side * std::sqrt(kAimed / kStart)));
  begin_anew();
}

/// All charts anywhere, on a large domain.
void CoarseSearch::begin_anew() {
  step_ = step_of_places_ = start_step_;
  filled_step_ = failures_ = 0;
  stride_ = kFirstStride;
  near_.clear();
  const Domain domain = domain_at(step_);
  places_.clear();
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    places_.push_back({random_.below(options_.angles), random_.below(domain.width),
                       random_.below(domain.height)});
  }
}

void CoarseSearch::begin_with(const Layout& layout) {
  const double side = cells_per_unit_ * std::sqrt(lengths_.x * lengths_.y) / layout.scale;
  constexpr double kRoom = 1.01;  // as the grids differ
  step_ = step_of_places_ = static_cast<int>(std::ceil(2 * kRoom * side));
  places_ = to_places(layout, *library_, domain_at(step_));
  stride_ = 1;
}

/// Half steps: every second one takes a column away, the others a row.
Domain CoarseSearch::domain_at(int step) const {
  const double aspect = std::sqrt(lengths_.x / lengths_.y);
  const double columns = (step + 1) / 2, rows = step / 2;  // NOLINT(bugprone-integer-division)
  return {std::max(1, static_cast<int>(std::lround(columns * aspect))),
          std::max(1, static_cast<int>(std::lround(rows / aspect))), wraps_x_, wraps_y_};
}

double CoarseSearch::efficiency() const {
  if (!found()) return 0;
  const Domain domain = domain_at(best_step_);
  return cells_per_unit_ * cells_per_unit_ * area_ / (double(domain.width) * domain.height);
}

Layout CoarseSearch::best() {
  const Domain domain = domain_at(best_step_);
  Layout layout;
  layout.spots = to_spots(best_places_, *library_, domain);
  layout.scale =
      cells_per_unit_ * std::sqrt(lengths_.x * lengths_.y / (double(domain.width) * domain.height));
  return layout;
}

void CoarseSearch::adopt(const CoarseSearch& other) {
  best_step_ = filled_step_ = other.best_step_;
  best_places_ = filled_places_ = other.best_places_;
  places_ = best_places_;
  step_of_places_ = best_step_;
  step_ = best_step_ - 1;
  stride_ = 1;
  failures_ = 0;
  near_.clear();
}

/// Turns charts that cannot lie in the domain at their angle.
bool CoarseSearch::fit_angles(const Domain& domain, std::vector<Place>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    int tries = 0;
    const int first = places[i].angle;
    while (!admits(domain, library_->piece(i, places[i].angle))) {
      if (++tries == options_.angles) return false;
      places[i].angle = (first + tries) % options_.angles;
    }
    const Piece& piece = library_->piece(i, places[i].angle);
    if (!domain.wraps_x) places[i].x = std::clamp(places[i].x, 0, domain.width - piece.width);
    if (!domain.wraps_y) places[i].y = std::clamp(places[i].y, 0, domain.height - piece.height);
  }
  return true;
}

void CoarseSearch::keep_near(std::int64_t overlap, const std::vector<Place>& places) {
  const auto at =
      std::upper_bound(near_.begin(), near_.end(), overlap,
                       [](std::int64_t cells, const Near& near) { return cells < near.overlap; });
  near_.insert(at, {overlap, places});
}

/// After a domain was not filled: mostly to one of the layouts that came close to filling it,
/// sometimes to the last domain that was filled.
void CoarseSearch::retreat() {
  const double u = random_.unit();
  const auto chosen = static_cast<std::size_t>(u * u * static_cast<double>(near_.size() + 1));
  const bool close = chosen < near_.size();
  places_ = close ? near_[chosen].places : filled_places_;
  step_of_places_ = close ? step_ : filled_step_;
}

/// The larger, the likelier.
std::size_t CoarseSearch::any_chart() {
  const double at = random_.unit() * chances_.back();
  const auto found = std::upper_bound(chances_.begin(), chances_.end() - 1, at);
  return static_cast<std::size_t>(found - chances_.begin());
}

/// Swaps two charts, once or twice; of one or two charts it throws one anywhere.
void CoarseSearch::disturb(std::vector<Place>& places, const Domain& domain) {
  if (places.size() < 3) {
    places[any_chart()] = {random_.below(options_.angles), random_.below(domain.width),
                           random_.below(domain.height)};
    return;
  }
  const int swaps = 1 + random_.below(2);
  for (int i = 0; i < swaps; ++i) {
    const std::size_t a = any_chart();
    std::size_t b = any_chart();
    while (a == b) b = any_chart();
    std::swap(places[a].x, places[b].x);
    std::swap(places[a].y, places[b].y);
  }
}

void CoarseSearch::run(Effort& effort, bool until_stuck) {
  SeparateOptions options;
  options.stall_rounds = until_stuck ? options_.hasty_rounds : options_.stall_rounds;
  options.effort = &effort;
  while (step_ > 1 && !effort.spent()) {
    effort.count_move();  // of one chart no move may ever be needed
    const Domain domain = domain_at(step_);
    std::vector<Place> places = scaled(places_, *library_, domain_at(step_of_places_), domain);
    bool filled = false;
    if (fit_angles(domain, places)) {
      Separator separator(*library_, domain, random_);
      filled = separator.run(places, options);
      if (!filled) keep_near(separator.least(), places);
    }
    if (filled) {
      filled_step_ = step_of_places_ = step_;
      filled_places_ = places_ = places;
      failures_ = 0;
      near_.clear();
      if (best_step_ == 0 || step_ < best_step_) {
        best_step_ = step_;
        best_places_ = places;
      }
      step_ -= stride_;
      continue;
    }
    if (effort.spent()) break;
    if (filled_step_ == 0) {  // a hard set: more room
      step_ += 1 + step_ / 20;
      near_.clear();
      if (step_ > 2 * kLongest * options_.side) return;
      start_step_ = std::max(start_step_, step_);
      places_ = places;
      step_of_places_ = step_;
      continue;
    }
    stride_ = 1;
    if (++failures_ > options_.patience) {
      begin_anew();
      continue;
    }
    retreat();
    disturb(places_, domain_at(step_of_places_));
    if (until_stuck) break;
  }
}

}  // namespace wrapatlas
