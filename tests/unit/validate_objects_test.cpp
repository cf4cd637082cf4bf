// Atlases judged where objects lie at one place.
#include "unit/validate_helpers.h"

namespace wrapatlas {
namespace {

const std::vector<Vec3> kSpace{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
const std::vector<Vec3> kBeside{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
using Objects = std::vector<std::uint32_t>;

std::vector<Vec2> triangle(double x, double y) { return {{x, y}, {x + 10, y}, {x + 10, y + 10}}; }
std::vector<Vec2> beside(double x, double y) {
  return {{x + 10, y}, {x + 20, y}, {x + 10, y + 10}};
}

/// Two faces at one place in space, of these objects.
Mesh twins(Vec2 first, Vec2 second, Objects objects) {
  Builder b;
  b.face(triangle(first.x, first.y), kSpace);
  b.face(triangle(second.x, second.y), kSpace);
  b.mesh.face_object = std::move(objects);
  return b.mesh;
}

/// Two faces that share an edge.
Mesh neighbours(Vec2 first, Vec2 second, Objects objects) {
  Builder b;
  b.face(triangle(first.x, first.y), kSpace);
  b.face(beside(second.x, second.y), kBeside);
  b.mesh.face_object = std::move(objects);
  return b.mesh;
}

TEST(ValidateObjects, AreChartsOfTheirOwn) {
  const CheckOptions options = options_of(Wrap::none, 2);
  const CheckReport one = check(neighbours({5, 5}, {5, 5}, {}), options);
  EXPECT_TRUE(one.ok());
  EXPECT_EQ(one.charts, 1U);
  const CheckReport two = check(neighbours({5, 5}, {5, 5}, {0, 1}), options);
  EXPECT_EQ(two.charts, 2U);
  EXPECT_EQ(kinds(two), Kinds{Violation::gap});
}

TEST(ValidateObjects, OfTheReferenceCountAndNotThoseOfTheAtlas) {
  const CheckOptions options = options_of(Wrap::none, 2);
  const Mesh apart = twins({5, 5}, {5, 5}, {0, 1}), joined = twins({5, 5}, {5, 5}, {});
  for (const Objects& objects : {Objects{}, Objects{0, 1}, Objects{3, 3}}) {
    const Mesh atlas = twins({5, 5}, {30, 5}, objects);
    const CheckReport report = check(atlas, options, &apart);
    EXPECT_TRUE(report.ok()) << report.findings[0].text;
    EXPECT_EQ(report.charts, 2U);
    EXPECT_EQ(kinds(check(atlas, options, &joined)), Kinds{Violation::not_similar});
  }
}

TEST(ValidateObjects, OfTheAtlasAloneTearNoChart) {
  const Mesh reference = neighbours({5, 5}, {5, 5}, {});
  const CheckReport whole =
      check(neighbours({20, 5}, {20, 5}, {0, 1}), options_of(Wrap::none, 2), &reference);
  EXPECT_TRUE(whole.ok()) << whole.findings[0].text;
  EXPECT_EQ(whole.charts, 1U);
  EXPECT_EQ(kinds(check(neighbours({20, 5}, {25, 5}, {0, 1}), options_of(), &reference)),
            Kinds{Violation::not_similar});
}

TEST(ValidateObjects, StackedInAnAtlasThatHasLostThem) {
  const Mesh reference = twins({5, 5}, {5, 5}, {0, 1}), atlas = twins({9, 5}, {9, 5}, {});
  CheckOptions options = options_of(Wrap::uv, 2);
  EXPECT_EQ(kinds(check(atlas, options, &reference)), Kinds{Violation::overlap});
  options.stacked_ok = true;
  const CheckReport report = check(atlas, options, &reference);
  EXPECT_TRUE(report.ok()) << report.findings[0].text;
  EXPECT_EQ(report.charts, 2U);
}

TEST(ValidateObjects, FacesObjectByObjectAnswerToo) {
  const auto space = [](double z) {
    std::vector<Vec3> points = kSpace;
    for (Vec3& p : points) p.z = z;
    return points;
  };
  const Objects object_of{1, 0, 1, 0};  // and face 0 has no UVs
  const auto mesh = [&](const std::vector<int>& order, bool with_objects, double x) {
    Builder b;
    for (const int face : order) {
      b.face(triangle(x + 12 * face, 5), space(face));
      if (with_objects) b.mesh.face_object.push_back(object_of[static_cast<std::size_t>(face)]);
      if (face != 0) continue;
      for (std::size_t c = b.mesh.corner_count() - 3; c < b.mesh.corner_count(); ++c) {
        b.mesh.corner_texcoord[c] = kNone;
      }
    }
    return b.mesh;
  };
  const Mesh reference = mesh({0, 1, 2, 3}, true, 1);
  for (const double x : {1.0, 3.0}) {
    const CheckReport report =  // as a glTF has them
        check(mesh({2, 0, 1, 3}, true, x), options_of(Wrap::none, 1), &reference);
    EXPECT_TRUE(report.ok()) << report.findings[0].text;
    EXPECT_EQ(report.faces_without_uv, 1U);
    EXPECT_EQ(report.charts, 3U);
  }
  EXPECT_FALSE(check_atlas(mesh({2, 0, 3, 1}, false, 1), &reference, options_of()))
      << "but not in any order";
}

TEST(ValidateObjects, FacesThatAreThereTwice) {
  const Mesh reference = twins({5, 5}, {5, 5}, {});
  const CheckReport report = check(twins({9, 5}, {9, 5}, {}), options_of(), &reference);
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.remarks.size(), 1U) << "they lie on each other as they did";
  Mesh lost = reference;
  lost.face_begin.pop_back();
  lost.corner_position.resize(3);
  lost.corner_texcoord.resize(3);
  EXPECT_EQ(kinds(check(lost, options_of(), &reference)), Kinds{Violation::missing_face});
}

}  // namespace
}  // namespace wrapatlas
