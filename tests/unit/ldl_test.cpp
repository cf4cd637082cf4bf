// The sparse factor against the matrix it is of.
#include "parameterize/ldl.h"

#include <gtest/gtest.h>

#include "support/surfaces.h"

namespace wrapatlas {
namespace {

using test::uniform;

void randomise(std::mt19937_64& random, Complex& entry) {
  entry = {uniform(random, -1, 1), uniform(random, -1, 1)};
}
void randomise(std::mt19937_64& random, Block& entry) {
  for (double* part : {&entry.xx, &entry.xy, &entry.yx, &entry.yy}) *part = uniform(random, -1, 1);
}
void randomise(std::mt19937_64& random, Vec2& entry) {
  entry = {uniform(random, -1, 1), uniform(random, -1, 1)};
}
void set_diagonal(Complex& entry, double value) { entry = value; }
void set_diagonal(Block& entry, double value) { entry = {value, 0.3, 0.3, value}; }
double size_of(Complex entry) { return std::abs(entry); }
double size_of(Vec2 entry) { return length(entry); }

template <typename Entry, typename Unknown>
void expect_solved(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const test::Surface surface = test::bumpy(9, 0.1, seed);
  const auto disc = make_disc(surface.points, surface.triangles);
  ASSERT_TRUE(disc);
  std::vector<bool> unknown(surface.points.size());
  for (std::size_t p = 0; p < unknown.size(); ++p) unknown[p] = random() % 4 != 0;
  const Pattern pattern = make_pattern(*disc, elimination_order(*disc), unknown);
  std::vector<Entry> entries(pattern.row.size());
  for (Entry& entry : entries) randomise(random, entry);
  for (int k = 0; k < pattern.size(); ++k) set_diagonal(entries[pattern.diagonal(k)], 12);

  Ldl<Entry> ldl(pattern);
  const Entry kept = entries[pattern.diagonal(pattern.size() / 2)];
  set_diagonal(entries[pattern.diagonal(pattern.size() / 2)], -0.1);
  EXPECT_FALSE(ldl.factor(entries));
  set_diagonal(entries[pattern.diagonal(pattern.size() / 2)], std::nan(""));
  EXPECT_FALSE(ldl.factor(entries));
  entries[pattern.diagonal(pattern.size() / 2)] = kept;
  ASSERT_TRUE(ldl.factor(entries));

  std::vector<Unknown> x(pattern.size());
  for (Unknown& value : x) randomise(random, value);
  std::vector<Unknown> b(x.size());
  for (int k = 0; k < pattern.size(); ++k) {
    for (int e = pattern.begin[k]; e < pattern.begin[k + 1]; ++e) {
      const int i = pattern.row[e];
      b[i] = b[i] + times(entries[e], x[k]);
      if (i != k) b[k] = b[k] + times(adjoint(entries[e]), x[i]);
    }
  }
  ldl.solve(b);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LT(size_of(b[k] - x[k]), 1e-13);
}

TEST(Ldl, SolvesAndKnowsWhatIsNotPositive) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    expect_solved<Complex, Complex>(seed);
    expect_solved<Block, Vec2>(seed);
  }
}

}  // namespace
}  // namespace wrapatlas
