#include <gtest/gtest.h>

#include "support/hand_made_atlas.h"
#include "support/model_files.h"

namespace wrapatlas {
namespace {

Model off(const std::string& text) {
  Result<Model> model = model_from(text, FileFormat::off);
  EXPECT_TRUE(model) << model.error().message();
  return model ? *std::move(model) : Model{};
}

void expect_off_error(const std::string& text, const std::string& start) {
  EXPECT_EQ(load_error(text, FileFormat::off).rfind(start, 0), 0U)
      << load_error(text, FileFormat::off);
}

TEST(Off, ReadsPolygons) {
  const Model model = off("OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n4 0 1 3 2\n");
  EXPECT_EQ(model.mesh.positions[3], (Vec3{1, 1, 0}));
  EXPECT_EQ(model.mesh.face_begin, (std::vector<std::uint32_t>{0, 3, 7}));
  EXPECT_EQ(model.mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3, 2}));
  EXPECT_EQ(model.mesh.corner_texcoord, std::vector<std::uint32_t>(7, kNone));
  EXPECT_EQ(model.source, nullptr);
}

TEST(Off, ReadsCountsOnTheHeaderLineCommentsAndFaceColors) {
  const Model model =
      off("\xEF\xBB\xBFOFF 3 2 3 # counts\r\n# vertices\r\n\r\n0 0 0#x\r\n1 0 0\r\n0 1 0\r\n"
          "3 0 1 2 255 0 0 # red\r\n3 2 1 0 0.5 0.5 0.5 1");
  EXPECT_EQ(model.mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}));
}

TEST(Off, ReadsFilesWithoutKeywordAndVerticesOnOneLine) {
  EXPECT_EQ(off("3 1\n0 0 0 1 0 0 0 1 0\n3 0 1 2").mesh.face_count(), 1U);
}

TEST(Off, SkipsColorsAndNormals) {
  for (const char* vertices : {"COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 1 2 3 4\n0 1 0 1 2 3\n",
                               "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n",
                               "CNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9\n1 0 0 0 0 1 9 9 9 9\n"
                               "0 1 0 0 0 1 9 9 9 9\n"}) {
    const Model model = off(std::string(vertices) + "3 0 1 2\n");
    EXPECT_EQ(model.mesh.positions[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(model.mesh.positions[2], (Vec3{0, 1, 0}));
    EXPECT_TRUE(model.mesh.texcoords.empty());
  }
}

TEST(Off, ReadsUvsPerVertex) {
  for (const char* vertices : {"STOFF\n3 1 0\n0 0 0 0 .5\n1 0 0 1 .5\n0 1 0 0 1\n",
                               "STCNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 0 .5\n1 0 0 0 0 1 9 9 9 9 1 .5\n"
                               "0 1 0 0 0 1 9 9 9 9 0 1\n"}) {
    const Model model = off(std::string(vertices) + "3 2 1 0\n");
    EXPECT_EQ(model.mesh.texcoords, (std::vector<Vec2>{{0, 0.5}, {1, 0.5}, {0, 1}}));
    EXPECT_EQ(model.mesh.corner_texcoord, (std::vector<std::uint32_t>{2, 1, 0}));
  }
}

TEST(Off, LeavesFacesOfOneOrTwoCornersAside) {
  const Model model = off("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n1 0\n");
  EXPECT_EQ(model.mesh.face_count(), 1U);
  ASSERT_EQ(model.remarks.size(), 1U);
  EXPECT_EQ(model.remarks[0],
            "left aside 2 faces of fewer than three corners, the first in line 6");
}

TEST(Off, ErrorsNameTheLine) {
  expect_off_error("", "m:1: the number of vertices is missing");
  expect_off_error("OFF\n-1 1 0\n", "m:2: '-1' is not the number of vertices");
  expect_off_error("OFF\n3\n" + std::string(20, ' '), "m:3: the number of faces is missing");
  expect_off_error("OFF BINARY\n", "m:1: binary OFF");
  expect_off_error("4OFF\n", "m:1: '4OFF' is a variant");
  expect_off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", "m:5: 'nan' is not a usable");
  expect_off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e30 0\n3 0 1 2\n", "m:5: '1e30' is not a usable");
  expect_off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                   "m:6: the face refers to vertex 3 of 3");
  expect_off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
                   "m:6: the face refers to vertex -1 of 3");
  expect_off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "m:7: a vertex number is missing");
  expect_off_error("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                   "m:7: a number of corners is missing");
  expect_off_error("STOFF\n1 0 0\n0 0 0 1\n", "m:3: a usable coordinate is missing");
  expect_off_error("OFF\n0 0 0\n", "m: the file holds no faces");
}

TEST(Off, CountsAreCheckedAgainstTheBytes) {
  expect_off_error("OFF\n4000000000 1 0\n0 0 0\n",
                   "m:2: the number of vertices is 4000000000, more than the file has bytes for");
  expect_off_error("OFF\n3 4000000000 0\n0 0 0\n",
                   "m:2: the number of faces is 4000000000, more than the file has bytes for");
  expect_off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n",
                   "m:7: a vertex number is missing");
}

TEST(Off, HasNoWriterButConverts) {
  const Model model = off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(saved_bytes(model, torn_atlas(model.mesh), ".off").substr(0, 7), "error: ");
  EXPECT_EQ(saved_bytes(model, torn_atlas(model.mesh), ".obj"),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0.0625 0\nvt 0.125 0\nf 1/1 2/2 3/3\n");
}

}  // namespace
}  // namespace wrapatlas
