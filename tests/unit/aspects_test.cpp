// The shapes of atlas that are searched.
#include "pack/aspects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wrapatlas {
namespace {

PackOptions searched(Wrap wrap, int block) {
  PackOptions options;
  options.width = options.height = 1024;
  options.aspect = Aspect::search;
  options.wrap = wrap;
  options.padding = 2;
  options.block = block;
  return options;
}

TEST(Aspects, OfAShapeAndItsMirrorImageOneIsKept) {
  const PackOptions options = searched(Wrap::uv, 1);
  const auto frames = make_frames(options, 1);
  ASSERT_TRUE(frames);
  ASSERT_EQ(frames->size(), 31U);
  for (const Wrap wrap : {Wrap::uv, Wrap::none}) {
    EXPECT_EQ(without_mirrored(*frames, wrap, {}).size(), 16U);
  }
  for (const Wrap wrap : {Wrap::u, Wrap::v}) {
    EXPECT_EQ(without_mirrored(*frames, wrap, {}).size(), 31U);
  }
}

TEST(Aspects, ShapesWithoutRoomAreLeftOut) {
  for (const Aspect aspect : {Aspect::search, Aspect::pow2}) {
    PackOptions options = searched(Wrap::none, 1);
    options.aspect = aspect;
    options.width = options.height = 64;
    const auto all = make_frames(options, 1);
    options.margin = 14;
    const auto wide = make_frames(options, 1);
    ASSERT_TRUE(all && wide) << wide.error().message();
    EXPECT_LT(wide->size(), all->size());
    for (const Frame& frame : *wide) EXPECT_GT(std::min(frame.width, frame.height), 0);
    options.margin = 40;
    EXPECT_FALSE(make_frames(options, 1));
  }
}

TEST(Aspects, TheOneThatAPackingIsOnIsKept) {
  const auto frames = make_frames(searched(Wrap::uv, 1), 1);
  ASSERT_TRUE(frames);
  for (const Frame& frame : *frames) {
    Packing begun;
    begun.width = frame.texture_width;
    begun.height = frame.texture_height;
    const auto kept = without_mirrored(*frames, Wrap::uv, begun);
    EXPECT_EQ(kept.size(), 16U);
    const auto same = [&](const Frame& other) {
      return other.texture_width == begun.width && other.texture_height == begun.height;
    };
    EXPECT_EQ(std::count_if(kept.begin(), kept.end(), same), 1);
  }
}

TEST(Aspects, AFrameOfAnyAspectKeepsAreaAndBlocks) {
  for (const int block : {1, 4, 16}) {
    for (double aspect = 1.0 / 8; aspect <= 8; aspect *= 1.07) {
      const auto frame = frame_of_aspect(searched(Wrap::uv, block), 1, aspect);
      ASSERT_TRUE(frame) << frame.error().message();
      EXPECT_EQ(frame->texture_width % block, 0);
      EXPECT_EQ(frame->texture_height % block, 0);
      const double nearest = std::log(double(frame->texture_width) / frame->texture_height);
      const double shorter = std::min(frame->texture_width, frame->texture_height);
      EXPECT_NEAR(nearest, std::log(aspect), 1.1 * block / shorter);
      EXPECT_NEAR(frame->texels(), 1024.0 * 1024, 0.6 * block * (1024 * 1024 / shorter + shorter));
      EXPECT_NEAR(frame->cell.x * frame->width, frame->texture_width, 1e-9);
    }
  }
}

TEST(Aspects, ThePapersShapesAreFramesOfTheirAspects) {
  const PackOptions options = searched(Wrap::none, 1);
  const auto frames = make_frames(options, 1);
  ASSERT_TRUE(frames);
  for (int i = 0; i < 31; ++i) {
    const int k = i % 2 == 1 ? (i + 1) / 2 : -i / 2;
    const auto same = frame_of_aspect(options, 1, std::exp2(k / 5.0));
    ASSERT_TRUE(same);
    EXPECT_EQ(same->texture_width, (*frames)[static_cast<std::size_t>(i)].texture_width);
    EXPECT_EQ(same->texture_height, (*frames)[static_cast<std::size_t>(i)].texture_height);
  }
}

}  // namespace
}  // namespace wrapatlas
