// A layout from angles: each triangle says where its third corner lies as seen from the others, and
// all are met as nearly as can be. With a mesh's own angles these are least squares conformal maps:
// Levy, Petitjean, Ray & Maillot (SIGGRAPH 2002), here as Zayer, Levy & Seidel (SGP 2007), section
// 4, have it, with points as complex numbers.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <complex>
#include <numbers>

#include "parameterize/angles.h"

namespace wrapatlas {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::SparseMatrix<Complex>;
using Solver = Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>>;

/// Two points of the border that lie far apart.
std::array<std::uint32_t, 2> far_points(std::span<const Vec3> points,
                                        const std::vector<bool>& is_border) {
  const auto farthest = [&](const Vec3& from) {
    std::uint32_t best = kNone;
    double most = -1;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      const double way = length(points[p] - from);
      if (!is_border[p] || way <= most) continue;
      most = way;
      best = p;
    }
    return best;
  };
  const std::uint32_t one = farthest(points[0]);
  std::uint32_t other = farthest(points[one]);
  for (std::uint32_t p = 0; other == one && p < points.size(); ++p) {
    if (is_border[p] && p != one) other = p;  // all at one place
  }
  return {one, other};
}

/// weight * (U2 - (1 - z) U0 - z U1) = 0, corner 2 being the one of the largest sine.
struct Row {
  std::array<std::uint32_t, 3> at{};
  std::array<Complex, 3> factor;
};

Row row_of(const Triangle& triangle, const Angles& angles, double weight) {
  std::size_t largest = 0;
  for (const std::size_t i : {1U, 2U}) {
    if (std::sin(angles[i]) > std::sin(angles[largest])) largest = i;
  }
  const std::size_t i0 = (largest + 1) % 3, i1 = (largest + 2) % 3;
  const Complex z = std::polar(std::sin(angles[i1]) / std::sin(angles[largest]), angles[i0]);
  return {{triangle[i0], triangle[i1], triangle[largest]},
          {weight * (z - 1.0), -weight * z, Complex(weight)}};
}

}  // namespace

std::vector<Vec2> lay_out(std::span<const Vec3> points, std::span<const Triangle> triangles,
                          std::span<const Angles> angles, const std::vector<bool>& is_border) {
  const auto [one, other] = far_points(points, is_border);
  std::vector<int> number(points.size(), -1);
  int count = 0;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    if (p != one && p != other) number[p] = count++;
  }
  double area = 0;
  for (const Triangle& t : triangles) area += triangle_area(points, t);
  const double least = area > 0 ? 1e-6 * area / double(triangles.size()) : 1;

  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(6 * triangles.size());
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(count);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const double weight = std::sqrt(std::max(least, triangle_area(points, triangles[t])));
    const Row row = row_of(triangles[t], angles[t], weight);
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = number[row.at[i]];
      if (a < 0) continue;
      for (std::size_t j = 0; j < 3; ++j) {
        const Complex value = std::conj(row.factor[i]) * row.factor[j];
        const int b = number[row.at[j]];
        if (b >= 0 && b <= a) entries.emplace_back(a, b, value);
        if (row.at[j] == other) right[a] -= value;  // which lies at 1, the one at 0
      }
    }
  }
  Matrix system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXcd solution(count);
  if (count > 0) {
    const Solver solver(system);
    if (solver.info() != Eigen::Success) return {};
    solution = solver.solve(right);
  }
  std::vector<Vec2> plane(points.size());
  plane[other] = {1, 0};
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (number[p] < 0) continue;
    const Complex at = solution[number[p]];
    if (!std::isfinite(at.real()) || !std::isfinite(at.imag())) return {};
    plane[p] = {at.real(), at.imag()};
  }
  return plane;
}

}  // namespace wrapatlas
