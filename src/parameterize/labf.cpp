// Zayer, Lévy & Seidel 2007, Linear angle based parameterization (SGP 2007).
//
// Unknown is the relative change x of each angle: alpha = gamma (1 + x), and the sum of x^2 is to
// be least. The angles are subject to
//   triangle        sum of alpha = pi
//   inner point     sum of alpha around it = 2 pi
//   its wheel       sum of log sin(next) - log sin(previous) = 0 over the triangles around it,
//   where
//                   next and previous are the other two corners; to first order in alpha - gamma.
// What differs:
// - The publication solves A A^T y = b for all rows. The triangles' block of A A^T is diagonal, so
// we
//   eliminate it triangle by triangle and factor what is left, two rows for each inner point.
// - We repeat from the angles found, which makes the error of the wheels, 1e-4 to 1e-2 after one
//   solve, fall quadratically.
// - Small angles are taken as they are. Clamped to 3 degrees and more, as is usual, flat charts of
//   long triangles would not stay as they are. Only triangles of no area are clamped.
#include "parameterize/labf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "parameterize/eigen.h"
#include "parameterize/pattern.h"

namespace wrapatlas {
namespace {

using std::numbers::pi;

/// A triangle with a smaller angle than this counts as one of no area, whose angles say nothing.
/// Its angles are clamped, so that logarithms of their sines are no worse than others'.
constexpr double kNoAngle = 0.01 * pi / 180;
constexpr double kLeastAngle = 3 * pi / 180, kGreatestAngle = 175 * pi / 180;

/// Where no row is farther off than this there is nothing to solve.
constexpr double kSolved = 1e-13;

using Vector3 = std::array<double, 3>;
double dot3(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// What the rows have of one triangle's corners.
struct Local {
  Vector3 triangle;              ///< its own row
  std::array<Vector3, 3> sum;    ///< of each corner's point: sum of angles
  std::array<Vector3, 3> wheel;  ///< of each corner's point: wheel
};

Local local_rows(const double* angle) {
  Local local{};
  Vector3 slope{};  // of log sin alpha in x
  for (std::size_t i = 0; i < 3; ++i) {
    local.triangle[i] = local.sum[i][i] = angle[i];
    slope[i] = angle[i] * std::cos(angle[i]) / std::sin(angle[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    local.wheel[i][next3(i)] = slope[next3(i)];
    local.wheel[i][prev3(i)] = -slope[prev3(i)];
  }
  return local;
}

class AngleSystem {
 public:
  AngleSystem(const Disc& disc, std::span<const std::uint32_t> order) : disc_(disc) {
    std::vector<bool> inner = disc.on_border;
    inner.flip();
    pattern_ = make_pattern(disc, order, inner);
    triangle_error_.resize(disc.triangles.size());
    error_.resize(2 * pattern_.size());
    if (pattern_.size() == 0) return;
    expand_pattern();
    factor_.analyzePattern(matrix_);
  }

  /// How far each row is from where it should be. Returns the largest.
  double measure(std::span<const double> angles) {
    double largest = 0;
    error_.setZero();
    wheel_error_ = 0;
    for (std::size_t t = 0; t < disc_.triangles.size(); ++t) {
      const double* angle = &angles[3 * t];
      triangle_error_[t] = pi - (angle[0] + angle[1] + angle[2]);
      largest = std::max(largest, std::abs(triangle_error_[t]));
      Vector3 log_sine{};
      for (std::size_t i = 0; i < 3; ++i) log_sine[i] = std::log(std::sin(angle[i]));
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = column_of(t, i);
        if (column < 0) continue;
        error_[2 * column] -= angle[i];
        error_[2 * column + 1] += log_sine[prev3(i)] - log_sine[next3(i)];
      }
    }
    for (int column = 0; column < pattern_.size(); ++column) {
      error_[2 * column] += 2 * pi;
      wheel_error_ = std::max(wheel_error_, std::abs(error_[2 * column + 1]));
      largest = std::max({largest, std::abs(error_[2 * column]), wheel_error_});
    }
    return largest;
  }
  [[nodiscard]] double wheel_error() const { return wheel_error_; }

  /// One solve, for the errors as measured of these angles.
  bool improve(std::vector<double>& angles) {
    if (pattern_.size() > 0) {
      assemble(angles);
      factor_.factorize(matrix_);
      if (factor_.info() != Eigen::Success || !(factor_.vectorD().minCoeff() > 0)) return false;
      solution_ = factor_.solve(right_side_);
    }
    for (std::size_t t = 0; t < disc_.triangles.size(); ++t) {
      double* angle = &angles[3 * t];
      const Local local = local_rows(angle);
      Vector3 x{};
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = column_of(t, i);
        if (column < 0) continue;
        for (std::size_t j = 0; j < 3; ++j) {
          x[j] += solution_[2 * column] * local.sum[i][j];
          x[j] += solution_[2 * column + 1] * local.wheel[i][j];
        }
      }
      const double share =
          (triangle_error_[t] - dot3(local.triangle, x)) / dot3(local.triangle, local.triangle);
      for (std::size_t i = 0; i < 3; ++i) {
        angle[i] *= 1 + (x[i] + share * local.triangle[i]);
        if (!(angle[i] > 0 && angle[i] < pi)) return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] int column_of(std::size_t triangle, std::size_t corner) const {
    return pattern_.column[disc_.triangles[triangle][corner]];
  }

  /// Each entry of the pattern becomes a block of two by two; but below the diagonal there is none.
  void expand_pattern() {
    const int points = pattern_.size(), blocks = pattern_.begin.back();
    matrix_.resize(2 * points, 2 * points);
    matrix_.resizeNonZeros(4 * blocks - points);
    int* begin = matrix_.outerIndexPtr();
    int* row = matrix_.innerIndexPtr();
    for (int j = 0; j < points; ++j) {
      begin[2 * j] = first_entry(j);
      begin[2 * j + 1] = second_entry(j);
      for (int k = 0; k < pattern_.begin[j + 1] - pattern_.begin[j]; ++k) {
        const int i = pattern_.row[pattern_.begin[j] + k];
        row[begin[2 * j] + 2 * k] = row[begin[2 * j + 1] + 2 * k] = 2 * i;
        if (i < j) row[begin[2 * j] + 2 * k + 1] = 2 * i + 1;
        row[begin[2 * j + 1] + 2 * k + 1] = 2 * i + 1;
      }
    }
    begin[2 * points] = first_entry(points);
  }
  [[nodiscard]] int first_entry(int point) const { return 4 * pattern_.begin[point] - point; }
  [[nodiscard]] int second_entry(int point) const {
    return first_entry(point) + 2 * (pattern_.begin[point + 1] - pattern_.begin[point]) - 1;
  }

  void assemble(std::span<const double> angles) {
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
    right_side_ = error_;
    for (std::size_t t = 0; t < disc_.triangles.size(); ++t) {
      Local local = local_rows(&angles[3 * t]);
      const double norm2 = dot3(local.triangle, local.triangle);
      // Eliminated, the triangle's row leaves the others' parts that are orthogonal to it.
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = column_of(t, i);
        for (const bool wheel : {false, true}) {
          Vector3& part = wheel ? local.wheel[i] : local.sum[i];
          const double share = dot3(part, local.triangle) / norm2;
          for (std::size_t j = 0; j < 3; ++j) part[j] -= share * local.triangle[j];
          if (column >= 0) right_side_[2 * column + wheel] -= share * triangle_error_[t];
        }
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = column_of(t, i);
        if (column >= 0) add_diagonal(column, local.sum[i], local.wheel[i]);
        const int entry = pattern_.edge_entry[3 * t + i];
        if (entry < 0) continue;
        const std::size_t j = next3(i);
        const bool turn = column > column_of(t, j);
        const std::size_t low = turn ? j : i, high = turn ? i : j;
        add_block(column_of(t, high), entry, local, low, high);
      }
    }
  }
  void add_diagonal(int column, const Vector3& sum, const Vector3& wheel) {
    double* value = matrix_.valuePtr();
    value[second_entry(column) - 1] += dot3(sum, sum);
    value[first_entry(column + 1) - 2] += dot3(sum, wheel);
    value[first_entry(column + 1) - 1] += dot3(wheel, wheel);
  }
  void add_block(int column, int entry, const Local& local, std::size_t row, std::size_t other) {
    const int offset = 2 * (entry - pattern_.begin[column]);
    double* first = matrix_.valuePtr() + first_entry(column) + offset;
    double* second = matrix_.valuePtr() + second_entry(column) + offset;
    first[0] += dot3(local.sum[row], local.sum[other]);
    first[1] += dot3(local.wheel[row], local.sum[other]);
    second[0] += dot3(local.sum[row], local.wheel[other]);
    second[1] += dot3(local.wheel[row], local.wheel[other]);
  }

  const Disc& disc_;
  Pattern pattern_;
  std::vector<double> triangle_error_;
  Eigen::VectorXd error_, right_side_, solution_;  // sum and wheel of each inner point
  double wheel_error_ = 0;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper, Eigen::NaturalOrdering<int>>
      factor_;
};

}  // namespace

std::vector<double> corner_angles(const Disc& disc) {
  std::vector<double> angles;
  angles.reserve(3 * disc.triangles.size());
  for (const Triangle& triangle : disc.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = disc.points[triangle[i]];
      const Vec3 a = disc.points[triangle[next3(i)]] - p, b = disc.points[triangle[prev3(i)]] - p;
      angles.push_back(std::atan2(length(cross(a, b)), dot(a, b)));
    }
  }
  return angles;
}

std::optional<FlatAngles> flat_angles(const Disc& disc, std::span<const std::uint32_t> order,
                                      int iterations) {
  FlatAngles flat{corner_angles(disc)};
  for (std::size_t c = 0; c < flat.angles.size(); c += 3) {
    const std::span<double, 3> angle(&flat.angles[c], 3);
    if (*std::min_element(angle.begin(), angle.end()) > kNoAngle) continue;
    for (double& a : angle) a = std::clamp(a, kLeastAngle, kGreatestAngle);
  }
  AngleSystem system(disc, order);
  double error = system.measure(flat.angles);
  for (int i = 0; i < iterations && error > kSolved; ++i) {
    if (!system.improve(flat.angles)) return std::nullopt;
    error = system.measure(flat.angles);
  }
  flat.wheel_residual = system.wheel_error();
  return flat;
}

}  // namespace wrapatlas
