#include "pack/board.h"

#include <gtest/gtest.h>

#include <map>

#include "pack/slide.h"
#include "support/shapes.h"

namespace wrapatlas {
namespace {

ChartRaster random_raster(std::mt19937_64& random, double largest) {
  const double size = test::uniform(random, 1, largest);
  const Chart chart = random() % 2 == 0 ? test::star(random, 9, 0.2, 1)
                                        : test::arc(1, test::uniform(random, 0.05, 0.5), 4.5, 20);
  return rasterize(make_raster_shape(chart), {{size, size}, 0.2, Coverage::conservative},
                   test::uniform(random, 0, 6.3));
}

/// How often each cell of the board is covered, counted one by one; -1 where it leaves the board.
class SlowBoard {
 public:
  SlowBoard(int width, int height, Wrap wrap) : width_(width), height_(height), wrap_(wrap) {}

  /// Calls visit(cell index) for each covered cell; false if the chart leaves the board.
  template <typename Visit>
  bool visit(const CellViews& chart, int x, int y, Visit visit_cell) const {
    for (int j = 0; j < chart.rows.lanes; ++j) {
      for (int i = 0; i < chart.rows.length; ++i) {
        if (!chart.rows.test(j, i)) continue;
        int u = x + i, v = y + j;
        if (wraps_u(wrap_)) u %= width_;
        if (wraps_v(wrap_)) v %= height_;
        if (u >= width_ || v >= height_) return false;
        visit_cell(v * width_ + u);
      }
    }
    return true;
  }

 private:
  int width_, height_;
  Wrap wrap_;
};

class BoardOracle : public ::testing::TestWithParam<Wrap> {};

TEST_P(BoardOracle, AdmitsCollidesAdds) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 60; ++round) {
    const int width = 10 + static_cast<int>(random() % 120),
              height = 10 + static_cast<int>(random() % 120);
    Board board(width, height, GetParam());
    const SlowBoard slow(width, height, GetParam());
    std::vector<int> occupied(static_cast<std::size_t>(width * height));
    for (int i = 0; i < 12; ++i) {
      ChartRaster chart = random_raster(random, round % 3 == 0 ? 70 : 12);
      for (int turn = 0; turn < i % 4; ++turn) chart = quarter_turned(chart);
      const CellViews views = cells_of(chart);
      std::map<int, int> cells;
      const bool on_axes = (wraps_u(GetParam()) || chart.width <= width) &&
                           (wraps_v(GetParam()) || chart.height <= height);
      bool fold_free = true;
      if (on_axes) {
        slow.visit(views, 0, 0, [&](int cell) { fold_free &= ++cells[cell] == 1; });
      }
      ASSERT_EQ(board.admits(chart), on_axes && fold_free);
      if (!on_axes || !fold_free) continue;
      for (int attempt = 0; attempt < 30; ++attempt) {
        const int x = static_cast<int>(random() % static_cast<unsigned>(width));
        const int y = static_cast<int>(random() % static_cast<unsigned>(height));
        bool free = true;
        free &= slow.visit(
            views, x, y, [&](int cell) { free &= occupied[static_cast<std::size_t>(cell)] == 0; });
        const bool leaves = (!wraps_u(GetParam()) && x + chart.width > width) ||
                            (!wraps_v(GetParam()) && y + chart.height > height);
        ASSERT_EQ(board.collides(views, x, y), leaves || !free);
        if (leaves || !free) continue;
        board.add(views, x, y);
        slow.visit(views, x, y, [&](int cell) { ++occupied[static_cast<std::size_t>(cell)]; });
        break;
      }
      for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u) {
          const bool expected = occupied[static_cast<std::size_t>(v * width + u)] != 0;
          ASSERT_EQ(board.rows().test(v, u), expected);
          ASSERT_EQ(board.columns().test(u, v), expected);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Wraps, BoardOracle,
                         ::testing::Values(Wrap::none, Wrap::u, Wrap::v, Wrap::uv));

TEST(Slide, EveryVersionAgreesWithTheDefinition) {
  std::mt19937_64 random(12);
  for (int round = 0; round < 50; ++round) {
    const ChartRaster chart = random_raster(random, 60);
    Channel channel;
    const int lanes = 20 + static_cast<int>(random() % 200);
    channel.resize(lanes, chart.width);
    for (int i = 0; i < lanes; ++i) {
      const auto low = static_cast<std::int16_t>(random() % 300);
      channel.low[static_cast<std::size_t>(i)] = low;
      channel.high[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(low + random() % 200);
    }
    channel.extend();
    for (const SlideKernels& kernels : {scalar_kernels(), avx2_kernels(), avx512_kernels()}) {
      if (kernels.slide == nullptr) continue;
      std::vector<std::int16_t> lowest(static_cast<std::size_t>(lanes) + 64),
          highest(lowest.size());
      kernels.slide(channel.low.data(), channel.high.data(), chart.columns, lanes, lowest.data(),
                    highest.data());
      for (int s = 0; s < lanes; ++s) {
        int low = -100000, high = 100000;
        for (int c = 0; c < chart.width; ++c) {
          const auto lane = static_cast<std::size_t>((s + c) % lanes);
          const auto i = static_cast<std::size_t>(c);
          low = std::max(low, channel.low[lane] - chart.columns.first()[i]);
          high = std::min(high, channel.high[lane] - 1 - chart.columns.last()[i]);
        }
        ASSERT_EQ(lowest[static_cast<std::size_t>(s)], low);
        ASSERT_EQ(highest[static_cast<std::size_t>(s)], high);
      }
    }
  }
}

TEST(Slide, BestRestIsTheFirstOfLeastGap) {
  std::mt19937_64 random(13);
  for (int round = 0; round < 80; ++round) {
    ChartRaster chart = random_raster(random, 40);
    if (round % 4 == 0) {  // an empty lane, as a stack of separate charts can have
      Silhouette& columns = chart.columns;
      const int lane = columns.lanes / 2;
      if (columns.lanes < 3) continue;
      columns.sum_first -= columns.first()[lane];
      columns.sum_last -= columns.last()[lane];
      --columns.filled_lanes;
      columns.split_runs = {{0, lane}, {lane + 1, chart.width}};
      columns.first()[lane] = 1;
      columns.last()[lane] = 0;
    }
    Channel channel;
    const int lanes = chart.width + 150;
    channel.resize(lanes, chart.width);
    for (int i = 0; i < lanes; ++i) {
      const auto low = static_cast<std::int16_t>(random() % 10);
      channel.low[static_cast<std::size_t>(i)] = low;
      channel.high[static_cast<std::size_t>(i)] =
          static_cast<std::int16_t>(low + chart.height + random() % 20);
    }
    channel.extend();
    SlideResult range;
    slide(channel, chart.columns, lanes, range);
    const int begin = round % 3 == 0 ? 0 : 7, end = lanes - static_cast<int>(random() % 60);
    for (const Side side : {Side::low, Side::high}) {
      Rest expected;
      for (int s = begin; s < end; ++s) {
        const auto k = static_cast<std::size_t>(s);
        if (range.lowest[k] > range.highest[k]) continue;
        const int position = side == Side::low ? range.lowest[k] : range.highest[k];
        std::int32_t gap = 0;
        for (int c = 0; c < chart.width; ++c) {
          const auto lane = static_cast<std::size_t>((s + c) % lanes);
          const auto i = static_cast<std::size_t>(c);
          if (chart.columns.first()[i] > chart.columns.last()[i]) continue;
          gap += side == Side::low ? position + chart.columns.first()[i] - channel.low[lane]
                                   : channel.high[lane] - 1 - (position + chart.columns.last()[i]);
        }
        if (gap < expected.gap) expected = {gap, s, position};
      }
      for (const SlideKernels& kernels : {scalar_kernels(), avx2_kernels(), avx512_kernels()}) {
        if (kernels.best_rest == nullptr) continue;
        const Rest rest = kernels.best_rest(channel, chart.columns, range, begin, end, side);
        ASSERT_EQ(rest.shift, expected.shift);
        if (expected.shift < 0) continue;
        ASSERT_EQ(rest.gap, expected.gap);
        ASSERT_EQ(rest.position, expected.position);
      }
    }
  }
}

}  // namespace
}  // namespace wrapatlas
