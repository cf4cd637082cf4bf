// pack_each_shape(): what pack() chooses from.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {
namespace {

PackOptions options_of(Method method, Aspect aspect) {
  PackOptions options;
  options.method = method;
  options.wrap = method == Method::modulo ? Wrap::uv : Wrap::none;
  options.width = options.height = 128;
  options.grid = 64;
  options.rotations = 4;
  options.aspect = aspect;
  options.threads = 1;
  return options;
}

TEST(PackEachShape, PackGivesTheDensestOfThem) {
  const std::vector<Chart> charts = test::mixed_charts(4, 9);
  for (const Method method : {Method::lprm02, Method::swg03, Method::zsgs04, Method::modulo}) {
    const PackOptions options = options_of(method, Aspect::search);
    const auto all = pack_each_shape(charts, options);
    const auto best = pack(charts, options);
    ASSERT_TRUE(all && best);
    ASSERT_EQ(all->size(), 31U);
    EXPECT_EQ(all->front().width, all->front().height) << "the most square comes first";
    double densest = 0;
    int packings = 0;
    for (const Packing& packing : *all) {
      densest = std::max(densest, packing.efficiency);
      packings += packing.packings;
      EXPECT_GE(packing.raster_seconds, 0);
      EXPECT_GE(packing.place_seconds, 0);
    }
    EXPECT_EQ(best->efficiency, densest);
    EXPECT_EQ(best->packings, packings);
    // One shape on its own comes to the same: only rasters are shared.
    PackOptions one = options_of(method, Aspect::fixed);
    one.width = (*all)[5].width;
    one.height = (*all)[5].height;
    one.grid = std::max((*all)[5].grid_width, (*all)[5].grid_height);
    const auto alone = pack(charts, one);
    ASSERT_TRUE(alone);
    EXPECT_NEAR(alone->efficiency, (*all)[5].efficiency, 0.05);
  }
}

TEST(PackEachShape, SaysWhereNothingFits) {
  // More padding than the narrowest shapes have room for.
  const std::vector<Chart> charts(4, test::rectangle(1, 1));
  PackOptions options = options_of(Method::swg03, Aspect::search);
  options.padding = 60;
  options.margin = 21;
  const auto all = pack_each_shape(charts, options);
  ASSERT_TRUE(all);
  for (const Packing& packing : *all) {
    EXPECT_EQ(packing.placements.empty(), packing.scale == 0);
    EXPECT_EQ(packing.placements.empty(), packing.efficiency == 0);
  }
  EXPECT_TRUE(std::any_of(all->begin(), all->end(),
                          [](const Packing& packing) { return packing.placements.empty(); }));
}

TEST(PackEachShape, Refuses) {
  const std::vector<Chart> charts{test::rectangle(1, 1)};
  PackOptions options = options_of(Method::guided, Aspect::search);
  EXPECT_EQ(pack_each_shape(charts, options).error().kind, ErrorKind::usage);
  options.method = Method::swg03;
  options.wrap = Wrap::uv;
  EXPECT_EQ(pack_each_shape(charts, options).error().kind, ErrorKind::usage);
  EXPECT_EQ(pack_each_shape({}, options_of(Method::swg03, Aspect::search)).error().kind,
            ErrorKind::usage);
}

}  // namespace
}  // namespace wrapatlas
