#include "wrapatlas/model.h"

#include <gtest/gtest.h>

#include "io/atlas_fit.h"
#include "support/hand_made_atlas.h"
#include "support/model_files.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;

const std::string kSquare =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
    "f 1/1 2/2 3/3\nf 2/2 4/4 3/3\n";

Model square() { return *model_from(kSquare, FileFormat::obj); }

TEST(Model, FormatComesFromTheEnding) {
  EXPECT_EQ(*format_from_path("a/b.x.OBJ"), FileFormat::obj);
  EXPECT_EQ(*format_from_path("b.off"), FileFormat::off);
  EXPECT_EQ(*format_from_path("b.Ply"), FileFormat::ply);
  EXPECT_EQ(*format_from_path("b.stl"), FileFormat::stl);
  EXPECT_EQ(*format_from_path("b.gltf"), FileFormat::gltf);
  EXPECT_EQ(*format_from_path("b.glb"), FileFormat::glb);
  for (const char* bad : {"b", "b.fbx", "obj", ".obj", "b.obj.gz", ""}) {
    const Result<FileFormat> format = format_from_path(bad);
    ASSERT_FALSE(format) << bad;
    EXPECT_EQ(format.error().kind, ErrorKind::usage);
    EXPECT_EQ(format.error().remedy, "use .obj, .off, .ply, .stl, .gltf or .glb");
  }
}

TEST(Model, LoadNamesTheFile) {
  const fs::path folder = fs::path(::testing::TempDir()) / "wrapatlas_model_test";
  fs::create_directories(folder);
  const Result<Model> missing = load_model(folder / "no.obj");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().where, (folder / "no.obj").string());
  ASSERT_TRUE(write_file(folder / "bad.obj", "v 0 0\n"));
  const Result<Model> bad = load_model(folder / "bad.obj");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().where, (folder / "bad.obj").string() + ":1");
  ASSERT_TRUE(write_file(folder / "good.obj", kSquare));
  EXPECT_TRUE(load_model(folder / "good.obj"));
  fs::remove_all(folder);
}

TEST(Model, SaveToAnotherFormatKeepsCorners) {
  const Model model = square();
  for (const AtlasMesh& atlas : {torn_atlas(model.mesh), halved_atlas(model.mesh, 0.25)}) {
    const Mesh applied = apply_atlas(model.mesh, atlas);
    const Result<Model> ply = model_from(saved_bytes(model, atlas, ".ply"), FileFormat::ply);
    ASSERT_TRUE(ply) << ply.error().message();
    expect_same_corners(ply->mesh, applied, 1e-7);
    const Result<Model> obj =
        model_from(saved_bytes(*ply, identity_atlas(ply->mesh), ".obj"), FileFormat::obj);
    ASSERT_TRUE(obj) << obj.error().message();
    expect_same_corners(obj->mesh, ply->mesh);
  }
}

TEST(Model, FormatsThatCannotHoldUvsAreRefused) {
  const Model model = square();
  for (const char* ending : {".off", ".stl"}) {
    const std::string error = saved_bytes(model, identity_atlas(model.mesh), ending);
    EXPECT_NE(error.find("files cannot hold UVs; write .obj, .ply, .gltf or .glb"),
              std::string::npos)
        << error;
  }
  EXPECT_EQ(save_model(model, identity_atlas(model.mesh), "x.png").error().kind, ErrorKind::usage);
}

TEST(Model, FailedSaveLeavesTheOldFile) {
  const fs::path path = fs::path(::testing::TempDir()) / "wrapatlas_model_kept.obj";
  ASSERT_TRUE(write_file(path, "old"));
  const Model model = square();
  AtlasMesh atlas = identity_atlas(model.mesh);
  atlas.corner_texcoord[3] = 4;
  EXPECT_FALSE(save_model(model, atlas, path));
  EXPECT_EQ(*read_file(path), "old");
  fs::remove(path);
}

TEST(Model, AtlasesThatDoNotFitAreRefused) {
  const Mesh mesh = square().mesh;
  EXPECT_TRUE(check_fit(mesh, identity_atlas(mesh)));
  EXPECT_TRUE(check_fit(mesh, halved_atlas(mesh)));
  const auto expect_misfit = [&](AtlasMesh atlas, auto change) {
    change(atlas);
    const Status fits = check_fit(mesh, atlas);
    ASSERT_FALSE(fits);
    EXPECT_EQ(fits.error().kind, ErrorKind::check);
  };
  const AtlasMesh whole = identity_atlas(mesh), halved = halved_atlas(mesh);
  expect_misfit({}, [](AtlasMesh&) {});
  expect_misfit(whole, [](AtlasMesh& a) { a.corner_texcoord.pop_back(); });
  expect_misfit(whole, [](AtlasMesh& a) { a.corner_texcoord[0] = 4; });
  expect_misfit(whole, [](AtlasMesh& a) { a.corner_source[0] = 3; });
  expect_misfit(whole, [](AtlasMesh& a) { a.corner_source[0] = kNone; });
  expect_misfit(whole, [](AtlasMesh& a) { std::swap(a.corner_source[0], a.corner_source[1]); });
  expect_misfit(whole, [](AtlasMesh& a) { a.face_source = {1, 0}; });
  expect_misfit(whole, [](AtlasMesh& a) { a.face_source = {0, 0}; });
  expect_misfit(whole, [](AtlasMesh& a) { a.face_begin[1] = 4; });
  expect_misfit(halved, [](AtlasMesh& a) { a.cut_points.pop_back(); });
  expect_misfit(halved, [](AtlasMesh& a) { a.cut_points[0].corners[1] = 5; });
  expect_misfit(halved, [](AtlasMesh& a) { a.cut_points[0].position = a.cut_position_count; });
  expect_misfit(halved, [](AtlasMesh& a) {
    a.face_source[1] = 1;
    a.face_source[0] = 1;
  });
}

TEST(Model, ApplyAtlasInterpolatesAndSharesCutPoints) {
  const Mesh mesh = square().mesh;
  const Mesh applied = apply_atlas(mesh, halved_atlas(mesh, 0.25));
  EXPECT_EQ(applied.face_begin, (std::vector<std::uint32_t>{0, 3, 6, 9, 12}));
  EXPECT_EQ(applied.positions.size(), 6U);
  EXPECT_EQ(applied.positions[4], (Vec3{0.75, 0, 0}));
  EXPECT_EQ(applied.positions[5], (Vec3{1, 0.75, 0}));
  EXPECT_EQ(applied.corner_position,
            (std::vector<std::uint32_t>{0, 4, 2, 4, 1, 2, 1, 5, 2, 5, 3, 2}));
  EXPECT_TRUE(validate_mesh(applied));
}

TEST(Model, ObjectsGoWithTheirFaces) {
  Model model = square();
  model.mesh.face_object = {4, 1};
  EXPECT_EQ(apply_atlas(model.mesh, halved_atlas(model.mesh)).face_object,
            (std::vector<std::uint32_t>{4, 4, 1, 1}));
  model.source.reset();
  const Result<Model> obj =
      model_from(saved_bytes(model, identity_atlas(model.mesh), ".obj"), FileFormat::obj);
  ASSERT_TRUE(obj);
  EXPECT_EQ(obj->mesh.face_object, (std::vector<std::uint32_t>{0, 1}));
}

// The v axis of glTF points down: writing it as OBJ turns the atlas, chart by chart.
TEST(Model, TurnsTheVAxisBetweenFormats) {
  Model model = square();
  model.format = FileFormat::glb;
  model.v_points_down = true;
  model.source.reset();
  AtlasMesh atlas = torn_atlas(model.mesh);
  atlas.texcoords = {{0, 0.25}, {1, 0.5}, {0, 1.5}, {3, 0.125}, {3, 0.25}, {4, 0.125}};
  atlas.wrap = Wrap::none;
  const auto written_v = [&] {
    std::vector<double> v;
    const Result<Model> obj = model_from(saved_bytes(model, atlas, ".obj"), FileFormat::obj);
    for (const Vec2& uv : obj->mesh.texcoords) v.push_back(uv.y);
    return v;
  };
  EXPECT_EQ(written_v(), (std::vector<double>{0.75, 0.5, -0.5, 0.875, 0.75, 0.875}));
  atlas.wrap = Wrap::uv;
  EXPECT_EQ(written_v(), (std::vector<double>{1.75, 1.5, 0.5, 0.875, 0.75, 0.875}));
}

}  // namespace
}  // namespace wrapatlas
