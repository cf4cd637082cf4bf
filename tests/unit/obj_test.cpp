#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "io/obj_write.h"
#include "support/hand_made_atlas.h"
#include "support/model_files.h"

namespace wrapatlas {
namespace {

Model obj(const std::string& text) {
  Result<Model> model = model_from(text, FileFormat::obj);
  EXPECT_TRUE(model) << model.error().message();
  return model ? *std::move(model) : Model{};
}

std::string rewritten(const std::string& text, const Mesh& mesh, const AtlasMesh& atlas) {
  std::string out;
  EXPECT_TRUE(rewrite_obj(text, mesh, atlas, {}, [&](std::string_view piece) -> Status {
    out += piece;
    return Done{};
  }));
  return out;
}

std::string obj_error(const std::string& text) { return load_error(text, FileFormat::obj); }

// Two quads with a seam between them: vertices are shared, UVs are not.
const std::string kQuads =
    "# a comment \\\r\n"
    "mtllib m.mtl\r\n"
    "o left\r\n"
    "v 0 0 0\r\nv 1 0 0\r\nv 2 0 0\r\nv 0 1 0\r\nv 1 1 0\r\nv 2 1 0\r\n"
    "vt 0 0 0.25\r\nvt\t.5 0\r\nvt 1 0\r\nvt  0 1 # corner\r\nvt .5 1\r\nvt 1 1\r\nvt 9 9\r\n"
    "vn 0 0 1\r\n"
    "usemtl red\r\n"
    "f 1/1/1 2/2/1 5/5/1 4/4/1\r\n"
    "g right\r\n"
    "s 1\r\n"
    "f  2/2/1\t3/3/1 6/6/1  5/5/1 # second\r\n"
    "l 1/1 2/2 3/3\r\n"
    "p 6\r\n";

const std::string kPlain = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, ReadsFacesAndUvs) {
  const Model model = obj(kQuads);
  EXPECT_EQ(model.mesh.positions.size(), 6U);
  EXPECT_EQ(model.mesh.texcoords.size(), 7U);
  EXPECT_EQ(model.mesh.texcoords[1], (Vec2{0.5, 0}));
  EXPECT_EQ(model.mesh.face_begin, (std::vector<std::uint32_t>{0, 4, 8}));
  EXPECT_EQ(model.mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 4, 3, 1, 2, 5, 4}));
  EXPECT_EQ(model.mesh.corner_texcoord, (std::vector<std::uint32_t>{0, 1, 4, 3, 1, 2, 5, 4}));
  EXPECT_FALSE(model.v_points_down);
}

TEST(Obj, ObjectsByTheirNames) {
  const auto objects = [](const std::string& text) { return obj(kPlain + text).mesh.face_object; };
  using Objects = std::vector<std::uint32_t>;
  EXPECT_EQ(objects("f 1 2 3\nf 1 2 3\n"), Objects{});
  EXPECT_EQ(objects("o a\ng x\nf 1 2 3\ng y\nusemtl m\nf 1 2 3\n"), Objects{});
  EXPECT_EQ(objects("o empty\no a\nf 1 2 3\no a\nf 1 2 3\n"), Objects{});
  EXPECT_EQ(objects("f 1 2 3\no a\nf 1 2 3\n"), (Objects{0, 1}));
  EXPECT_EQ(objects("o a\nf 1 2 3\no b\nf 1 2 3\nf 1 2 3\no\t a \r\nf 1 2 3\n"),
            (Objects{0, 1, 1, 0}));
  EXPECT_EQ(objects("o a b\nf 1 2 3\no a c\nf 1 2 3\no\nf 1 2 3\n"), (Objects{0, 1, 2}));
}

TEST(Obj, ReadsAllFormsOfCornersAndIndices) {
  const Model model = obj(kPlain +
                          "vt 0 0\nvt 1 0\nvn 0 0 1\nf 1 2//1 -1/-2\nf +1 2/2/-1 3/1\n"
                          "f 1/ 2/1/ 3//\n");
  EXPECT_EQ(model.mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(model.mesh.corner_texcoord,
            (std::vector<std::uint32_t>{kNone, kNone, 0, kNone, 1, 0, kNone, 0, kNone}));
}

TEST(Obj, ReadsNumbersAndExtraComponents) {
  const Model model =
      obj("\xEF\xBB\xBFv +1.5e2 -.5 1. 1 0 0\nv 1e-400 0 0 1\nv\t0\t1\t0\nvt 0.25\nf 1/1 2/1 3/1");
  EXPECT_EQ(model.mesh.positions[0], (Vec3{150, -0.5, 1}));
  EXPECT_EQ(model.mesh.positions[1], (Vec3{0, 0, 0}));
  EXPECT_EQ(model.mesh.texcoords[0], (Vec2{0.25, 0}));
}

TEST(Obj, JoinsContinuedLines) {
  const Model model = obj("v 0 \\\n0 \\\r\n0\nv 1 0 0\nv 0 1 0\n# no \\\nf 1 \\\n2\\\n 3\\");
  EXPECT_EQ(model.mesh.corner_position, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Obj, ReadsVerticesDefinedAfterTheirFaceAndOldMacLines) {
  EXPECT_EQ(obj("f 1 2 3\n" + kPlain).mesh.face_count(), 1U);
  EXPECT_EQ(obj("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").mesh.face_count(), 1U);
}

TEST(Obj, ReadsVeryLongLines) {
  std::string text = kPlain + "f";
  for (int i = 0; i < 100000; ++i) text += fmt::format(" {}", i % 3 + 1);
  EXPECT_EQ(obj(text).mesh.corner_count(), 100000U);
}

TEST(Obj, ErrorsNameTheLine) {
  EXPECT_EQ(obj_error("v 0 0\n").substr(0, 33), "m:1: a coordinate is missing; exp");
  for (const char* bad : {"nan", "inf", "-1e30", "1e999", "x", "1.#QNAN", "1,5", "+-1", "++1"}) {
    const std::string text = std::string("\nv 0 0 ") + bad + "\n";
    EXPECT_EQ(obj_error(text).rfind(std::string("m:2: '") + bad + "' is not a usable", 0), 0U);
  }
  EXPECT_EQ(obj_error("vt nan 0\n").rfind("m:1: 'nan'", 0), 0U);
  EXPECT_EQ(obj_error(kPlain + "f 1 2\n").rfind("m:4: a face needs three corners and has 2", 0),
            0U);
  for (const char* bad : {"0", "-4", "x", "1/x", "1//0", "1/2/3/4", "99999999999", "4294967296"}) {
    const std::string text = kPlain + "\\\n\nf 1 2 " + bad + "\n";
    EXPECT_EQ(obj_error(text).rfind("m:6: '", 0), 0U) << bad << " " << obj_error(text);
  }
  for (const char* open : {"3/", "3//", "3/1/"}) {
    const std::string face = std::string("f 1/1 2/1 ") + open;
    EXPECT_EQ(obj_error("vt 0 0\n" + kPlain + face)
                  .rfind(std::string("m:5: nothing follows the slash of '") + open + "'", 0),
              0U);
  }
  EXPECT_EQ(
      obj_error(kPlain + "f 1 2 3\nf 1 2 4\n").rfind("m:5: the face refers to vertex 4 of 3", 0),
      0U);
  EXPECT_EQ(obj_error(kPlain + "f 1 2 3\nf 1 2/1 3\n")
                .rfind("m:5: the face refers to texture coordinate 1 of 0", 0),
            0U);
  EXPECT_EQ(obj_error(kPlain + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1//2 2//1 3//2\n")
                .rfind("m:6: the face refers to normal 2 of 1", 0),
            0U);
}

TEST(Obj, EmptyFilesAreErrors) {
  EXPECT_EQ(obj_error("").rfind("m: the file holds no faces", 0), 0U);
  EXPECT_EQ(obj_error(kPlain).rfind("m: the file holds no faces", 0), 0U);
}

TEST(Obj, KeepsEverythingWhenNothingChanges) {
  const std::string text =
      kPlain + "vt 0 0\nvt 0.1 0 7\nvt 1e-05 0.3333333333333333\nf 1/1 2/2 3/3";
  const Model model = obj(text);
  EXPECT_EQ(saved_bytes(model, identity_atlas(model.mesh), ".obj"), text);
}

TEST(Obj, ReplacesUvsInPlace) {
  const Model model = obj(kQuads);
  AtlasMesh atlas = identity_atlas(model.mesh);
  for (Vec2& uv : atlas.texcoords) uv = {uv.x / 4 + 0.125, uv.y / 3};
  std::string expected = kQuads;
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(expected.find(from), std::string::npos) << from;
    expected.replace(expected.find(from), from.size(), to);
  };
  replace("vt 0 0 0.25", "vt 0.125 0 0.25");
  replace("vt\t.5 0", "vt\t0.25 0");
  replace("vt 1 0", "vt 0.375 0");
  replace("vt  0 1 #", "vt  0.125 0.3333333333333333 #");
  replace("vt .5 1", "vt 0.25 0.3333333333333333");
  replace("vt 1 1", "vt 0.375 0.3333333333333333");
  EXPECT_EQ(saved_bytes(model, atlas, ".obj"), expected);
}

TEST(Obj, AddsUvsWhereOneMustBecomeSeveral) {
  const Model model =
      obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0 9\nvt 0 1\nvn 0 0 1\n"
          "f 1/1/1 2/-2/1 -2/3/-1\nl 3/-1 2/-3\nvt 5 5\nf 2/2 4/4 3/3 # e\n");
  AtlasMesh atlas = identity_atlas(model.mesh);
  atlas.texcoords.push_back({0.5, 0.25});
  atlas.texcoords.push_back({0.75, 0.25});
  atlas.corner_texcoord = {0, 1, 2, 4, 3, 5};
  EXPECT_EQ(saved_bytes(model, atlas, ".obj"),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0 9\nvt 0 1\nvn 0 0 1\n"
            "f 1/1/1 2/2/1 -2/3/-1\nl 3/3 2/1\nvt 5 5\nvt 0.5 0.25\nvt 0.75 0.25\n"
            "f 2/5 4/4 3/6 # e\n");
}

TEST(Obj, EqualValuesDoNotTearAVertex) {
  const Model model = obj(kQuads);
  AtlasMesh atlas = identity_atlas(model.mesh);
  const Vec2 copy = atlas.texcoords[1];
  atlas.texcoords.push_back(copy);
  atlas.corner_texcoord[4] = 7;
  EXPECT_EQ(saved_bytes(model, atlas, ".obj"),
            saved_bytes(model, identity_atlas(model.mesh), ".obj"));
}

TEST(Obj, FacesWithoutNewUvsKeepTheirs) {
  const Model model = obj(kQuads);
  AtlasMesh atlas = identity_atlas(model.mesh);
  for (Vec2& uv : atlas.texcoords) uv = {uv.x + 3, uv.y};
  for (int c = 4; c < 8; ++c) atlas.corner_texcoord[c] = kNone;
  const Model again = obj(saved_bytes(model, atlas, ".obj"));
  for (int c = 0; c < 8; ++c) {
    const Vec2 old = model.mesh.texcoords[model.mesh.corner_texcoord[c]];
    EXPECT_EQ(again.mesh.texcoords[again.mesh.corner_texcoord[c]],
              (Vec2{old.x + (c < 4 ? 3 : 0), old.y}));
  }
}

TEST(Obj, GivesUvsToCornersThatHadNone) {
  const Model model = obj(kPlain + "vn 0 0 1\nf 1 2//1 3\n");
  EXPECT_EQ(saved_bytes(model, torn_atlas(model.mesh), ".obj"),
            kPlain + "vn 0 0 1\nvt 0 0\nvt 0.0625 0\nvt 0.125 0\nf 1/1 2/2/1 3/3\n");
}

TEST(Obj, CutFacesBecomeSeveralInPlace) {
  const Model model =
      obj("v 0 0 0 1 0 0\r\nv 2 0 0 0 1 0\r\nv 0 2 0 0 0 1\r\nvt 0 0\r\nvt 1 0\r\nvt 0 1\r\n"
          "vn 0 1 0\r\nvn 1 0 0\r\ng a\r\nf  -3/-3/-2 2/2/2 3/3/2 # e\r\nv 5 5 5\r\n"
          "l 1 -1\r\np -1 2\r\nf 1 3 4\r\n");
  AtlasMesh atlas = halved_atlas(model.mesh);
  EXPECT_EQ(saved_bytes(model, atlas, ".obj"),
            "v 0 0 0 1 0 0\r\nv 2 0 0 0 1 0\r\nv 0 2 0 0 0 1\r\nvt 0 0\r\nvt 1 0\r\nvt 0 1\r\n"
            "vn 0 1 0\r\nvn 1 0 0\r\ng a\r\n"
            "v 1 0 0 0.5 0.5 0\r\nvn 0.7071067811865475 0.7071067811865475 0\r\nvt 0.5 0\r\n"
            "f  1/1/1 4/4/3 3/3/2\r\nf  4/4/3 2/2/2 3/3/2 # e\r\nv 5 5 5\r\n"
            "l 1 5\r\np 5 2\r\nv 0 1 0 0.5 0 0.5\r\nf 1 6 5\r\nf 6 3 5\r\n");
}

TEST(Obj, CutKeepsIndicesOfFreeFormElements) {
  const Model model = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 4 4 4\ncurv 0 1 1 4 -1\n");
  EXPECT_NE(saved_bytes(model, halved_atlas(model.mesh), ".obj").find("curv 0 1 1 5 5\n"),
            std::string::npos);
}

TEST(Obj, FacesOfAnEdgeCutItAtTheSamePoint) {
  const Model model =
      obj("v 0.1 0.2 0.3\nv 0.7 0.11 0.13\nv 0.5 0.9 0.17\nv 0.3 -0.7 0.19\n"
          "v 0.1 0.2 0.3\nvt 0 0\nf 1/1 2/1 3/1\nf 2/1 1/1 4/1\nf 5/1 2/1 4/1\n");
  const Model again = obj(saved_bytes(model, halved_atlas(model.mesh, 0.3), ".obj"));
  // Cut points are corners 1 of each first half; the third face has a repeat of vertex 1.
  const Mesh& mesh = again.mesh;
  EXPECT_EQ(mesh.corner_position[1], mesh.corner_position[7]);
  EXPECT_NE(mesh.corner_position[1], mesh.corner_position[13]);
  EXPECT_EQ(mesh.positions[mesh.corner_position[1]], mesh.positions[mesh.corner_position[13]]);
}

// Random meshes, torn or cut: reading back what was written gives what apply_atlas says.
TEST(Obj, RandomRoundTrips) {
  std::mt19937 random(7);
  const auto pick = [&](int below) { return static_cast<int>(random() % below); };
  for (int round = 0; round < 200; ++round) {
    std::string text;
    int vertices = 0, texcoords = 0, normals = 0;
    const auto number = [&] { return (pick(2000) - 1000) / 7.0; };
    const auto index = [&](int count) {
      const int i = pick(count);
      return pick(2) != 0 ? i + 1 : i - count;
    };
    for (int line = 0; line < 40; ++line) {
      switch (vertices < 3 || texcoords < 2 || normals < 1 ? pick(3) : pick(5)) {
        case 0:
          text += fmt::format("v {} {} {}\n", number(), number(), number());
          ++vertices;
          break;
        case 1:
          text += fmt::format("vt {} {}\n", number(), number());
          ++texcoords;
          break;
        case 2:
          text += fmt::format("vn {} {} 1\n", number(), number());
          ++normals;
          break;
        default: {
          const int form = pick(4);
          text += "f";
          for (int c = 3 + pick(3); c > 0; --c) {
            text += fmt::format(" {}", index(vertices));
            if (form != 0) text += "/";
            if (form >= 2) text += fmt::format("{}", index(texcoords));
            if (form == 1 || form == 3) text += fmt::format("/{}", index(normals));
          }
          text += "\n";
        }
      }
    }
    const Result<Model> model = model_from(text, FileFormat::obj);
    if (!model) continue;  // no face, which is checked above
    AtlasMesh torn = torn_atlas(model->mesh);
    for (std::uint32_t& texcoord : torn.corner_texcoord) {
      texcoord = static_cast<std::uint32_t>(pick(static_cast<int>(torn.texcoords.size())));
    }
    for (const AtlasMesh& atlas : {torn, halved_atlas(model->mesh, 0.3)}) {
      const Model again = obj(rewritten(text, model->mesh, atlas));
      expect_same_corners(again.mesh, apply_atlas(model->mesh, atlas));
    }
  }
}

// Long runs that stay and long runs that change leave the writer in pieces.
std::string long_obj() {
  std::string text = std::string(400000, '#') + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 60000; ++i) text += "vt 0.25 0.5\nvt 0.5 0.5\nvt 0.25 0.75\n";
  for (int i = 0; i < 60000; ++i)
    text += fmt::format("f 1/{} 2/{} 3/{}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  return text + std::string(400000, '#');
}

TEST(Obj, LongFilesAreHandedOnInPieces) {
  const std::string text = long_obj();
  const Model model = obj(text);
  AtlasMesh atlas = torn_atlas(model.mesh);
  atlas.texcoords = model.mesh.texcoords;
  atlas.corner_texcoord = model.mesh.corner_texcoord;
  for (Vec2& uv : atlas.texcoords) uv.x += 0.5;
  std::string expected;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    std::string line = text.substr(at, end - at);
    if (line.rfind("vt 0.25", 0) == 0) line.replace(3, 4, "0.75");
    if (line.rfind("vt 0.5", 0) == 0) line.replace(3, 3, "1");
    expected += line;
    at = end;
  }
  EXPECT_TRUE(rewritten(text, model.mesh, atlas) == expected);

  int calls = 0;
  const Status failed = rewrite_obj(text, model.mesh, atlas, {}, [&](std::string_view) -> Status {
    if (++calls < 3) return Done{};
    return Error{ErrorKind::output, "", "full", ""};
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().what, "full");
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace wrapatlas
