#include "wrapatlas/texture_sets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/select_faces.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas {
namespace {

/// Four triangles beside each other, the last without UVs.
Mesh four_triangles() {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (const Vec2 at : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}}) {
      mesh.corner_position.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back({at.x + 2 * i, at.y, 0});
      mesh.corner_texcoord.push_back(i == 3 ? kNone
                                            : static_cast<std::uint32_t>(mesh.texcoords.size()));
      if (i != 3) mesh.texcoords.push_back({0.5 * at.x, 0.5 * at.y});
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  return mesh;
}

TextureUse use(std::uint32_t material, const std::string& place, std::size_t image) {
  TextureUse result;
  result.material = material;
  result.place = place;
  result.role = TextureRole::color;
  result.image = image;
  return result;
}

/// Materials 0 and 2 look alike; 1 has a picture of its own.
ModelTextures three_materials() {
  ModelTextures textures;
  textures.images = {Texture(64, 32, 3), Texture(8, 8, 4)};
  textures.uses = {use(0, "map_Kd", 0), use(1, "map_Kd", 1), use(2, "map_Kd", 0)};
  return textures;
}

TEST(TextureSets, MaterialsThatLookAlikeShareOne) {
  const Mesh mesh = four_triangles();
  const ModelTextures textures = three_materials();
  const auto sets = texture_sets(mesh, std::vector<std::uint32_t>{0, 1, 2, 0}, textures, false);
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[0].faces, (std::vector<std::uint32_t>{0, 2}));  // 3 has no UVs
  EXPECT_EQ(sets[1].faces, (std::vector<std::uint32_t>{1}));
  ASSERT_EQ(sets[0].textures.size(), 1U);
  EXPECT_EQ(sets[0].textures[0].uses, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(sets[0].textures[0].name, "map_Kd");
  EXPECT_EQ(sets[0].mesh.face_count(), 2U);
  EXPECT_EQ(sets[1].textures[0].target.channels, 4);
}

TEST(TextureSets, MergedThereIsOneForAll) {
  const ModelTextures textures = three_materials();
  const auto sets =
      texture_sets(four_triangles(), std::vector<std::uint32_t>{0, 1, 2, 0}, textures, true);
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].faces, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(sets[0].group, (std::vector<std::uint32_t>{0, 1, 0}));
  ASSERT_EQ(sets[0].textures.size(), 1U);
  const TransferTarget& target = sets[0].textures[0].target;
  EXPECT_EQ(target.channels, 4);
  EXPECT_EQ(target.of_group[0].texture, &textures.images[0]);
  EXPECT_EQ(target.of_group[1].texture, &textures.images[1]);
}

TEST(TextureSets, WithoutTexturesThereIsNone) {
  EXPECT_TRUE(texture_sets(four_triangles(), {}, {}, true).empty());
  const ModelTextures textures = three_materials();
  EXPECT_TRUE(
      texture_sets(four_triangles(), std::vector<std::uint32_t>(4, 9), textures, false).empty());
}

TEST(TextureSets, InTexelsGroupsLieApart) {
  const ModelTextures textures = three_materials();
  const auto sets =
      texture_sets(four_triangles(), std::vector<std::uint32_t>{0, 1, 2, 0}, textures, true);
  const Mesh mesh = mesh_in_texels(sets[0]);
  EXPECT_EQ(mesh.texcoords[1], (Vec2{32, 0}));
  EXPECT_EQ(mesh.texcoords[2], (Vec2{0, 16}));
  EXPECT_GT(mesh.texcoords[3].x, 8);  // of the other group, though it lay at the same place
  EXPECT_EQ(mesh.texcoords[6], (Vec2{0, 0}));
}

TEST(TextureSets, GroupsOfAnySizesLieApart) {
  ModelTextures textures;
  textures.images = {Texture(64, 64, 3), Texture(16, 64, 3), Texture(512, 2, 3)};
  textures.uses = {use(0, "map_Kd", 0), use(1, "map_Kd", 1), use(2, "map_Kd", 2)};
  Mesh mesh = four_triangles();
  for (std::size_t i = 3; i < 6; ++i) mesh.texcoords[i].x -= 7;
  for (std::size_t i = 6; i < 9; ++i) mesh.texcoords[i].x += 3;
  for (std::vector<std::uint32_t> materials :
       {std::vector<std::uint32_t>{0, 1, 2, 0}, {2, 0, 1, 0}, {1, 2, 0, 0}}) {
    const auto sets = texture_sets(mesh, materials, textures, true);
    ASSERT_EQ(sets.size(), 1U);
    const Mesh texels = mesh_in_texels(sets[0]);
    std::vector<Box2> boxes(3);
    for (std::size_t c = 0; c < 9; ++c)
      boxes[c / 3].add(texels.texcoords[texels.corner_texcoord[c]]);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(boxes[i].size().x, 0.5 * textures.images[materials[i]].width, 1e-9);
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_TRUE(boxes[i].min.x > boxes[j].max.x || boxes[j].min.x > boxes[i].max.x);
      }
    }
  }
}

TEST(TextureSets, MergedHeightsAndNormalsStayApart) {
  ModelTextures textures;
  textures.images = {Texture(8, 8, 3), Texture(8, 8, 1)};
  textures.uses = {use(0, "bump", 0), use(1, "bump", 1)};
  textures.uses[0].role = TextureRole::normals;
  textures.uses[1].role = TextureRole::data;
  const auto sets =
      texture_sets(four_triangles(), std::vector<std::uint32_t>{0, 1, 1, 0}, textures, true);
  ASSERT_EQ(sets.size(), 1U);
  ASSERT_EQ(sets[0].textures.size(), 2U);
  EXPECT_NE(sets[0].textures[0].name, sets[0].textures[1].name);
  for (const SetTexture& texture : sets[0].textures) {
    ASSERT_EQ(texture.uses.size(), 1U);
    EXPECT_EQ(texture.target.role, textures.uses[texture.uses[0]].role);
  }
}

TEST(TextureSets, MergedKeepsColorAndAlpha) {
  ModelTextures textures;
  textures.images = {Texture(8, 8, 2), Texture(8, 8, 3)};
  textures.uses = {use(0, "map_Kd", 0), use(1, "map_Kd", 1)};
  const auto sets =
      texture_sets(four_triangles(), std::vector<std::uint32_t>{0, 1, 1, 0}, textures, true);
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].textures[0].target.channels, 4);
}

TEST(ScaleToTexels, EachChartHasTheAreaItHadInTexels) {
  Mesh texels = four_triangles();
  texels.corner_texcoord = {0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 1, 2};
  Mesh mesh = texels;
  for (std::size_t i = 0; i < 3; ++i) mesh.texcoords[i] = 4.0 * mesh.texcoords[i];
  for (std::size_t i = 6; i < 9; ++i) mesh.texcoords[i] = {1, 1};  // no area: as all together
  scale_to_texels(mesh, std::vector<std::uint32_t>{0, 1, 2, 0}, texels);
  const auto side = [&](std::size_t c) { return mesh.texcoords[mesh.corner_texcoord[c]].x; };
  EXPECT_NEAR(side(1), 0.5, 1e-12);
  EXPECT_NEAR(side(4), 0.5, 1e-12);
  EXPECT_NEAR(side(10), 0.5, 1e-12);
  // Of 0.125 each before, and 2, 0.125, 0, 2 after.
  EXPECT_NEAR(side(7), std::sqrt(0.5 / 4.125), 1e-12);
}

TEST(ShareThinned, IsOfTheOldArea) {
  Mesh texels = four_triangles();
  texels.corner_texcoord = {0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 1, 2};
  Mesh mesh = texels;
  EXPECT_EQ(share_thinned(mesh, 1, texels), 0);
  EXPECT_EQ(share_thinned(mesh, 0.91, texels), 0);
  EXPECT_EQ(share_thinned(mesh, 0.89, texels), 1);
  for (std::size_t i = 3; i < 6; ++i) mesh.texcoords[i] = 0.5 * mesh.texcoords[i];
  EXPECT_DOUBLE_EQ(share_thinned(mesh, 1.5, texels), 0.25);  // one of four alike
  EXPECT_EQ(share_thinned(mesh, 2, texels), 0);
}

TEST(PlacePart, OnlyItsFacesChange) {
  const Mesh mesh = four_triangles();
  AtlasMesh whole = keep_texcoords(mesh);
  const std::vector<std::uint32_t> faces{1, 3};
  Mesh part = select_faces(mesh, faces);
  part.texcoords = {{0.25, 0.25}};
  part.corner_texcoord = {0, 0, 0, 0, 0, kNone};
  AtlasMesh atlas = keep_texcoords(part);
  atlas.wrap = Wrap::v;
  place_part(whole, faces, atlas);
  EXPECT_EQ(whole.wrap, Wrap::v);
  EXPECT_EQ(whole.texcoords[whole.corner_texcoord[0]], mesh.texcoords[0]);
  EXPECT_EQ(whole.texcoords[whole.corner_texcoord[3]], (Vec2{0.25, 0.25}));
  EXPECT_EQ(whole.texcoords[whole.corner_texcoord[6]], mesh.texcoords[6]);
  EXPECT_EQ(whole.texcoords[whole.corner_texcoord[10]], (Vec2{0.25, 0.25}));
  EXPECT_EQ(whole.corner_texcoord[11], kNone);
}

}  // namespace
}  // namespace wrapatlas
