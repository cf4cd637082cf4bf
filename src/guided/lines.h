// Several lines of separation side by side, on one shape of atlas or on many; what they find is
// refined on the grid of its frame.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "guided/coarse.h"
#include "guided/record.h"
#include "guided/refine.h"

namespace wrapatlas {

class Lines {
 public:
  /// One line for each of several frames; for one frame as many as can run at once. With
  /// Aspect::search a line begins on the shape of its frame, and goes on to any other.
  Lines(std::span<const ChartShape> shapes, const PackOptions& options,
        std::span<const Frame> frames, Record& record);

  /// Lets lines that do not begin anywhere begin with a packing: the first, or all.
  void begin_with(const Packing& packing, bool all);
  /// Searches until the record says that it is enough: the two below.
  void run();
  /// Until each line has failed once, and again where charts held each other; of one frame, or
  /// about this share of the time has passed. Of several frames: chooses the best ones.
  void run_until_stuck(double share = 1);
  void go_on();

 private:
  struct Line {
    const Frame* frame;  ///< that it begins on
    std::size_t number;
    CoarseSearch coarse;
    Random random;
    std::size_t offers = 0;  ///< refined layouts so far
    double refined = 0;      ///< efficiency of the coarse layout last refined
    bool enlarged = false;   ///< since it last found a layout, some of its charts were
  };
  template <typename Job>
  void each_line(Job job);
  void spend(double from, double to, bool until_stuck, bool enlarged_alone = false);
  [[nodiscard]] bool any_shape() const { return options_.aspect == Aspect::search; }
  [[nodiscard]] Frame frame_of(const Line& line, double aspect) const;
  Refined refine_find(Line& line, const CoarseFind& find, RefineOptions how,
                      double least_efficiency, Effort& effort);
  void improve(Line& line, double least_efficiency, Effort& effort);
  void improve_near(Line& line, double least_efficiency, Effort& effort);
  /// True: of some lines charts are drawn larger from now on, as they held each other.
  bool improve_all(double share);
  /// Neither a time nor moves: it ends when it is stuck.
  [[nodiscard]] bool once() const { return !record_.timed() && options_.moves == 0; }
  void keep_best(std::size_t count);
  void share_best();
  [[nodiscard]] std::size_t lines_wanted() const;
  [[nodiscard]] double end() const;

  std::span<const ChartShape> shapes_;
  const PackOptions& options_;
  Record& record_;
  std::int64_t moves_left_;
  double spent_ = 0;       ///< share of the time that go_on() does not have
  std::size_t begun_ = 0;  ///< lines at first
  std::vector<std::unique_ptr<Line>> lines_;
};

}  // namespace wrapatlas
