#include "guided/best_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "guided/wrapped.h"

namespace wrapatlas {
namespace {

/// Boards with fewer rows are looked at as a whole.
constexpr int kFewRows = 320;
constexpr std::size_t kLooks = 48;      ///< translations per angle whose contact is counted
constexpr std::size_t kFineLooks = 12;  ///< the same on the frame's grid
constexpr std::size_t kSettled = 4;     ///< candidates tried on the frame's grid

int halved(int cells, int times) { return (cells + (1 << times) - 1) >> times; }

/// Takes the cells of the board that cells [begin, end) of row y of the frame's grid lie in.
void take_halved(Occupancy& board, int halvings, const Domain& fine, int y, int begin, int end) {
  y %= fine.height;
  for_each_part(begin, end, fine.width, [&](int from, int to) {
    board.take(y >> halvings, from >> halvings, ((to - 1) >> halvings) + 1);
  });
}

}  // namespace

BestFitCare care_for(std::size_t charts, bool hurried) {
  constexpr std::size_t kFew = 500;
  return charts <= kFew && !hurried ? BestFitCare{24, 256, true} : BestFitCare{16, 8, false};
}

BestFitPage::BestFitPage(const Frame& frame, Wrap wrap, Coverage coverage, double scale,
                         const BestFitCare& care)
    : frame_(frame),
      coverage_(coverage),
      scale_(scale),
      care_(care),
      fine_(domain_of(frame, wrap)) {}

RasterScale BestFitPage::raster_scale(std::size_t halvings) const {
  const double cells = std::exp2(-static_cast<double>(halvings));
  RasterScale scale = raster_scale_on(frame_, scale_, coverage_);
  scale.cells_per_unit = cells * scale.cells_per_unit;
  scale.growth *= cells;
  return scale;
}

/// Chooses the board for charts of this size, and makes it if it is not there yet.
void BestFitPage::use_board(std::size_t halvings, double extent) {
  halvings_ = halvings;
  if (boards_.size() <= halvings) boards_.resize(halvings + 1);
  Board& board = boards_[halvings];
  const int times = static_cast<int>(halvings);
  if (times > 0 && !board.cells) {
    const Domain fine = fine_.domain();
    board.cells = std::make_unique<Occupancy>(
        Domain{halved(fine.width, times), halved(fine.height, times), fine.wraps_x, fine.wraps_y});
    for (int y = 0; y < fine.height; ++y) {
      for_each_run(fine_.row(0, y), fine.width, [&](int begin, int end) {
        take_halved(*board.cells, times, fine, y, begin, end);
      });
    }
    board.cells->update();
  }
  // Smaller charts find room above, where larger ones did not.
  constexpr double kSmaller = 0.6;
  if (board.row_extent == 0 || extent < kSmaller * board.row_extent) {
    board.row_extent = extent;
    board.first_row = 0;
  }
}

/// Fills candidates_ with places on the board, the best first.
void BestFitPage::seek(const RasterShape& shape, std::span<const double> angles, bool everywhere) {
  candidates_.clear();
  const Occupancy& board = this->board();
  const Domain& domain = board.domain();
  const RasterScale scale = raster_scale(halvings_);
  const double fine = std::exp2(static_cast<double>(halvings_));
  const int max_side = kLongestInDomains * std::max(domain.width, domain.height);
  int first_free = domain.height;
  // Of the smallest charts there are very many, and angles say little of them.
  const std::size_t step = !care_.all_angles && halvings_ == 0 && domain.height > kFewRows ? 2 : 1;
  for (std::size_t i = 0; i < angles.size(); i += step) {
    const double angle = angles[i];
    const ChartRaster raster = rasterize_cells(shape, scale, angle, max_side);
    if (raster.width == 0) continue;
    const Piece piece = make_bare_piece(raster);
    if (!admits(domain, piece)) continue;
    FreeRange range;
    range.x_end = domain.width;
    range.y_begin = everywhere ? 0 : boards_[halvings_].first_row;
    const int rows = domain.wraps_y ? domain.height : domain.height - piece.height + 1;
    range.y_count = rows - range.y_begin;
    if (range.y_count <= 0) continue;
    range.whole = true;
    const Probes probes = probes_of(piece, *raster.unturned, board);
    free_.scan(board, probes, range, rows > kFewRows ? care_.enough : 0);
    if (free_.first_row() < 0) continue;
    first_free = std::min(first_free, range.y_begin + free_.first_row());
    free_.tightest(kLooks, shifts_);
    const Ring ring = ring_of(*raster.unturned);
    Candidate best;
    best.contact = -1;
    CellShift best_shift;
    for (const CellShift& shift : shifts_) {
      const double touching = contact(board, ring, shift.x, shift.y);
      if (touching <= best.contact) continue;
      best.contact = touching;
      best_shift = shift;
    }
    best.angle = angle;
    best.at = {(best_shift.x + piece.centre.x) * fine, (best_shift.y + piece.centre.y) * fine};
    candidates_.push_back(best);
  }
  if (domain.height > kFewRows && !everywhere) {
    boards_[halvings_].first_row = std::min(first_free, domain.height - 1);
  }
  std::stable_sort(candidates_.begin(), candidates_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.contact > b.contact; });
}

/// Moves a chart from a place on the board into contact on the frame's grid.
std::optional<BestFitPage::Spot> BestFitPage::settle(const RasterShape& shape,
                                                     const Candidate& candidate) {
  const Domain& domain = fine_.domain();
  const RasterScale scale = raster_scale(0);
  const ChartRaster raster = rasterize_cells(
      shape, scale, candidate.angle, kLongestInDomains * std::max(domain.width, domain.height));
  if (raster.width == 0) return {};
  const Piece piece = make_bare_piece(raster);
  if (!admits(domain, piece)) return {};
  const int x = static_cast<int>(std::lround(candidate.at.x - piece.centre.x));
  const int y = static_cast<int>(std::lround(candidate.at.y - piece.centre.y));
  const int window = halvings_ == 0 ? 0 : (1 << static_cast<int>(halvings_)) + 1;
  const Probes probes = probes_of(piece, *raster.unturned, fine_);
  const Ring ring = ring_of(*raster.unturned);
  CellShift best;
  double most = -1;
  const auto look = [&](int x_begin, int x_end) {
    FreeRange range;
    range.x_begin = x_begin;
    range.x_end = x_end;
    range.y_begin = y - window;
    range.y_count = 2 * window + 1;
    if (domain.wraps_y) {
      range.y_begin = modulo(range.y_begin, domain.height);
      range.y_count = std::min(range.y_count, domain.height);
    } else {
      const int end = std::min(range.y_begin + range.y_count, domain.height - piece.height + 1);
      range.y_begin = std::max(range.y_begin, 0);
      range.y_count = end - range.y_begin;
      if (range.y_count <= 0) return;
    }
    free_.scan(fine_, probes, range, 0);
    free_.tightest(kFineLooks, shifts_);
    for (const CellShift& shift : shifts_) {
      const double touching = contact(fine_, ring, shift.x, shift.y);
      if (touching <= most) continue;
      most = touching;
      best = shift;
    }
  };
  if (!domain.wraps_x) {
    look(std::max(x - window, 0), std::min(x + window + 1, domain.width));
  } else if (2 * window + 1 >= domain.width) {
    look(0, domain.width);
  } else {
    const int begin = modulo(x - window, domain.width), end = begin + 2 * window + 1;
    look(begin, std::min(end, domain.width));
    if (end > domain.width) look(0, end - domain.width);
  }
  if (most < 0) return {};
  take(piece, best.x, best.y);
  return Spot{place_on(frame_, piece.angle, piece.offset, best.x, best.y), piece.cells};
}

void BestFitPage::take(const Piece& piece, int x, int y) {
  for (const PieceRun& run : piece.runs) fine_.take(y + run.row, x + run.begin, x + run.end);
  fine_.update();
  for (std::size_t times = 1; times < boards_.size(); ++times) {
    Occupancy* cells = boards_[times].cells.get();
    if (cells == nullptr) continue;
    for (const PieceRun& run : piece.runs) {
      take_halved(*cells, static_cast<int>(times), fine_.domain(), y + run.row, x + run.begin,
                  x + run.end);
    }
    cells->update();
  }
}

std::optional<BestFitPage::Spot> BestFitPage::place(const ChartShape& shape,
                                                    std::span<const double> angles) {
  const double along = std::sqrt(shape.area) * scale_ / std::sqrt(frame_.cell.x * frame_.cell.y) +
                       2 * frame_.growth + 1;
  const auto halvings =
      static_cast<std::size_t>(std::max(0.0, std::floor(std::log2(along / care_.cells_along))));
  use_board(halvings, shape.extent);
  for (const bool everywhere : {false, true}) {
    if (everywhere && boards_[halvings_].first_row == 0) break;
    seek(shape.raster, angles, everywhere);
    for (std::size_t i = 0; i < std::min(kSettled, candidates_.size()); ++i) {
      if (auto spot = settle(shape.raster, candidates_[i])) return spot;
    }
  }
  return {};
}

std::optional<BestFitPage::Spot> BestFitPage::place_alone(const RasterShape& shape,
                                                          std::span<const double> angles) {
  const Domain& domain = fine_.domain();
  const RasterScale scale = raster_scale(0);
  for (const double angle : angles) {
    const ChartRaster raster = rasterize_cells(
        shape, scale, angle, kLongestInDomains * std::max(domain.width, domain.height));
    if (raster.width == 0) continue;
    const Piece piece = make_bare_piece(raster);
    if (!admits(domain, piece)) continue;
    take(piece, 0, 0);
    return Spot{place_on(frame_, piece.angle, piece.offset, 0, 0), piece.cells};
  }
  return {};
}

std::vector<double> best_fit_angles(double base, int count) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(base + 2 * std::numbers::pi * i / count);
  return angles;
}

}  // namespace wrapatlas
