// Pieces so thin that their area drowns in the rounding of positions: they are legal, and judged.
#include <algorithm>
#include <functional>
#include <tuple>

#include "unit/validate_helpers.h"

namespace wrapatlas {
namespace {

// So far from the origin floats tell a place to 0.0048 units, which is 0.048 texels here.
constexpr double kFar = 80000;
constexpr double kThinner = 0.04, kThicker = 0.06;  // texels

Vec3 in_space(double x, double y) {
  const volatile float stored_x = static_cast<float>(kFar + x / 10);
  const volatile float stored_y = static_cast<float>(y / 10);
  return {stored_x, stored_y, 0};
}

/// A strip of a face, from y = low to high of the plane in space, at (x, y) in the texture.
void strip(Builder& b, double low, double high, Vec2 at) {
  b.face(
      {{at.x, at.y}, {at.x + 40, at.y}, {at.x + 40, at.y + high - low}, {at.x, at.y + high - low}},
      {in_space(0, low), in_space(40, low), in_space(40, high), in_space(0, high)});
}

/// Two rectangles that share the side y = 10 in the plane, but not in the texture.
Mesh two_strips() {
  Builder b;
  strip(b, 0, 10, {0, 0});
  strip(b, 10, 20, {10, 40});
  return b.mesh;
}

/// Where the sliver comes among the pieces of two_strips(), and of which of them it is.
enum class Sliver { last_of_first, first_of_first, first_of_second, last_of_second };
Mesh cut_strips(Sliver which, double thin,
                const std::function<void(Builder&, double, double, Vec2)>& sliver) {
  Builder b;
  const bool first = which == Sliver::last_of_first || which == Sliver::first_of_first;
  const bool leads = which == Sliver::first_of_first || which == Sliver::first_of_second;
  const double low = first ? 0 : 10, high = low + 10, x = first ? 0 : 10;
  if (!first) strip(b, 0, 10, {0, 20});
  if (leads) {
    sliver(b, low, low + thin, {x, 64 - thin});
    strip(b, low + thin, high, {x, 0});
  } else {
    strip(b, low, high - thin, {x, 54 + thin});
    sliver(b, high - thin, high, {x, 0});
  }
  if (first) strip(b, 10, 20, {0, 20});
  return b.mesh;
}

bool finds(const Mesh& atlas, Violation kind, bool stacked_ok = false) {
  CheckOptions options = options_of();
  options.stacked_ok = stacked_ok;
  const Mesh reference = two_strips();
  const CheckReport report = check(atlas, options, &reference);
  return std::any_of(report.findings.begin(), report.findings.end(),
                     [kind](const Finding& finding) { return finding.kind == kind; });
}

class ValidateSliver : public ::testing::TestWithParam<std::tuple<Sliver, double>> {
 protected:
  Mesh atlas(const std::function<void(Builder&, double, double, Vec2)>& sliver) const {
    return cut_strips(std::get<0>(GetParam()), std::get<1>(GetParam()), sliver);
  }
};

INSTANTIATE_TEST_SUITE_P(
    Places, ValidateSliver,
    ::testing::Combine(::testing::Values(Sliver::last_of_first, Sliver::first_of_first,
                                         Sliver::first_of_second, Sliver::last_of_second),
                       ::testing::Values(kThinner, kThicker)));

TEST_P(ValidateSliver, IsAPieceOfTheFaceItWasCutOff) {
  const Mesh reference = two_strips();
  for (const Wrap wrap : {Wrap::none, Wrap::uv}) {
    const CheckReport report = check(atlas(strip), options_of(wrap, 1), &reference);
    EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.findings[0].text);
    EXPECT_EQ(report.charts, 2U);
  }
}

TEST_P(ValidateSliver, Missing) {
  const Mesh without = atlas([](Builder&, double, double, Vec2) {});
  // Where even the corners count as the same, it is they that are not where they should be.
  const bool thinner = std::get<1>(GetParam()) == kThinner;
  EXPECT_TRUE(finds(without, thinner ? Violation::not_similar : Violation::missing_face));
}

TEST_P(ValidateSliver, Doubled) {
  const Mesh reference = two_strips();
  const Mesh twice = atlas([](Builder& b, double low, double high, Vec2 at) {
    strip(b, low, high, at);
    strip(b, low, high, at);
  });
  for (const bool stacked_ok : {false, true}) {
    CheckOptions options = options_of();
    options.stacked_ok = stacked_ok;
    const auto report = check_atlas(twice, &reference, options);
    EXPECT_FALSE(report && report->ok());
    if (std::get<0>(GetParam()) != Sliver::first_of_first) continue;
    EXPECT_TRUE(finds(twice, Violation::self_overlap, stacked_ok));  // no other face can have it
  }
}

TEST_P(ValidateSliver, WrongTexcoords) {
  const auto changed = [&](const std::function<void(Vec2&, Vec2)>& change) {
    return atlas([&](Builder& b, double low, double high, Vec2 at) {
      strip(b, low, high, at);
      for (std::size_t c = b.mesh.texcoords.size() - 4; c < b.mesh.texcoords.size(); ++c) {
        change(b.mesh.texcoords[c], at);
      }
    });
  };
  EXPECT_TRUE(finds(changed([](Vec2& uv, Vec2) { uv.x += 3.0 / 64; }), Violation::not_similar));
  EXPECT_TRUE(finds(changed([](Vec2& uv, Vec2 at) { uv.x = (2 * at.x + 40) / 64 - uv.x; }),
                    Violation::not_similar));
  const Mesh without = atlas([](Builder& b, double low, double high, Vec2 at) {
    strip(b, low, high, at);
    b.mesh.corner_texcoord.back() = kNone;
  });
  EXPECT_TRUE(finds(without, Violation::missing_face));
}

TEST_P(ValidateSliver, MovedInSpaceIsNoPart) {
  const Mesh reference = two_strips();
  const Mesh moved_away = atlas([](Builder& b, double low, double high, Vec2 at) {
    strip(b, low, high, at);
    for (std::size_t c = b.mesh.positions.size() - 4; c < b.mesh.positions.size(); ++c) {
      b.mesh.positions[c].z += 0.1;
    }
  });
  EXPECT_FALSE(check_atlas(moved_away, &reference, options_of()));
}

TEST(ValidateSlivers, OfAFaceThatIsThereTwice) {
  Builder reference, atlas;
  for (const double y : {0.0, 20.0}) {
    strip(reference, 0, 10, {0, y});
    strip(atlas, 0, kThinner, {y, 64 - kThinner});
    strip(atlas, kThinner, 10, {y, 0});
  }
  CheckOptions options = options_of();  // the charts lie on each other's lower and upper half
  EXPECT_EQ(kinds(check(atlas.mesh, options, &reference.mesh)), Kinds{Violation::overlap});
  Mesh apart = atlas.mesh;
  for (std::size_t c = 8; c < 16; ++c) {
    Vec2& uv = apart.texcoords[c];
    uv = {uv.x - 20.0 / 64, c < 12 ? uv.y - 32.0 / 64 : uv.y + 32.0 / 64};
  }
  EXPECT_TRUE(check(apart, options, &reference.mesh).ok());
}

TEST(ValidateSlivers, ThinFacesOfTheReferenceKeepTheirPlace) {
  Builder b;  // the second face has no area in space, the third none at all
  const auto add_rest = [](Builder& to) {
    to.face({{0, 30}, {40, 30}, {20, 50}}, {in_space(0, 10), in_space(40, 10), in_space(20, 10)});
    to.face({{50, 50}, {50, 50}, {50, 50}}, {in_space(40, 10), in_space(40, 10), in_space(40, 10)});
  };
  strip(b, 0, 10, {0, 0});
  add_rest(b);
  strip(b, 10, 20, {0, 15});
  Builder cut;
  strip(cut, 0, 10 - kThinner, {0, 54 + kThinner});
  strip(cut, 10 - kThinner, 10, {0, 0});
  add_rest(cut);
  strip(cut, 10, 20, {0, 15});
  const CheckReport report = check(cut.mesh, options_of(), &b.mesh);
  EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.findings[0].text);
  Mesh without = cut.mesh;  // the third face of the reference has lost its UVs
  without.corner_texcoord[8] = kNone;
  EXPECT_EQ(kinds(check(without, options_of(), &b.mesh)), Kinds{Violation::missing_face});
}

TEST(ValidateSlivers, ManyOnOnePointTakeNoTime) {
  const std::size_t count = 40000;
  Builder reference, atlas;
  const Vec3 at = in_space(0, 0);
  for (std::size_t i = 0; i < count; ++i) {
    reference.face({{1, 1}, {1, 1}, {1, 1}}, {at, at, at});
    atlas.face({{1, 1}, {1, 1}, {1, 1}, {1, 1}}, {at, at, at, at});
  }
  for (Mesh* mesh : {&reference.mesh, &atlas.mesh}) {
    std::fill(mesh->corner_texcoord.begin(), mesh->corner_texcoord.end(), kNone);
  }
  EXPECT_TRUE(check_atlas(atlas.mesh, &reference.mesh, options_of()));
}

}  // namespace
}  // namespace wrapatlas
