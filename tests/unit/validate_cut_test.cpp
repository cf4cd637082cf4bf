// Atlases cut at the border, judged without the mesh they came from; sides that were cut at.
#include "validate_helpers.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/model.h"

namespace wrapatlas {
namespace {

using Kinds = std::vector<Violation>;

/// A strip across the left and right sides, in two pieces 64 texels apart, at the given heights.
Builder strip_in_two(double left_y, double right_y) {
  Builder b;
  b.face({{58, left_y}, {64, left_y}, {64, left_y + 8}, {58, left_y + 8}},
         {{0, 0, 0}, {6, 0, 0}, {6, 8, 0}, {0, 8, 0}});
  b.face({{0, right_y}, {6, right_y}, {6, right_y + 8}, {0, right_y + 8}},
         {{6, 0, 0}, {12, 0, 0}, {12, 8, 0}, {6, 8, 0}});
  return b;
}

TEST(ValidateCut, PiecesThatFitTogetherAreOneChart) {
  const Builder cut = strip_in_two(20, 20), apart = strip_in_two(20, 21);
  EXPECT_EQ(check(cut.mesh, options_of()).charts, 1U);
  EXPECT_EQ(check(cut.mesh, options_of(Wrap::u, 8)).violations, 0U);
  EXPECT_EQ(check(cut.mesh, options_of(Wrap::u, 8)).charts, 1U);
  EXPECT_EQ(check(apart.mesh, options_of()).charts, 2U);
  EXPECT_NE(kinds(check(apart.mesh, options_of(Wrap::u, 8))), Kinds{});
}

TEST(ValidateCut, PiecesOweEachOtherNoPaddingButMustNotOverlap) {
  Builder b = strip_in_two(20, 20);
  // A third piece goes on from the second, and comes back to within a texel of the first.
  b.face({{6, 20}, {57, 20}, {57, 28}, {6, 28}}, {{12, 0, 0}, {63, 0, 0}, {63, 8, 0}, {12, 8, 0}});
  const CheckReport near = check(b.mesh, options_of(Wrap::none, 4));
  EXPECT_EQ(near.charts, 1U);
  EXPECT_TRUE(near.ok());
  for (Vec2& uv : b.mesh.texcoords) {
    if (uv.x == 57.0 / 64) uv.x = 60.0 / 64;
  }
  EXPECT_EQ(kinds(check(b.mesh, options_of(Wrap::none, 4))), Kinds{Violation::self_overlap});
  // Other charts are owed the padding as ever.
  Builder other = strip_in_two(20, 20);
  other.box(58, 30, 4, 4);
  EXPECT_TRUE(check(other.mesh, options_of(Wrap::none, 2)).ok());
  EXPECT_EQ(kinds(check(other.mesh, options_of(Wrap::none, 2.5))), Kinds{Violation::gap});
}

TEST(ValidateCut, ABandAroundACylinderIsOneChart) {
  Builder b;
  b.face({{0, 20}, {64, 20}, {64, 30}, {0, 30}}, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}});
  EXPECT_EQ(check(b.mesh, options_of(Wrap::none, 4)).charts, 1U);
}

TEST(ValidateCut, MarginOfTheAxisThatWasNotCut) {
  Builder b = strip_in_two(1, 1);
  CheckOptions options = options_of();
  options.margin = 2;
  EXPECT_EQ(kinds(check(b.mesh, options)), Kinds{Violation::margin});
  options.cut = Wrap::u;
  const CheckReport report = check(b.mesh, options);
  ASSERT_EQ(kinds(report), Kinds{Violation::margin});
  EXPECT_DOUBLE_EQ(report.findings[0].amount, 1);
  EXPECT_TRUE(check(strip_in_two(2, 2).mesh, options).ok());
  // To be cut at a side is no leave to cross it.
  Builder out;
  out.box(-3, 20, 10, 10);
  EXPECT_EQ(kinds(check(out.mesh, options)), Kinds{Violation::bounds});
}

TEST(ValidateCut, GapsAreKnownUpToTheReach) {
  Builder b;
  b.box(0, 0, 10, 10);
  b.box(12, 0, 10, 10);
  const CheckReport near = check(b.mesh, options_of(Wrap::none, 1.5));
  EXPECT_DOUBLE_EQ(near.smallest_gap, 2);
  EXPECT_GT(near.gap_reach, near.smallest_gap);
  const CheckReport far = check(b.mesh, options_of(Wrap::none, 0.25));
  EXPECT_DOUBLE_EQ(far.smallest_gap, far.gap_reach);
  EXPECT_LT(far.gap_reach, 2);
}

}  // namespace
}  // namespace wrapatlas
