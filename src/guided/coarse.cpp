#include "guided/coarse.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

constexpr double kAimed = 0.85;  ///< efficiency at which the domain has CoarseOptions::side cells
constexpr int kLongest = 16;     ///< times CoarseOptions::side: charts and domains up to that
constexpr double kThinnest =
    1.5;  ///< cells; thinner charts are grown to it, that none slips through another
constexpr double kEnlarged = 0.5;  ///< cells by which charts that hold each other are grown
constexpr int kMostEnlarged = 6;   ///< times
constexpr double kLeastChance = 1e-3;
constexpr int kFirstStride = 3;  ///< steps at a time until the first domain that was not filled
/// Of a domain of any shape: the longest, as in the paper; by what power of two its aspect changes
/// from one to the next, twice the deviation; failures after which another one is tried.
constexpr double kMostAspect = 8, kAspectSpread = 0.1;
constexpr int kTriesOfShape = 4;
/// Cells of overlap that may come to nothing on a finer grid, whatever the side.
constexpr std::int64_t kMostNear = 10;

double square(double x) { return x * x; }
double cells(const Domain& domain) { return double(domain.width) * domain.height; }
double aspect_of(const Domain& domain) { return double(domain.width) / domain.height; }

std::vector<Place> scaled(const std::vector<Place>& places, PieceLibrary& library,
                          const Domain& from, const Domain& to) {
  Layout layout;
  layout.spots = to_spots(places, library, from);
  return to_places(layout, library, to);
}

}  // namespace

Layout CoarseFind::on(Vec2 lengths) const {
  Layout there = layout;
  there.scale *= std::sqrt(lengths.x * lengths.y);
  return there;
}

CoarseSearch::CoarseSearch(std::span<const ChartShape> shapes, Vec2 lengths, bool wraps_x,
                           bool wraps_y, const CoarseOptions& options, std::uint64_t seed)
    : shapes_(shapes),
      texels_(lengths.x * lengths.y),
      aspect_(lengths.x / lengths.y),
      wraps_x_(wraps_x),
      wraps_y_(wraps_y),
      options_(options),
      area_(total_area(shapes)),
      random_(seed),
      enlarged_(shapes.size()) {
  cells_per_unit_ = options_.side * std::sqrt(kAimed / area_);
  RasterScale scale;
  scale.cells_per_unit = {cells_per_unit_, cells_per_unit_};
  scale.growth = options_.grown * options_.side / std::sqrt(texels_);
  scale.coverage = Coverage::center;
  PieceOptions pieces;
  pieces.least_thickness = kThinnest;
  library_ = std::make_unique<PieceLibrary>(shapes_, scale, options_.angles,
                                            kLongest * options_.side, pieces);
  double sum = 0;
  for (const ChartShape& shape : shapes_) {
    // Of the root of the root of the area: large charts matter more than tiny ones.
    sum += std::sqrt(std::sqrt(shape.area / area_)) + kLeastChance;
    chances_.push_back(sum);
  }
  first_area_ = std::min(square(options_.side) * kAimed / options_.start,
                         square(double(kLongest) * options_.side));
  begin_anew();
}

/// All charts anywhere, on a large domain.
void CoarseSearch::begin_anew() {
  const bool moved = found() && options_.any_shape;
  domain_ = of_area(first_area_, moved ? aspect_of(best_.domain) : aspect_);
  filled_.places.clear();
  failures_ = 0;
  stride_ = kFirstStride;
  near_.clear();
  from_.domain = domain_;
  from_.places.clear();
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    from_.places.push_back({random_.below(options_.angles), random_.below(domain_.width),
                            random_.below(domain_.height)});
  }
}

void CoarseSearch::begin_with(const Layout& layout) {
  const double side = cells_per_unit_ / layout.scale;
  constexpr double kRoom = 1.01;  // as the grids differ
  const double largest = 2 * square(kLongest * options_.side);
  forget();
  domain_ = of_area(std::min(square(kRoom * side) * texels_, largest), aspect_);
  from_ = {domain_, to_places(layout, *library_, domain_)};
}

/// The domain of the shape nearest to it that has no more cells.
Domain CoarseSearch::of_area(double area, double aspect) const {
  const int width = std::max(1, static_cast<int>(std::lround(std::sqrt(area * aspect))));
  return {width, std::max(1, static_cast<int>(area / width)), wraps_x_, wraps_y_};
}

/// From now on domains grow wider or narrower by another factor. The first descent keeps its shape.
void CoarseSearch::turn() {
  drift_ = kAspectSpread * (random_.unit() + random_.unit() + random_.unit() - 1.5);
}

/// Smaller by so many rows or columns, about.
Domain CoarseSearch::smaller(const Domain& than, int steps) {
  const double area = (1 - (steps - 0.5) / options_.side) * cells(than);
  if (!options_.any_shape) return of_area(area, aspect_);
  const double aspect = aspect_of(than) * std::exp2(drift_);
  return of_area(area, std::clamp(aspect, 1 / kMostAspect, kMostAspect));
}

double CoarseSearch::efficiency() const {
  if (!found()) return 0;
  return square(cells_per_unit_) * area_ / cells(best_.domain);
}

CoarseFind CoarseSearch::find_of(const Attempt& attempt) {
  CoarseFind find;
  find.aspect = aspect_of(attempt.domain);
  find.layout.spots = to_spots(attempt.places, *library_, attempt.domain);
  find.layout.scale = cells_per_unit_ / std::sqrt(cells(attempt.domain));
  return find;
}

CoarseFind CoarseSearch::best() { return find_of(best_); }

std::vector<CoarseFind> CoarseSearch::near(std::size_t count) {
  std::vector<CoarseFind> finds;
  for (const Near& near : near_) {
    if (finds.size() == count || near.overlap > kMostNear) break;
    if (cells(near.attempt.domain) >= cells(best_.domain)) continue;
    finds.push_back(find_of(near.attempt));
  }
  return finds;
}

bool CoarseSearch::enlarge(std::span<const std::size_t> charts) {
  Layout layout;
  const Attempt& last = found() ? best_ : from_;
  layout.spots = to_spots(last.places, *library_, last.domain);
  const Domain domain = last.domain;
  bool any = false;
  for (const std::size_t chart : charts) {
    if (enlarged_[chart] == kMostEnlarged) continue;
    ++enlarged_[chart];
    library_->set_growth(chart, library_->growth(chart) + kEnlarged);
    any = true;
  }
  if (!any) return false;
  forget();
  domain_ = domain;
  from_ = {domain, to_places(layout, *library_, domain)};
  return true;
}

void CoarseSearch::forget() {
  best_.places.clear();
  filled_.places.clear();
  near_.clear();
  failures_ = 0;
  stride_ = 1;
  gave_up_ = false;
}

void CoarseSearch::adopt(const CoarseSearch& other) {
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (enlarged_[i] == other.enlarged_[i]) continue;
    enlarged_[i] = other.enlarged_[i];
    library_->set_growth(i, other.library_->growth(i));
  }
  best_ = filled_ = from_ = other.best_;
  gave_up_ = false;
  stride_ = 1;
  turn();
  domain_ = smaller(best_.domain, 1);
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
  near_.insert(at, {overlap, {domain_, places}});
}

/// After a domain was not filled: mostly to one of the layouts that came close to filling it,
/// sometimes to the last domain that was filled.
void CoarseSearch::retreat() {
  const double u = random_.unit();
  const auto chosen = static_cast<std::size_t>(u * u * static_cast<double>(near_.size() + 1));
  from_ = chosen < near_.size() ? near_[chosen].attempt : filled_;
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
  while (!gave_up_ && cells(domain_) > 1 && !effort.spent()) {
    effort.count_move();  // of one chart no move may ever be needed
    std::vector<Place> places = scaled(from_.places, *library_, from_.domain, domain_);
    bool filled = false;
    if (fit_angles(domain_, places)) {
      Separator separator(*library_, domain_, random_);
      filled = separator.run(places, options, effort);
      if (!filled) keep_near(separator.least(), places);
    }
    if (filled) {
      filled_ = from_ = {domain_, places};
      failures_ = 0;
      near_.clear();
      if (!found() || cells(domain_) < cells(best_.domain)) best_ = filled_;
      domain_ = smaller(domain_, stride_);
      continue;
    }
    if (effort.spent()) break;
    if (filled_.places.empty()) {  // a hard set: more room
      constexpr double kMore = 1.1;
      const double area = kMore * cells(domain_);
      from_ = {domain_, places};
      near_.clear();
      first_area_ = std::max(first_area_, area);
      gave_up_ = area > square(kLongest * options_.side);
      domain_ = of_area(area, options_.any_shape ? aspect_of(domain_) : aspect_);
      continue;
    }
    if (++failures_ > options_.patience) {
      begin_anew();
      continue;
    }
    if (stride_ > 1 || failures_ % kTriesOfShape == 0) {
      turn();
      domain_ = smaller(filled_.domain, 1);
    }
    stride_ = 1;
    retreat();
    disturb(from_.places, from_.domain);
    if (until_stuck) break;
  }
}

}  // namespace wrapatlas
