#include "guided/lines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "pack/aspects.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

/// Cells of the coarse grid: enough for each chart to have a shape.
int coarse_side(std::size_t charts) {
  constexpr double kCellsPerChart = 200;
  return std::clamp(static_cast<int>(std::sqrt(kCellsPerChart * static_cast<double>(charts))), 144,
                    512);
}

constexpr int kSharings = 8;          ///< times the best layout is handed to the other lines
constexpr double kEpochSeconds = 4;   ///< at most, until what was found is refined, about
constexpr double kShapesShare = 0.5;  ///< of the time, to choose among shapes of atlas
/// A line that begins anywhere may at once be so much denser than the packing that is known.
constexpr double kHoped = 1.3;
/// Left for the last refinement: this share of the time, but no more than so many seconds.
constexpr double kRefineShare = 0.1, kRefineSeconds = 0.5;

}  // namespace

Lines::Lines(std::span<const ChartShape> shapes, const PackOptions& options,
             std::span<const Frame> frames, Record& record)
    : shapes_(shapes), options_(options), record_(record), moves_left_(options.moves) {
  begun_ = frames.size() > 1 ? frames.size() : lines_wanted();
  for (std::size_t i = 0; i < begun_; ++i) {
    const Frame& frame = frames[i % frames.size()];
    CoarseOptions coarse;
    coarse.side = coarse_side(shapes.size());
    coarse.any_shape = any_shape();
    if (record.best()) coarse.start = std::min(coarse.start, kHoped * record.best()->efficiency);
    coarse.grown = options.padding / 2 + 0.3 * frame.cell.x;
    const std::uint64_t seed = options.seed * 1000003 + i;
    lines_.push_back(
        std::make_unique<Line>(Line{&frame, i,
                                    CoarseSearch(shapes, frame.lengths(), wraps_u(options.wrap),
                                                 wraps_v(options.wrap), coarse, seed),
                                    Random(seed ^ 0xf1e2d3c4)}));
  }
}

void Lines::begin_with(const Packing& packing, bool all) {
  for (const auto& line : lines_) {
    if (line->frame->texture_width != packing.width ||
        line->frame->texture_height != packing.height) {
      continue;
    }
    line->coarse.begin_with(to_layout(packing, shapes_, *line->frame));
    line->refined = 0;
    if (!all) return;
  }
}

/// Not as many as threads where the result must not depend on them.
std::size_t Lines::lines_wanted() const {
  return record_.timed() ? static_cast<std::size_t>(thread_count(options_.threads)) : 2;
}

template <typename Job>
void Lines::each_line(Job job) {
  parallel_for(lines_.size(), thread_count(options_.threads),
               [&](std::size_t i) { job(*lines_[i]); });
}

/// The grid for a layout of the line.
Frame Lines::frame_of(const Line& line, double aspect) const {
  if (!any_shape()) return *line.frame;
  const auto frame = frame_of_aspect(options_, line.frame->cell.x, aspect);
  return frame ? *frame : *line.frame;
}

/// Refines a layout and offers what comes of it.
Refined Lines::refine_find(Line& line, const CoarseFind& find, RefineOptions how,
                           double least_efficiency, Effort& effort) {
  const Frame frame = frame_of(line, find.aspect);
  how.least_scale = std::sqrt(least_efficiency * frame.texels() / total_area(shapes_));
  Refined fine =
      refine(shapes_, frame, options_, find.on(frame.lengths()), how, effort, line.random);
  if (fine.packing) {
    record_.offer(Packing(*fine.packing), 1 + line.offers++ * begun_ + line.number);
  }
  return fine;
}

void Lines::improve(Line& line, double least_efficiency, Effort& effort) {
  if (!line.coarse.found() || line.coarse.efficiency() <= line.refined) return;
  const CoarseFind find = line.coarse.best();
  RefineOptions how;
  how.gives_up = true;
  Refined fine = refine_find(line, find, how, least_efficiency, effort);
  if (!fine.held.empty()) {
    if (line.coarse.enlarge(fine.held)) {
      line.enlarged = true;
      line.refined = 0;
      return;
    }
    how.gives_up = false;
    fine = refine_find(line, find, how, least_efficiency, effort);
  }
  if (fine.packing || !effort.spent()) line.refined = line.coarse.efficiency();
}

/// What the line came near to may hold on the final grid, and then it is denser. In the time that
/// was kept for the last refinement.
void Lines::improve_near(Line& line, double least_efficiency, Effort& effort) {
  constexpr std::size_t kMost = 4;
  if (!line.coarse.found()) return;
  RefineOptions how;
  how.gives_up = true;
  how.step_down = how.step_up / 2;  // a domain smaller than the best: little may be lost
  for (const CoarseFind& find : line.coarse.near(kMost)) {
    if (effort.spent()) return;
    refine_find(line, find, how, least_efficiency, effort);
  }
}

/// Lets every line search in the given part of the whole time, an equal part each; or, of the moves
/// that are left, as many as that is of the part that is left.
void Lines::spend(double from, double to, bool until_stuck, bool enlarged_alone) {
  const double turns =
      std::ceil(static_cast<double>(lines_.size()) / std::max(1, thread_count(options_.threads)));
  const double share = (to - from) / (end() - from) / static_cast<double>(lines_.size());
  const auto moves = static_cast<std::int64_t>(share * static_cast<double>(moves_left_)) + 1;
  std::vector<std::int64_t> made(lines_.size());
  parallel_for(lines_.size(), thread_count(options_.threads), [&](std::size_t i) {
    if (enlarged_alone && !lines_[i]->enlarged) return;
    const double turn = std::floor(static_cast<double>(i) / thread_count(options_.threads));
    Effort effort = record_.effort(from + (to - from) * (turn + 1) / turns);
    if (options_.moves > 0) effort.moves(moves);
    lines_[i]->coarse.run(effort, until_stuck);
    if (lines_[i]->coarse.found() || !effort.spent()) lines_[i]->enlarged = false;
    made[i] = effort.moves_made();
  });
  moves_left_ = std::accumulate(made.begin(), made.end(), moves_left_, std::minus<>());
}

void Lines::keep_best(std::size_t count) {
  std::stable_sort(lines_.begin(), lines_.end(), [](const auto& a, const auto& b) {
    return a->coarse.efficiency() > b->coarse.efficiency();
  });
  if (lines_.size() > count) lines_.resize(count);
}

void Lines::share_best() {
  const auto& best = *std::max_element(
      lines_.begin(), lines_.end(),
      [](const auto& a, const auto& b) { return a->coarse.efficiency() < b->coarse.efficiency(); });
  for (const auto& line : lines_) {
    const bool alike = any_shape() || line->frame == best->frame;
    if (line->enlarged) continue;  // else it would be drawn as the others are
    if (alike && line->coarse.efficiency() < best->coarse.efficiency()) {
      line->coarse.adopt(best->coarse);
      line->refined = best->refined;
    }
  }
}

/// Of the time; the last refinement has the rest. It takes no part of the moves.
double Lines::end() const {
  return record_.timed() ? 1 - std::min(kRefineShare, kRefineSeconds / options_.time) : 1;
}

bool Lines::improve_all(double share) {
  // What comes a little short of the best may grow a little yet.
  constexpr double kGrowth = 0.95;
  const double least = kGrowth * record_.efficiency();
  each_line([&](Line& line) {
    Effort effort = record_.effort(share);
    improve(line, least, effort);
  });
  return std::any_of(lines_.begin(), lines_.end(), [](const auto& line) { return line->enlarged; });
}

void Lines::run() {
  run_until_stuck();
  go_on();
}

void Lines::run_until_stuck(double share) {
  const std::size_t wanted = lines_wanted();
  if (lines_.size() > wanted) {
    // Halving: all shapes get a little time, the better half of them as much again, and so on.
    int rounds = 1;
    while (lines_.size() >> rounds > wanted) ++rounds;
    for (int round = 0; round < rounds && !record_.stopped(); ++round) {
      const double part = kShapesShare / rounds;
      spend(spent_, spent_ + part, round == 0);
      spent_ += part;
      keep_best(once() ? wanted : std::max(wanted, lines_.size() / 2));
      if (once()) break;
    }
  } else {
    spend(0, share * end(), true);
  }
  const bool again = once() || (record_.timed() && lines_.size() == begun_);
  while (improve_all(std::min(1.0, share + kRefineShare)) && again &&
         !record_.effort(share).spent()) {
    spend(0, share * end(), true, true);
  }
}

void Lines::go_on() {
  if (once()) return;
  // Stopped in a long search one wants what it has found.
  const double seconds = record_.timed() ? options_.time : 0;
  const int apart = std::max(1, static_cast<int>(std::ceil(seconds / kSharings / kEpochSeconds)));
  const int epochs = kSharings * apart;
  for (int epoch = 0; epoch < epochs && !record_.stopped(); ++epoch) {
    if (epoch % apart == 0) share_best();
    const double from = spent_ + (end() - spent_) * epoch / epochs;
    const double to = spent_ + (end() - spent_) * (epoch + 1) / epochs;
    spend(from, to, false);
    improve_all(1);
  }
  const double least = record_.efficiency();  // whichever line is first
  each_line([&](Line& line) {
    Effort effort = record_.effort(1);
    improve_near(line, least, effort);
  });
}

}  // namespace wrapatlas
