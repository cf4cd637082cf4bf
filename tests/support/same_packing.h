// Packings that have to agree to the bit.
#pragma once

#include <gtest/gtest.h>

#include "wrapatlas/pack.h"

namespace wrapatlas::test {

inline void expect_same(const Packing& a, const Packing& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.scale, b.scale);
  ASSERT_EQ(a.placements.size(), b.placements.size());
  for (std::size_t i = 0; i < a.placements.size(); ++i) {
    EXPECT_EQ(a.placements[i].angle, b.placements[i].angle) << i;
    EXPECT_EQ(a.placements[i].translation, b.placements[i].translation) << i;
    EXPECT_EQ(a.placements[i].page, b.placements[i].page) << i;
  }
}

}  // namespace wrapatlas::test
