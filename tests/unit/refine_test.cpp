// From layouts to packings on the final grid: what refinement mends, and what it says it cannot.
#include "guided/refine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/shapes.h"

namespace wrapatlas {
namespace {

PackOptions options_of(int side) {
  PackOptions options;
  options.width = options.height = side;
  options.padding = 0;
  options.wrap = Wrap::none;
  return options;
}

Refined refine_for(const std::vector<Chart>& charts, const PackOptions& options,
                   const Layout& layout, const RefineOptions& how = {}) {
  const auto frame = make_frame(options.width, options.height, 1, options);
  Effort effort(nullptr);
  Random random(1);
  return refine(make_shapes(charts), *frame, options, layout, how, effort, random);
}

/// A square lies in a ring that it is a little too large for, whatever the scale.
TEST(Refine, NamesChartsThatHoldEachOther) {
  const PackOptions options = options_of(256);
  const Chart ring = test::arc(1, 0.2, 2 * std::numbers::pi - 0.01, 64);  // 0.9 is free inside
  const Layout inside{30, {{0, {0.4, 0.4}}, {0, {0.4, 0.4}}, {0, {0.85, 0.85}}}};
  for (const double half_diagonal : {0.8, 0.95}) {
    const double side = std::sqrt(2.0) * half_diagonal;
    const Chart square = test::rectangle(side, side);
    RefineOptions how;
    how.gives_up = true;
    const Refined refined = refine_for({ring, square, square}, options, inside, how);
    if (half_diagonal < 0.9) {
      ASSERT_TRUE(refined.packing);
      EXPECT_TRUE(refined.held.empty());
      EXPECT_GE(refined.packing->scale, 30);
    } else {
      EXPECT_FALSE(refined.packing);
      EXPECT_EQ(refined.held, (std::vector<std::size_t>{0, 1}));
      EXPECT_TRUE(refine_for({ring, square, square}, options, inside).held.empty());
    }
  }
}

/// Four squares fit up to a scale of 32, wherever the search for it begins.
TEST(Refine, EndsCloseBelowTheLargestScale) {
  const PackOptions options = options_of(64);
  const std::vector<Chart> charts(4, test::rectangle(1, 1));
  for (const double start : {24.0, 31.9, 32.2, 36.0}) {
    const Layout layout{
        start, {{0, {0.25, 0.25}}, {0, {0.75, 0.25}}, {0, {0.25, 0.75}}, {0, {0.75, 0.75}}}};
    const Refined refined = refine_for(charts, options, layout);
    ASSERT_TRUE(refined.packing);
    EXPECT_LE(refined.packing->scale, 32);
    EXPECT_GT(refined.packing->scale, 32 * (1 - 2 * RefineOptions().last_step)) << start;
  }
}

/// Squares of half as much again as the atlas has have to shrink, unless they may not.
TEST(Refine, ShrinksNoFurtherThanItIsToldTo) {
  const PackOptions options = options_of(64);
  const std::vector<Chart> charts(4, test::rectangle(1, 1));
  const Layout layout{40, {{0, {0.3, 0.3}}, {0, {0.7, 0.3}}, {0, {0.3, 0.7}}, {0, {0.7, 0.7}}}};
  const Refined free = refine_for(charts, options, layout);
  ASSERT_TRUE(free.packing);
  EXPECT_LT(free.packing->scale, 32.01);
  EXPECT_GT(free.packing->scale, 30);
  RefineOptions how;
  how.least_scale = 33;
  const Refined bound = refine_for(charts, options, layout, how);
  EXPECT_FALSE(bound.packing);
  EXPECT_TRUE(bound.held.empty());
}

}  // namespace
}  // namespace wrapatlas
