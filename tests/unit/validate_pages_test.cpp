// The judge on an atlas of several pages, laid out by hand.
#include "validate_helpers.h"

namespace wrapatlas {
namespace {

CheckOptions pages_of(int pages, Wrap wrap = Wrap::none, double padding = 0) {
  CheckOptions options = options_of(wrap, padding);
  options.pages = pages;
  return options;
}

TEST(ValidatePages, ChartsOfDifferentPagesDoNotMeet) {
  Builder atlas;
  atlas.box(10, 10, 20, 20);
  atlas.box(64 + 10, 10, 20, 20);
  atlas.box(10, 64 + 10, 20, 20);
  for (const Wrap wrap : {Wrap::none, Wrap::u, Wrap::uv}) {
    const CheckReport report = check(atlas.mesh, pages_of(11, wrap, 2));
    EXPECT_TRUE(report.ok());
    EXPECT_EQ(report.pages, 3U);
    EXPECT_DOUBLE_EQ(report.efficiency, 20.0 * 20 / (64 * 64));
  }
  EXPECT_FALSE(check(atlas.mesh, options_of(Wrap::uv)).ok());
}

TEST(ValidatePages, ChartsOfOnePageDo) {
  Builder atlas;
  atlas.box(3 * 64 + 10, 10, 20, 20);
  atlas.box(10, 10, 20, 20);
  atlas.box(3 * 64 + 25, 20, 20, 20);
  const CheckReport report = check(atlas.mesh, pages_of(4));
  EXPECT_EQ(kinds(report), std::vector{Violation::overlap});
  EXPECT_EQ(report.findings[0].chart_a, 0U);
  EXPECT_EQ(report.findings[0].chart_b, 2U);
  EXPECT_EQ(report.findings[0].face_b, 2U);
  EXPECT_NE(report.findings[0].text.find("on page 3"), std::string::npos);
}

TEST(ValidatePages, AChartThatCrossesTheBorderStaysOnItsPage) {
  Builder atlas;
  atlas.box(64 + 50, 10, 20, 20);   // page 1, and on at its left
  atlas.box(64 + 2, 15, 8, 8);      // what it runs into
  atlas.box(2 * 64 + 2, 15, 8, 8);  // the next page's charts are not in its way
  const CheckReport report = check(atlas.mesh, pages_of(3, Wrap::u));
  ASSERT_EQ(kinds(report), std::vector{Violation::overlap});
  EXPECT_EQ(report.findings[0].chart_b, 1U);
  EXPECT_NE(report.findings[0].text.find("across the border"), std::string::npos);
}

TEST(ValidatePages, SidesAreThoseOfThePage) {
  Builder atlas;
  atlas.box(64 + 50, 10, 20, 20);
  atlas.box(1, 64 * 2 + 10, 20, 20);
  CheckOptions options = pages_of(30);
  options.margin = 2;
  EXPECT_EQ(kinds(check(atlas.mesh, options)), (std::vector{Violation::bounds, Violation::margin}));
}

TEST(ValidatePages, OtherTilesAreNoPages) {
  for (const Vec2 tile : {Vec2{2, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}, Vec2{10, 0}}) {
    Builder atlas;
    atlas.box(10, 10, 20, 20);
    atlas.box(64 * tile.x + 10, 64 * tile.y + 10, 20, 20);
    for (const Wrap wrap : {Wrap::none, Wrap::uv}) {
      EXPECT_EQ(kinds(check(atlas.mesh, pages_of(2, wrap))), std::vector{Violation::bounds});
    }
  }
}

TEST(ValidatePages, RowsGoUpWhereVPointsDown) {
  Builder atlas;
  atlas.box(10, 10, 20, 20);
  atlas.box(10, -64 + 10, 20, 20);
  CheckOptions options = pages_of(20);
  options.v_points_down = true;
  EXPECT_TRUE(check(atlas.mesh, options).ok());
  options.v_points_down = false;
  EXPECT_EQ(kinds(check(atlas.mesh, options)), std::vector{Violation::bounds});
}

TEST(ValidatePages, AHairBelowATileIsRounding) {
  Builder atlas;
  atlas.box(64 - 1e-6, 10, 20, 20);
  EXPECT_TRUE(check(atlas.mesh, pages_of(2)).ok());
  EXPECT_EQ(check(atlas.mesh, pages_of(2)).pages, 1U);
}

TEST(ValidatePages, ChartsAreComparedWithTheReferenceWhereverTheyAre) {
  Builder reference, atlas, doubled;
  const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> other{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
  const auto box = [](double x, double y, double side) {
    return std::vector<Vec2>{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  };
  reference.face(box(0, 0, 20), flat);
  reference.face(box(30, 0, 20), other);
  atlas.face(box(5, 5, 30), flat);
  atlas.face(box(64 * 3 + 5, 64 * 2 + 5, 30), other);
  EXPECT_TRUE(check(atlas.mesh, pages_of(24), &reference.mesh).ok());
  doubled.face(box(5, 5, 30), flat);
  doubled.face(box(64 * 3 + 5, 64 * 2 + 5, 40), other);
  EXPECT_EQ(kinds(check(doubled.mesh, pages_of(24), &reference.mesh)),
            std::vector{Violation::scale});
}

TEST(ValidatePages, OptionsNeedAPage) {
  Builder atlas;
  atlas.box(1, 1, 2, 2);
  EXPECT_FALSE(check_atlas(atlas.mesh, nullptr, pages_of(0)));
}

}  // namespace
}  // namespace wrapatlas
