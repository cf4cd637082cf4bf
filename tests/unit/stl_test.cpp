#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "support/model_files.h"

namespace wrapatlas {
namespace {

void append_u32(std::string& out, std::uint32_t value) {
  for (unsigned i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xffU);
}

using Triangle = std::array<std::array<float, 3>, 3>;

std::string binary_stl(const std::vector<Triangle>& triangles, std::string header = "binary") {
  header.resize(80);
  append_u32(header, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    header += std::string(12, '\x7f');
    for (const auto& corner : triangle) {
      for (const float value : corner) append_u32(header, std::bit_cast<std::uint32_t>(value));
    }
    header += "ab";
  }
  return header;
}

const std::vector<Triangle> kTwo{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                 {{{1, 0, 0}, {1, 1, 0.1F}, {-0.0F, 1, 0}}}};

Model stl(const std::string& bytes) {
  Result<Model> model = model_from(bytes, FileFormat::stl);
  EXPECT_TRUE(model) << model.error().message();
  return model ? *std::move(model) : Model{};
}

void expect_two(const Model& model, double z) {
  EXPECT_EQ(model.mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, z}}));
  EXPECT_EQ(model.mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(model.mesh.face_begin, (std::vector<std::uint32_t>{0, 3, 6}));
  EXPECT_EQ(model.mesh.corner_texcoord, std::vector<std::uint32_t>(6, kNone));
  EXPECT_EQ(model.source, nullptr);
}

TEST(Stl, ReadsBinaryEvenIfItBeginsWithSolid) {
  expect_two(stl(binary_stl(kTwo)), double{0.1F});
  expect_two(stl(binary_stl(kTwo, "solid facet normal")), double{0.1F});
}

const std::string kText =
    "solid two parts\r\n"
    "facet normal nan nan nan\r\n outer loop\r\n  vertex 0 0 0\r\n  vertex 1 0 0\r\n"
    "  vertex 0 1 0\r\n endloop\r\nendfacet\r\nendsolid two parts\r\n"
    "SOLID\n\tFACET NORMAL 0 0 1 OUTER LOOP VERTEX 1 0 0 VERTEX +1 1. .1e0 VERTEX -0 1 0 ENDLOOP\n"
    "ENDFACET\nENDSOLID";

TEST(Stl, ReadsText) {
  const Model model = stl(kText);
  expect_two(model, 0.1);
  EXPECT_TRUE(model.remarks.empty());
}

TEST(Stl, RemarksOnWhatIsOdd) {
  EXPECT_EQ(stl(binary_stl(kTwo) + "tail").remarks,
            std::vector<std::string>{"left aside 4 bytes after the last triangle"});
  EXPECT_EQ(stl(kText.substr(0, kText.size() - 8)).remarks,
            std::vector<std::string>{"the file ends without 'endsolid'"});
}

TEST(Stl, Errors) {
  const auto expect_error = [](const std::string& bytes, const std::string& start) {
    EXPECT_EQ(load_error(bytes, FileFormat::stl).rfind(start, 0), 0U)
        << load_error(bytes, FileFormat::stl);
  };
  const std::string binary = binary_stl(kTwo);
  expect_error("", "m: the file is no STL");
  expect_error("hello", "m: the file is no STL");
  expect_error("solid\nendsolid\n", "m: the file holds no faces");
  expect_error(binary_stl({}), "m: the file holds no faces");
  expect_error(binary.substr(0, 183),
               "m: a binary STL of this many triangles has 184 bytes, the "
               "file has 183");
  for (const std::string header : {"solid", "solid\n", "solid facet", "solid\nfacet normal"}) {
    expect_error(binary_stl(kTwo, header).substr(0, 183), "m: a binary STL of this many triangles");
    expect_error(binary_stl(kTwo, header).substr(0, 83), "m: the file is no STL: too short");
  }
  std::string blanks = "solid";
  blanks.resize(80, ' ');
  expect_error(binary_stl(kTwo, blanks).substr(0, 150), "m: a binary STL of this many triangles");
  std::string huge = binary;
  huge.replace(80, 4, "\xff\xff\xff\xff");
  expect_error(huge, "m: a binary STL of this many triangles has 214748364834 bytes");
  for (const float bad : {std::numeric_limits<float>::infinity(), std::nanf(""), 2e30F}) {
    std::vector<Triangle> triangles = kTwo;
    triangles[1][2][1] = bad;
    expect_error(binary_stl(triangles), "m: triangle 1: a coordinate is not a usable number");
  }
  expect_error("solid\nfacet\nnormal 0 0 1\nloop\n", "m:4: 'loop' is not 'outer'");
  expect_error("solid\nfoo\n", "m:2: 'foo' is not 'facet'");
  expect_error("solid\nfacet normal 0 0 1 outer loop\nvertex 0 0 x", "m:3: 'x' is not a usable");
  expect_error("solid\nfacet normal 0 0 1 outer loop\nvertex 0 0 0\nendloop",
               "m:4: 'endloop' is not 'vertex'");
  expect_error("solid\nfacet normal 0 0 1 outer loop\nvertex 0 0 0\n",
               "m:4: the file ends where 'vertex' should follow");
}

}  // namespace
}  // namespace wrapatlas
