#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "io/number.h"
#include "io/ply_header.h"
#include "support/hand_made_atlas.h"
#include "support/model_files.h"

namespace wrapatlas {
namespace {

Model ply(const std::string& bytes) {
  Result<Model> model = model_from(bytes, FileFormat::ply);
  EXPECT_TRUE(model) << model.error().message();
  return model ? *std::move(model) : Model{};
}

const std::string kNoUvs =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar red\nelement face 2\n"
    "property uchar flag\nproperty list uchar int vertex_indices\nelement edge 1\n"
    "property int vertex1\nproperty int vertex2\nend_header\n"
    "0 0 0 7\n1 0 0 8\n0 1 0 9\n1 1 0 10\n1 3 0 1 2\n2 3 1 3 2\n0 3\n";

const std::string kOnVertices =
    "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty double s\r\nproperty double t\r\n"
    "property float x\r\nproperty float y\r\nproperty float z\r\nproperty list uchar int ids\r\n"
    "property float nx\r\nproperty float ny\r\nproperty float nz\r\n"
    "element face 2\r\nproperty list uchar uchar vertex_index\r\nend_header\r\n"
    "0 0 0 0 0 2 5 6 1 0 0\r\n1 0 1 0 0 0 0 1 0\r\n0 1 0 1 0 1 7 0 0 1\r\n1 1 1 1 0 0 0 0 1\r\n"
    "3 0 1 2\r\n3 1 3 2\r\n";

const std::string kOnFaces =
    "ply\nformat ascii 1.0\nobj_info x\nelement face 2\n"
    "property list uchar float texcoord\nproperty list uchar uint vertex_indices\n"
    "property int texnumber\nelement vertex 4\n"
    "property double z\nproperty double y\nproperty double x\nproperty float s\n"
    "property float t\nend_header\n"
    "6 0 0 1 0 0 1 3 0 1 2 5\n0 3 1 3 2 6\n0 0 0 0 0\n0 0 1 0 0\n0 1 0 0 0\n0 1 1 0 0\n";

// The same file in another encoding, by a slow route of its own through the header's types.
std::string encoded(const std::string& text, PlyEncoding encoding) {
  const Result<PlyHeader> header = read_ply_header(text, "m");
  std::string out = text.substr(0, header->body);
  out.replace(out.find("ascii"), 5,
              encoding == PlyEncoding::little ? "binary_little_endian" : "binary_big_endian");
  TextWords words(std::string_view(text).substr(header->body));
  const auto transfer = [&](PlyType type) {
    double value = 0;
    EXPECT_TRUE(parse_number(words.next(), value));
    append_ply(out, encoding, type, value);
    return value;
  };
  for (const PlyElement& element : header->elements) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        const double length = property.is_list ? transfer(property.count_type) : 1;
        for (int k = 0; k < length; ++k) transfer(property.type);
      }
    }
  }
  return out;
}

TEST(Ply, NumbersHaveGoldenBytes) {
  const auto bytes = [](PlyEncoding encoding, PlyType type, double value) {
    std::string out;
    append_ply(out, encoding, type, value);
    return out;
  };
  EXPECT_EQ(bytes(PlyEncoding::little, PlyType::int32, -2), "\xfe\xff\xff\xff");
  EXPECT_EQ(bytes(PlyEncoding::big, PlyType::uint16, 0x1234), "\x12\x34");
  EXPECT_EQ(bytes(PlyEncoding::big, PlyType::float32, 1), std::string("\x3f\x80\0\0", 4));
  EXPECT_EQ(bytes(PlyEncoding::little, PlyType::float64, -2), std::string("\0\0\0\0\0\0\0\xc0", 8));
  EXPECT_EQ(bytes(PlyEncoding::little, PlyType::uint8, 300), "\xff");
  EXPECT_EQ(bytes(PlyEncoding::little, PlyType::int8, -300), "\x80");
  EXPECT_EQ(bytes(PlyEncoding::text, PlyType::uint8, 1.5), "2");
  EXPECT_EQ(bytes(PlyEncoding::text, PlyType::float32, 0.1), "0.1");
}

TEST(Ply, ReadsAllEncodings) {
  for (const std::string& text : {kNoUvs, kOnVertices, kOnFaces}) {
    const Model model = ply(text);
    EXPECT_EQ(model.mesh.positions,
              (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
    EXPECT_EQ(model.mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    for (const PlyEncoding encoding : {PlyEncoding::little, PlyEncoding::big}) {
      const std::string binary = encoded(text, encoding);
      const Model same = ply(binary);
      expect_same_corners(same.mesh, model.mesh);
      if (&text != &kNoUvs) {
        EXPECT_EQ(same.mesh.texcoords, model.mesh.texcoords);
      }
    }
  }
}

TEST(Ply, FindsUvs) {
  EXPECT_EQ(ply(kNoUvs).mesh.corner_texcoord, std::vector<std::uint32_t>(6, kNone));
  const Model on_vertices = ply(kOnVertices);
  EXPECT_EQ(on_vertices.mesh.texcoords, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
  EXPECT_EQ(on_vertices.mesh.corner_texcoord, on_vertices.mesh.corner_position);
  const Model on_faces = ply(kOnFaces);
  EXPECT_EQ(on_faces.mesh.texcoords, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(on_faces.mesh.corner_texcoord,
            (std::vector<std::uint32_t>{0, 1, 2, kNone, kNone, kNone}));
  EXPECT_EQ(on_faces.remarks.size(), 1U);
  for (const char* name : {"u", "texture_u"}) {
    std::string text = kOnVertices;
    text.replace(text.find("double s"), 8, std::string("float ") + name);
    text.replace(text.find("double t"), 8, name[0] == 'u' ? "float v" : "float texture_v");
    EXPECT_EQ(ply(text).mesh.texcoords, on_vertices.mesh.texcoords) << name;
  }
}

TEST(Ply, WritesUvsToFacesOfAFileWithout) {
  const Model model = ply(kNoUvs);
  std::string expected = kNoUvs;
  expected.replace(expected.find("element edge"), 0, "property list uchar float texcoord\n");
  expected.replace(expected.find("1 3 0 1 2\n"), 20,
                   "1 3 0 1 2 6 0 0 0.0625 0 0.125 0\n"
                   "2 3 1 3 2 6 0.1875 0.0625 0.25 0.0625 0.3125 0.0625\n");
  EXPECT_EQ(saved_bytes(model, torn_atlas(model.mesh), ".ply"), expected);
}

TEST(Ply, ReplacesUvsOfFaces) {
  const Model model = ply(kOnFaces);
  AtlasMesh atlas = identity_atlas(model.mesh);
  EXPECT_EQ(saved_bytes(model, atlas, ".ply"), kOnFaces);
  for (Vec2& uv : atlas.texcoords) uv = {uv.x / 4, uv.y + 1};
  std::string expected = kOnFaces;
  expected.replace(expected.find("6 0 0 1 0 0 1"), 13, "6 0 1 0.25 1 0 2");
  EXPECT_EQ(saved_bytes(model, atlas, ".ply"), expected);
}

TEST(Ply, ReplacesUvsOfVertices) {
  const Model model = ply(kOnVertices);
  AtlasMesh atlas = identity_atlas(model.mesh);
  EXPECT_EQ(saved_bytes(model, atlas, ".ply"), kOnVertices);
  for (Vec2& uv : atlas.texcoords) uv = {uv.x / 4, uv.y + 1};
  std::string expected = kOnVertices;
  expected.replace(expected.find("0 0 0 0 0 2 5 6 1 0 0"), 23, "0 1 0 0 0 2 5 6 1 0 0\r\n");
  expected.replace(expected.find("1 0 1 0 0 0"), 11, "0.25 1 1 0 0 0");
  expected.replace(expected.find("0 1 0 1 0 1 7"), 13, "0 2 0 1 0 1 7");
  expected.replace(expected.find("1 1 1 1 0 0"), 11, "0.25 2 1 1 0 0");
  EXPECT_EQ(saved_bytes(model, atlas, ".ply"), expected);
}

TEST(Ply, RepeatsVerticesThatNeedSeveralUvs) {
  const Model model = ply(kOnVertices);
  AtlasMesh atlas = identity_atlas(model.mesh);
  atlas.texcoords.push_back({0.5, 0.25});
  atlas.corner_texcoord[5] = 4;  // vertex 2 in the second face
  std::string expected = kOnVertices;
  expected.replace(expected.find("vertex 4"), 8, "vertex 5");
  expected.replace(expected.find("3 0 1 2"), 0, "0.5 0.25 0 1 0 1 7 0 0 1\r\n");
  expected.replace(expected.find("3 1 3 2"), 7, "3 1 3 4");
  EXPECT_EQ(saved_bytes(model, atlas, ".ply"), expected);
}

TEST(Ply, CutVerticesInterpolateTheirProperties) {
  const Model model = ply(kOnVertices);
  const std::string out = saved_bytes(model, halved_atlas(model.mesh, 0.25), ".ply");
  EXPECT_NE(out.find("element vertex 6\r\n"), std::string::npos);
  EXPECT_NE(out.find("element face 4\r\n"), std::string::npos);
  EXPECT_NE(out.find("\r\n0.75 0 0.75 0 0 2 5 6 0.31622776601683794 0.9486832980505138 0\r\n"
                     "1 0.75 1 0.75 0 0 0 0.31622776601683794 0.9486832980505138\r\n"
                     "3 0 4 2\r\n3 4 1 2\r\n3 1 5 2\r\n3 5 3 2\r\n"),
            std::string::npos)
      << out;
  const std::string colored = saved_bytes(ply(kNoUvs), halved_atlas(ply(kNoUvs).mesh), ".ply");
  EXPECT_NE(colored.find("\n0.5 0 0 8\n1 0.5 0 9\n1 3 0 4 2 0\n1 3 4 1 2 0\n2 3 1 5 2 0\n"),
            std::string::npos)
      << colored;
}

TEST(Ply, WholeNumberPositionsAreNotCut) {
  std::string text = kNoUvs;
  text.replace(text.find("float y"), 7, "short y");
  const Model model = ply(text);
  EXPECT_EQ(saved_bytes(model, halved_atlas(model.mesh), ".ply").substr(0, 7), "error: ");
  EXPECT_EQ(saved_bytes(model, torn_atlas(model.mesh), ".ply").substr(0, 4), "ply\n");
}

TEST(Ply, TypesGrowWithTheMesh) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 130\nproperty float x\nproperty float y\n"
      "property float z\nproperty float u\nproperty float v\nelement face 2\n"
      "property list char char vertex_indices\nend_header\n";
  for (int i = 0; i < 130; ++i) text += fmt::format("{} {} 0 0 0\n", i, i * i);
  text += "127";
  for (int i = 0; i < 127; ++i) text += fmt::format(" {}", i);
  text += "\n3 0 1 2\n";
  const Model model = ply(text);
  for (const AtlasMesh& atlas : {torn_atlas(model.mesh), halved_atlas(model.mesh)}) {
    const std::string out = saved_bytes(model, atlas, ".ply");
    EXPECT_NE(out.find("property list char uint vertex_indices\n"), std::string::npos);
    expect_same_corners(ply(out).mesh, apply_atlas(model.mesh, atlas));
  }
  text.replace(text.find("u\nproperty float v"), 18, "a\nproperty float b");
  const Model without = ply(text);
  const std::string out = saved_bytes(without, torn_atlas(without.mesh), ".ply");
  EXPECT_NE(out.find("property list uchar float texcoord\n"), std::string::npos);
}

// Torn at random and cut, in all encodings: reading back gives what apply_atlas says.
TEST(Ply, RandomRoundTrips) {
  std::mt19937 random(11);
  for (const std::string& text : {kNoUvs, kOnVertices, kOnFaces}) {
    for (const PlyEncoding encoding : {PlyEncoding::text, PlyEncoding::little, PlyEncoding::big}) {
      const std::string bytes = encoding == PlyEncoding::text ? text : encoded(text, encoding);
      const Model model = ply(bytes);
      AtlasMesh torn = torn_atlas(model.mesh);
      for (std::uint32_t& texcoord : torn.corner_texcoord)
        texcoord = static_cast<std::uint32_t>(random() % 6);
      expect_same_corners(ply(saved_bytes(model, torn, ".ply")).mesh,
                          apply_atlas(model.mesh, torn));
      AtlasMesh cut = halved_atlas(model.mesh, 0.25);
      const Mesh again = ply(saved_bytes(model, cut, ".ply")).mesh;
      expect_same_corners(again, apply_atlas(model.mesh, cut));
    }
  }
}

TEST(Ply, HeaderErrorsNameTheLine) {
  const auto expect_error = [](const std::string& bytes, const std::string& start) {
    EXPECT_EQ(load_error(bytes, FileFormat::ply).rfind(start, 0), 0U)
        << load_error(bytes, FileFormat::ply);
  };
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = kNoUvs;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_error("", "m:1: the file does not begin with 'ply'");
  expect_error("plx\n", "m:1: the file does not begin with 'ply'");
  expect_error("ply\nformat ascii 1.0\n", "m:3: the header does not end");
  expect_error("ply\nend_header\n", "m:2: the header has no line 'format'");
  expect_error(changed("ascii", "utf"), "m:2: the format 'utf' is not known");
  expect_error(changed("comment", "remark"), "m:3: 'remark' is not a word of a header");
  expect_error(changed("vertex 4", "vertex -4"), "m:4: an element needs a name and a count");
  expect_error(changed("float x", "half x"), "m:5: the type 'half' is not known");
  expect_error(changed("float x", "float"), "m:5: a property needs a name");
  expect_error(changed("list uchar", "list float"), "m:11: 'float' is no type for the length");
  expect_error("ply\nproperty float x\n", "m:2: a property stands before the first element");
  expect_error(changed("float x", "float a"), "m: the header has no vertices with x, y and z");
  expect_error(changed("vertex_indices", "other"), "m: the header has no faces with a list");
  expect_error(changed("vertex 4", "vertex 4000000000"),
               "m:15: there are fewer bytes than 4000000000 records of 'vertex' take");
  expect_error(changed("edge 1", "edge 9000000000000000000"), "m:15: there are fewer bytes");
}

TEST(Ply, BodyErrorsNameTheRecord) {
  const auto expect_error = [](std::string text, const std::string& from, const std::string& to,
                               const std::string& in_text, const std::string& in_binary) {
    text.replace(text.find(from), from.size(), to);
    const std::string error = load_error(text, FileFormat::ply);
    EXPECT_EQ(error.rfind(in_text, 0), 0U) << error;
    if (in_binary.empty()) return;
    const std::string binary = load_error(encoded(text, PlyEncoding::big), FileFormat::ply);
    EXPECT_EQ(binary.rfind(in_binary, 0), 0U) << binary;
  };
  expect_error(kNoUvs, "1 0 0 8", "1 nan 0 8", "m:17: a coordinate is not",
               "m: vertex 1: a coordinate is not");
  expect_error(kNoUvs, "1 0 0 8", "1 x 0 8", "m:17: the file ends too early, or a word", "");
  expect_error(kNoUvs, "3 1 3 2", "3 1 4 2", "m:21: the face refers to vertex 4 of 4",
               "m: face 1: the face refers to vertex 4 of 4");
  expect_error(kNoUvs, "3 1 3 2", "3 1 -1 2", "m:21: the face refers to vertex -1 of 4",
               "m: face 1: the face refers to vertex -1 of 4");
  expect_error(kNoUvs, "3 1 3 2", "2 1 3", "m:21: a face needs three corners and has 2",
               "m: face 1: a face needs three corners and has 2");
  expect_error(kOnFaces, "6 0 0 1 0 0 1", "5 0 0 1 0 0",
               "m:15: the face has 3 corners and 5 numbers in 'texcoord'", "m: face 0: the face");
  expect_error(kOnFaces, "6 0 0 1", "6 0 0 inf", "m:15: a UV is not", "m: face 0: a UV is not");
  const std::string binary = encoded(kNoUvs, PlyEncoding::little);
  for (std::size_t size = binary.find("end_header"); size < binary.size(); ++size) {
    EXPECT_FALSE(model_from(binary.substr(0, size), FileFormat::ply)) << size;
  }
  std::string huge = binary;  // the length of the first face's list
  huge[huge.size() - 8 - 14 - 13] = '\xff';
  EXPECT_EQ(load_error(huge, FileFormat::ply).rfind("m: face 0: the file ends too early", 0), 0U)
      << load_error(huge, FileFormat::ply);
}

TEST(Ply, ElementsWithoutPropertiesTakeNoTime) {
  std::string text = kNoUvs;
  text.replace(text.find("element edge"), 0, "element nothing 9000000000000000000\n");
  const Model model = ply(text);
  EXPECT_EQ(model.mesh.face_count(), 2U);
  EXPECT_EQ(ply(saved_bytes(model, torn_atlas(model.mesh), ".ply")).mesh.face_count(), 2U);
}

}  // namespace
}  // namespace wrapatlas
