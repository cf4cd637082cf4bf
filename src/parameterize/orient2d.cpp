// Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric predicates:
// the error bound of ORIENT2D's first stage, and sums of doubles that are exact (GROW-EXPANSION).
// Where the bound does not decide we go straight to the exact sum: that is seldom.
#include "parameterize/orient2d.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace wrapatlas {
namespace {

constexpr double kHalfUlp = 0x1p-53;
constexpr double kBound = (3 + 16 * kHalfUlp) * kHalfUlp;
constexpr double kUnderflow = 1e-290;  // what is below may have lost more bits than the bound knows

/// A sum of doubles none of which overlap, smallest first.
class ExactSum {
 public:
  void add_product(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }
  [[nodiscard]] int sign() const {
    for (std::size_t i = count_; i-- > 0;) {
      if (parts_[i] != 0) return parts_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  void add(double value) {
    for (std::size_t i = 0; i < count_; ++i) {
      const double part = parts_[i], sum = value + part;
      const double of_part = sum - value, of_value = sum - of_part;
      parts_[i] = (value - of_value) + (part - of_part);
      value = sum;
    }
    parts_[count_++] = value;
  }

  std::array<double, 12> parts_{};
  std::size_t count_ = 0;
};

}  // namespace

int orient2d(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double twice_area = left - right;
  if (std::abs(twice_area) > kBound * (std::abs(left) + std::abs(right)) + kUnderflow) {
    return twice_area > 0 ? 1 : -1;
  }
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.sign();
}

}  // namespace wrapatlas
