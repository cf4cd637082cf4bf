// Zayer, Lévy & Seidel 2007, Linear angle based parameterization (SGP 2007).
//
// Unknown is the relative change x of each angle: alpha = gamma (1 + x), and the sum of x^2 is to
// be least. The angles are subject to
//   triangle      sum of alpha = pi
//   inner point   sum of alpha around it = 2 pi
//   its wheel     sum of log sin(next) - log sin(previous) = 0 over the triangles around it,
// to first order in alpha - gamma; next and previous are the other two corners of a triangle.
// What differs:
// - The publication solves A A^T y = b for all rows. The block of A A^T for the triangles is
//   diagonal, so we eliminate it and factor what is left, two rows for each inner point.
// - We repeat from the angles found, which makes the error of the wheels fall quadratically.
// - Small angles are taken as they are. Clamped to 3 degrees and more, as is usual, flat charts of
//   long triangles would not stay as they are. Only triangles of no area are clamped.
#include "parameterize/labf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "parameterize/ldl.h"
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

Pattern inner_pattern(const Disc& disc, std::span<const std::uint32_t> order) {
  std::vector<bool> inner = disc.on_border;
  inner.flip();
  return make_pattern(disc, order, inner);
}

class AngleSystem {
 public:
  AngleSystem(const Disc& disc, std::span<const std::uint32_t> order)
      : disc_(disc),
        pattern_(inner_pattern(disc, order)),
        factor_(pattern_),
        entries_(pattern_.row.size()),
        triangle_error_(disc.triangles.size()),
        error_(pattern_.size()) {}

  /// How far each row is from where it should be. Returns the largest.
  double measure(std::span<const double> angles) {
    double largest = 0;
    std::fill(error_.begin(), error_.end(), Vec2{2 * pi, 0});
    for (std::size_t t = 0; t < disc_.triangles.size(); ++t) {
      const double* angle = &angles[3 * t];
      triangle_error_[t] = pi - (angle[0] + angle[1] + angle[2]);
      largest = std::max(largest, std::abs(triangle_error_[t]));
      Vector3 log_sine{};
      for (std::size_t i = 0; i < 3; ++i) log_sine[i] = std::log(std::sin(angle[i]));
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = column_of(t, i);
        if (column < 0) continue;
        error_[column].x -= angle[i];
        error_[column].y += log_sine[prev3(i)] - log_sine[next3(i)];
      }
    }
    wheel_error_ = 0;
    for (const Vec2 error : error_) {
      wheel_error_ = std::max(wheel_error_, std::abs(error.y));
      largest = std::max({largest, std::abs(error.x), wheel_error_});
    }
    return largest;
  }
  [[nodiscard]] double wheel_error() const { return wheel_error_; }

  /// One solve, for the errors as measured of these angles. False if there is no solution, or none
  /// of triangles.
  bool improve(std::vector<double>& angles) {
    std::vector<Vec2> y = assemble(angles);
    if (!factor_.factor(entries_)) return false;
    factor_.solve(y);
    for (std::size_t t = 0; t < disc_.triangles.size(); ++t) {
      double* angle = &angles[3 * t];
      const Local local = local_rows(angle);
      Vector3 x{};
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = column_of(t, i);
        if (column < 0) continue;
        for (std::size_t j = 0; j < 3; ++j) {
          x[j] += y[column].x * local.sum[i][j] + y[column].y * local.wheel[i][j];
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

  /// The matrix, into entries_; returns the right side. Sums and wheels of each inner point.
  std::vector<Vec2> assemble(std::span<const double> angles) {
    std::fill(entries_.begin(), entries_.end(), Block{});
    std::vector<Vec2> right_side = error_;
    for (std::size_t t = 0; t < disc_.triangles.size(); ++t) {
      Local local = local_rows(&angles[3 * t]);
      const double norm2 = dot3(local.triangle, local.triangle);
      // Eliminated, the triangle's row leaves the others' parts that are orthogonal to it.
      for (std::size_t i = 0; i < 3; ++i) {
        Vec2 share;
        share.x = take_out(local.triangle, norm2, local.sum[i]);
        share.y = take_out(local.triangle, norm2, local.wheel[i]);
        const int column = column_of(t, i);
        if (column < 0) continue;
        right_side[column] = right_side[column] - triangle_error_[t] * share;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = column_of(t, i), edge = pattern_.edge_entry[3 * t + i];
        if (column >= 0) entries_[pattern_.diagonal(column)] += products(local, i, i);
        if (edge < 0) continue;
        const std::size_t j = next3(i);
        entries_[edge] += column < column_of(t, j) ? products(local, i, j) : products(local, j, i);
      }
    }
    return right_side;
  }
  static double take_out(const Vector3& row, double norm2, Vector3& part) {
    const double share = dot3(part, row) / norm2;
    for (std::size_t j = 0; j < 3; ++j) part[j] -= share * row[j];
    return share;
  }
  static Block products(const Local& local, std::size_t i, std::size_t j) {
    return {dot3(local.sum[i], local.sum[j]), dot3(local.sum[i], local.wheel[j]),
            dot3(local.wheel[i], local.sum[j]), dot3(local.wheel[i], local.wheel[j])};
  }

  const Disc& disc_;
  Pattern pattern_;
  Ldl<Block> factor_;
  std::vector<Block> entries_;
  std::vector<double> triangle_error_;
  std::vector<Vec2> error_;  // sum and wheel of each inner point
  double wheel_error_ = 0;
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
