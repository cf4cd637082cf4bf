#include "guided/pose.h"

#include <utility>

namespace wrapatlas {

/// A point moves by (dx, dy) + turn * (its arm from the pivot, turned by 90 degrees).
void MotionFit::add_row(Vec2 point, Vec2 target, Vec2 normal, double weight) {
  const Vec2 arm = point - pivot_;
  const double row[3] = {normal.x, normal.y, dot(normal, {-arm.y, arm.x})};
  const double miss = dot(normal, target - point);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) a_[i][j] += weight * row[i] * row[j];
    b_[i] += weight * row[i] * miss;
  }
}

Pose MotionFit::solve() const {
  // Cholesky; what the points leave open stays as it is.
  double lower[3][3] = {}, y[3] = {}, x[3] = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a_[i][j];
      for (int k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
      if (i != j) {
        lower[i][j] = sum / lower[j][j];
      } else if (sum <= 1e-12 * a_[i][i] || sum <= 0) {
        return {};
      } else {
        lower[i][i] = std::sqrt(sum);
      }
    }
  }
  for (int i = 0; i < 3; ++i) {
    double sum = b_[i];
    for (int k = 0; k < i; ++k) sum -= lower[i][k] * y[k];
    y[i] = sum / lower[i][i];
  }
  for (int i = 2; i >= 0; --i) {
    double sum = y[i];
    for (int k = i + 1; k < 3; ++k) sum -= lower[k][i] * x[k];
    x[i] = sum / lower[i][i];
  }
  // About the pivot: R (p - pivot) + pivot + (dx, dy).
  const Pose turn{x[2], {}};
  return {x[2], pivot_ + Vec2{x[0], x[1]} - turn.turned(pivot_)};
}

}  // namespace wrapatlas
