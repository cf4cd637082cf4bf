// Normals and colours that model files hold.
#include <gtest/gtest.h>

#include "support/model_files.h"
#include "wrapatlas/model.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

Model with_shading(const std::string& text, FileFormat format) {
  LoadOptions options;
  options.shading = true;
  auto model = load_model_bytes(text, format, "test", ".", options);
  EXPECT_TRUE(model) << model.error().message();
  return model ? *std::move(model) : Model{};
}

const std::string kObj =
    "v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 0 0 2\nv 1 1 0 7\n"
    "vn 0 0 2\nvn nan 1 0\nvn 0 3 4\n"
    "f 1//1 2//2 3//3\nf 4 3 2\n";

TEST(ModelShading, OfAnObj) {
  const Model model = with_shading(kObj, FileFormat::obj);
  ASSERT_EQ(model.corner_normal.size(), 6U);
  EXPECT_EQ(model.corner_normal[0], (Vec3{0, 0, 1}));
  EXPECT_EQ(model.corner_normal[1], Vec3{});  // no vector
  EXPECT_LT(length(model.corner_normal[2] - Vec3{0, 0.6, 0.8}), 1e-12);
  EXPECT_EQ(model.corner_normal[3], Vec3{});  // none
  ASSERT_EQ(model.corner_color.size(), 6U);
  EXPECT_EQ(model.corner_color[0], (std::array<float, 3>{1, srgb_to_linear(0.5F), 0}));
  EXPECT_EQ(model.corner_color[1], (std::array<float, 3>{1, 1, 1}));
  EXPECT_EQ(model.corner_color[2], (std::array<float, 3>{0, 0, 1}));
  EXPECT_EQ(model.corner_color[3], (std::array<float, 3>{1, 1, 1}));  // 7 is a weight
}

TEST(ModelShading, OnlyIfAskedFor) {
  const auto model = load_model_bytes(kObj, FileFormat::obj, "test", ".");
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->corner_normal.empty());
  EXPECT_TRUE(model->corner_color.empty());
}

TEST(ModelShading, WithoutAnyThereIsNone) {
  const Model model = with_shading("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", FileFormat::obj);
  EXPECT_TRUE(model.corner_normal.empty());
  EXPECT_TRUE(model.corner_color.empty());
}

TEST(ModelShading, OfAPly) {
  const Model model = with_shading(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 5 255 0 51\n1 0 0 0 0 0 0 0 0\n0 1 0 3 0 4 255 255 255\n3 2 1 0\n",
      FileFormat::ply);
  ASSERT_EQ(model.corner_normal.size(), 3U);
  EXPECT_LT(length(model.corner_normal[0] - Vec3{0.6, 0, 0.8}), 1e-12);
  EXPECT_EQ(model.corner_normal[1], Vec3{});
  EXPECT_EQ(model.corner_normal[2], (Vec3{0, 0, 1}));
  ASSERT_EQ(model.corner_color.size(), 3U);
  EXPECT_EQ(model.corner_color[2], (std::array<float, 3>{1, 0, srgb_to_linear(0.2F)}));
}

TEST(ModelShading, APlyWithoutBlueHasNoColours) {
  const Model model = with_shading(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 255 0\n1 0 0 0 0\n0 1 0 255 255\n3 2 1 0\n",
      FileFormat::ply);
  EXPECT_TRUE(model.corner_color.empty());
  EXPECT_TRUE(model.corner_normal.empty());
}

}  // namespace
}  // namespace wrapatlas
