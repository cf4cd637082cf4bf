// The equations behind flattening, against slow ways to write them down.
#include "parameterize/labf.h"

#include <gtest/gtest.h>

#include "parameterize/layout.h"
#include "parameterize/pattern.h"
#include "support/dense_solve.h"
#include "support/surfaces.h"

namespace wrapatlas {
namespace {

using std::numbers::pi;
using test::bumpy;
using test::cap;
using test::Matrix;
using test::solve_slowly;
using test::Surface;

Disc disc_of(const Surface& surface) {
  auto disc = make_disc(surface.points, surface.triangles);
  EXPECT_TRUE(disc) << (disc ? "" : disc.error().message());
  return *disc;
}

/// All rows of the publication, in the errors e of the angles.
struct Rows {
  Matrix a;
  std::vector<double> b;
};
Rows all_rows(const Disc& disc, const std::vector<double>& angle) {
  Rows rows;
  const auto add = [&](double b) -> std::vector<double>& {
    rows.b.push_back(b);
    return rows.a.emplace_back(angle.size(), 0.0);
  };
  for (std::size_t t = 0; t < disc.triangles.size(); ++t) {
    auto& row = add(pi - angle[3 * t] - angle[3 * t + 1] - angle[3 * t + 2]);
    for (std::size_t i = 0; i < 3; ++i) row[3 * t + i] = 1;
  }
  for (std::uint32_t p = 0; p < disc.points.size(); ++p) {
    if (disc.on_border[p]) continue;
    double sum = 0, wheel = 0;
    std::vector<double> sum_row(angle.size()), wheel_row(angle.size());
    for (std::size_t t = 0; t < disc.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (disc.triangles[t][i] != p) continue;
        const std::size_t next = 3 * t + (i + 1) % 3, previous = 3 * t + (i + 2) % 3;
        sum += angle[3 * t + i];
        sum_row[3 * t + i] = 1;
        wheel += std::log(std::sin(angle[next])) - std::log(std::sin(angle[previous]));
        wheel_row[next] = 1 / std::tan(angle[next]);
        wheel_row[previous] = -1 / std::tan(angle[previous]);
      }
    }
    add(2 * pi - sum) = sum_row;
    add(-wheel) = wheel_row;
  }
  return rows;
}

/// e of least sum of (e / gamma)^2: x = A'^T (A' A'^T)^-1 b with A' = A diag(gamma).
std::vector<double> angles_slowly(const Disc& disc, const std::vector<double>& gamma) {
  Rows rows = all_rows(disc, gamma);
  for (auto& row : rows.a) {
    for (std::size_t c = 0; c < gamma.size(); ++c) row[c] *= gamma[c];
  }
  const std::size_t n = rows.b.size();
  Matrix normal(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t c = 0; c < gamma.size(); ++c) normal[i][j] += rows.a[i][c] * rows.a[j][c];
    }
  }
  const std::vector<double> y = solve_slowly(normal, rows.b);
  std::vector<double> alpha = gamma;
  for (std::size_t c = 0; c < gamma.size(); ++c) {
    double x = 0;
    for (std::size_t i = 0; i < n; ++i) x += rows.a[i][c] * y[i];
    alpha[c] = gamma[c] * (1 + x);
  }
  return alpha;
}

TEST(Labf, IsTheLeastNormSolutionOfAllRows) {
  for (const Surface& surface : {bumpy(4, 0.1, 1), bumpy(5, 0.2, 2), cap(4, 1.4), bumpy(1, 1, 3)}) {
    const Disc disc = disc_of(surface);
    const std::vector<std::uint32_t> order = elimination_order(disc);
    std::vector<double> slow = corner_angles(disc);
    for (int iterations = 1; iterations <= 3; ++iterations) {
      slow = angles_slowly(disc, slow);
      const auto fast = flat_angles(disc, order, iterations);
      ASSERT_TRUE(fast);
      ASSERT_EQ(fast->angles.size(), slow.size());
      for (std::size_t c = 0; c < slow.size(); ++c) EXPECT_NEAR(fast->angles[c], slow[c], 1e-10);
      double wheel = 0;
      const Rows rows = all_rows(disc, slow);
      for (std::size_t r = disc.triangles.size() + 1; r < rows.b.size(); r += 2) {
        wheel = std::max(wheel, std::abs(rows.b[r]));
      }
      EXPECT_NEAR(fast->wheel_residual, wheel, 1e-10);
    }
  }
}

TEST(Labf, AnglesAreThoseOfAFlatDisc) {
  for (const Surface& surface : {cap(20, 1.5), bumpy(20, 0.2, 7)}) {
    const Disc disc = disc_of(surface);
    const std::vector<std::uint32_t> order = elimination_order(disc);
    const auto flat = flat_angles(disc, order, 4);
    ASSERT_TRUE(flat);
    for (const double row : all_rows(disc, flat->angles).b) EXPECT_NEAR(row, 0, 1e-11);
    // And the layout has them.
    const auto uv = lay_out(disc, order, shapes_of_angles(flat->angles));
    ASSERT_TRUE(uv);
    for (std::size_t t = 0; t < disc.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 p = (*uv)[disc.triangles[t][i]];
        const Vec2 a = (*uv)[disc.triangles[t][(i + 1) % 3]] - p;
        const Vec2 b = (*uv)[disc.triangles[t][(i + 2) % 3]] - p;
        EXPECT_NEAR(std::atan2(cross(a, b), dot(a, b)), flat->angles[3 * t + i], 1e-8);
      }
    }
  }
}

/// Of the map from space to the plane, as the paper on LSCM has it: the integral of
/// |dU/dx + i dU/dy|^2 over the triangles, each in coordinates of its own.
double conformal_energy(const Disc& disc, const std::vector<Vec2>& uv) {
  double energy = 0;
  for (const auto& [i, j, k] : disc.triangles) {
    const Vec3 a = disc.points[j] - disc.points[i], b = disc.points[k] - disc.points[i];
    const double x1 = length(a), x2 = dot(a, b) / x1, y2 = length(cross(a, b)) / x1;
    const Vec2 u = uv[j] - uv[i], v = uv[k] - uv[i];
    const Vec2 by_x = (1 / x1) * u, by_y = (1 / y2) * (v - x2 * by_x);
    const Vec2 sum = by_x + Vec2{-by_y.y, by_y.x};
    energy += dot(sum, sum) * x1 * y2 / 2;
  }
  return energy;
}

TEST(Lscm, NoPointButThePinnedCanMakeItMoreConformal) {
  for (const Surface& surface : {cap(7, 1.4), bumpy(8, 0.2, 9)}) {
    const Disc disc = disc_of(surface);
    auto uv = lay_out(disc, elimination_order(disc), shapes_in_space(disc));
    ASSERT_TRUE(uv);
    int steep = 0;
    for (std::size_t p = 0; p < uv->size(); ++p) {
      double slope = 0;
      for (double Vec2::*axis : {&Vec2::x, &Vec2::y}) {
        const double before = (*uv)[p].*axis, step = 1e-4;  // exact: the energy is quadratic
        (*uv)[p].*axis = before + step;
        const double more = conformal_energy(disc, *uv);
        (*uv)[p].*axis = before - step;
        const double less = conformal_energy(disc, *uv);
        (*uv)[p].*axis = before;
        slope += std::abs(more - less) / (2 * step);
      }
      if (slope > 1e-9) {
        ++steep;
        EXPECT_TRUE(disc.on_border[p]);
        EXPECT_GT(slope, 1e-5);
      }
    }
    EXPECT_EQ(steep, 2);
  }
}

TEST(EliminationOrder, HasEachPointOnce) {
  const Surface surface = bumpy(13, 0.1, 4);
  const Disc disc = disc_of(surface);
  std::vector<std::uint32_t> order = elimination_order(disc);
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), disc.points.size());
  for (std::uint32_t p = 0; p < order.size(); ++p) EXPECT_EQ(order[p], p);
}

}  // namespace
}  // namespace wrapatlas
