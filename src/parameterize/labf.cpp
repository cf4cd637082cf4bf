// Linear angle based flattening: Zayer, Levy & Seidel, Linear angle based parameterization (SGP
// 2007).
//
// Unknown are the relative errors x = e / angle of the corners (their weighting, eq. 8).
// Conditions, linear in them: the sum of each triangle, the sum round each interior point, and, in
// logarithms (eq. 5), that lengths agree after one way round it, the wheel. The smallest x that
// meets them is x = A' (A A')^-1 b. A A' is diagonal for the triangles, so they are eliminated:
// each adds its part to a system of two unknowns per interior point. What differs: the solve may be
// repeated from the angles it gave, which makes the wheels hold to rounding.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "parameterize/angles.h"

namespace wrapatlas {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>>;
using Local = Eigen::Matrix<double, 6, 3>;

/// What a triangle has to do with the sums (rows 0 to 2) and wheels (3 to 5) of its corners'
/// points.
struct Element {
  Eigen::Vector3d sum;  ///< of the triangle itself
  Local rows;
  double sum_error = 0;  ///< pi - sum of the angles

  explicit Element(const Angles& a) {
    rows.setZero();
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3, prev = (i + 2) % 3;
      sum[i] = a[i];
      rows(i, i) = a[i];
      rows(3 + i, next) = a[next] / std::tan(a[next]);
      rows(3 + i, prev) = -a[prev] / std::tan(a[prev]);
    }
    sum_error = std::numbers::pi - a[0] - a[1] - a[2];
  }
};

class Flattener {
 public:
  Flattener(std::span<const Triangle> triangles, const std::vector<bool>& is_border)
      : triangles_(triangles), number_(is_border.size(), -1) {
    for (std::size_t p = 0; p < is_border.size(); ++p) {
      if (!is_border[p]) number_[p] = count_++;
    }
  }

  bool solve(std::vector<Angles>& angles) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * count_);
    if (count_ > 0) {
      const Matrix system = assemble(angles);
      if (!is_analyzed_) solver_.analyzePattern(system);
      is_analyzed_ = true;
      solver_.factorize(system);
      if (solver_.info() != Eigen::Success) return false;
      y = solver_.solve(right_side(angles));
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Element element(angles[t]);
      Eigen::Vector3d x = element.rows.transpose() * values(t, y);
      x += element.sum * ((element.sum_error - element.sum.dot(x)) / element.sum.squaredNorm());
      for (int i = 0; i < 3; ++i) {
        angles[t][i] *= 1 + x[i];
        if (!(angles[t][i] > kLeast && angles[t][i] < std::numbers::pi - kLeast)) return false;
      }
    }
    return true;
  }

  [[nodiscard]] double wheel_error(std::span<const Angles> angles) const {
    std::vector<double> error(static_cast<std::size_t>(count_), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const int v = number_[triangles_[t][i]];
        if (v >= 0) error[v] += wheel_term(angles[t], i);
      }
    }
    double largest = 0;
    for (const double e : error) largest = std::max(largest, std::abs(e));
    return largest;
  }

 private:
  /// Thinner triangles are no triangles.
  static constexpr double kLeast = 1e-6;

  static double wheel_term(const Angles& a, std::size_t i) {
    return std::log(std::sin(a[(i + 2) % 3])) - std::log(std::sin(a[(i + 1) % 3]));
  }

  /// The unknown of row i of an element, or -1 on the border.
  [[nodiscard]] int unknown(std::size_t t, int i) const {
    const int v = number_[triangles_[t][i % 3]];
    return v < 0 ? -1 : 2 * v + i / 3;
  }

  [[nodiscard]] Eigen::Matrix<double, 6, 1> values(std::size_t t, const Eigen::VectorXd& y) const {
    Eigen::Matrix<double, 6, 1> at;
    for (int i = 0; i < 6; ++i) at[i] = unknown(t, i) < 0 ? 0 : y[unknown(t, i)];
    return at;
  }

  [[nodiscard]] Matrix assemble(std::span<const Angles> angles) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(21 * triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Element element(angles[t]);
      const Eigen::Matrix<double, 6, 1> mixed = element.rows * element.sum;
      Eigen::Matrix<double, 6, 6> part = element.rows * element.rows.transpose();
      part -= mixed * mixed.transpose() / element.sum.squaredNorm();
      for (int i = 0; i < 6; ++i) {
        const int row = unknown(t, i);
        if (row < 0) continue;
        for (int j = 0; j < 6; ++j) {
          const int column = unknown(t, j);
          if (column >= 0 && column <= row) entries.emplace_back(row, column, part(i, j));
        }
      }
    }
    Matrix system(2 * count_, 2 * count_);
    system.setFromTriplets(entries.begin(), entries.end());
    return system;
  }

  [[nodiscard]] Eigen::VectorXd right_side(std::span<const Angles> angles) const {
    Eigen::VectorXd b(2 * count_);
    for (int v = 0; v < count_; ++v) {
      b[2 * v] = 2 * std::numbers::pi;
      b[2 * v + 1] = 0;
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Element element(angles[t]);
      const Eigen::Matrix<double, 6, 1> taken =
          element.rows * element.sum * (element.sum_error / element.sum.squaredNorm());
      for (int i = 0; i < 6; ++i) {
        if (unknown(t, i) < 0) continue;
        const double term = i < 3 ? -angles[t][i] : wheel_term(angles[t], i - 3);
        b[unknown(t, i)] += term - taken[i];
      }
    }
    return b;
  }

  std::span<const Triangle> triangles_;
  std::vector<int> number_;  // of interior points; -1: border
  int count_ = 0;
  Solver solver_;
  bool is_analyzed_ = false;
};

}  // namespace

bool flatten_angles(std::vector<Angles>& angles, std::span<const Triangle> triangles,
                    const std::vector<bool>& is_border, int iterations, double& residual) {
  Flattener flattener(triangles, is_border);
  for (int i = 0; i < iterations; ++i) {
    if (!flattener.solve(angles)) return false;
  }
  residual = flattener.wheel_error(angles);
  return true;
}

}  // namespace wrapatlas
