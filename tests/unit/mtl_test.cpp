#include "io/mtl.h"

#include <gtest/gtest.h>

namespace wrapatlas {
namespace {

TEST(Mtl, MapsAndTheirMaterials) {
  const std::string text =
      "map_Kd before.png\n"
      "newmtl a b\n  map_Kd  wood grain.png  # note\r\nrefl -type sphere sky.png\nmap_aat on\n"
      "newmtl c\nbump -bm 2 -s 2 3 hill.png\nmap_Kd\n";
  const auto maps = read_mtl_maps(text);
  ASSERT_EQ(maps.size(), 3U);
  EXPECT_EQ(maps[1].picture, "sky.png");
  EXPECT_FALSE(maps[1].follows_uvs);
  EXPECT_TRUE(maps[0].follows_uvs);
  EXPECT_EQ(maps[0].material, "a b");
  EXPECT_EQ(maps[0].keyword, "map_Kd");
  EXPECT_EQ(maps[0].picture, "wood grain.png");
  EXPECT_EQ(maps[2].material, "c");
  EXPECT_EQ(maps[2].picture, "hill.png");
}

TEST(Mtl, ColoursOfMaterialsWithoutAPicture) {
  const auto colors = read_mtl_colors(
      "Kd 0 0 0\nnewmtl a b\nKd 1 .5 0\nnewmtl b\nmap_Kd x.png\nKd 1 1 0\nnewmtl c\nKd 1 2\n"
      "newmtl d\nkd 7 0.25 -1\nnewmtl e\nKd spectral a.rfl\nnewmtl f\nKd 1 nan 1\n");
  ASSERT_EQ(colors.size(), 2U);
  EXPECT_EQ(colors.at("a b"), (std::array<float, 3>{1, 0.5F, 0}));
  EXPECT_EQ(colors.at("d"), (std::array<float, 3>{1, 0.25F, 0}));
}

TEST(Mtl, OptionsSayHowAPictureIsRead) {
  const auto maps = read_mtl_maps(
      "newmtl a\n"
      "map_Kd -s 2 3 1 -o 0.25 0.5 -clamp on -mm 0 1 a.png\n"
      "map_Ks -s 2 7.png\n");
  ASSERT_EQ(maps.size(), 2U);
  const TransferSource& source = maps[0].source;
  EXPECT_EQ(source.across, Repeat::clamp);
  // u' = 2 u + 0.25; v' = 3 v + 0.5 from the bottom, so from the top t' = 3 t + 1 - 3 - 0.5.
  EXPECT_EQ(source.matrix, (std::array<double, 6>{2, 0, 0.25, 0, 3, -2.5}));
  EXPECT_EQ(maps[0].picture, "a.png");
  EXPECT_EQ(maps[1].picture, "7.png");
  EXPECT_EQ(maps[1].source.matrix[0], 2);
  EXPECT_EQ(maps[1].source.matrix[4], 1);
  EXPECT_EQ(maps[1].source.across, Repeat::repeat);
}

TEST(Mtl, OtherPicturesKeepTheRestOfTheFile) {
  const std::string text =
      "# by hand\nnewmtl a\nKd 1 0 0\nmap_Kd -s 2 2 -bm 1 -clamp on old one.png # first\r\n"
      "bump hill.png";
  EXPECT_EQ(replace_mtl_pictures(text, {{0, "new.png"}, {1, "b.png"}}, {0}),
            "# by hand\nnewmtl a\nKd 1 0 0\nmap_Kd -bm 1 new.png # first\r\nbump b.png");
  EXPECT_EQ(replace_mtl_pictures(text, {}, {}), text);
  // A picture that only has another name now stays where it is on the surface.
  EXPECT_EQ(replace_mtl_pictures("newmtl a\nmap_Kd -s 2 2 a.png\n", {{0, "../a.png"}}, {}),
            "newmtl a\nmap_Kd -s 2 2 ../a.png\n");
}

}  // namespace
}  // namespace wrapatlas
