// Entries of the matrices that are factored: complex numbers, and two by two real blocks.
#pragma once

#include <array>
#include <complex>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

using Complex = std::complex<double>;

/// Written out: the operator looks for infinities at every turn.
inline Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
inline Complex adjoint(Complex a) { return std::conj(a); }
inline bool is_positive(Complex a) { return a.real() > 0; }
/// Of a real number, on the diagonal of a Hermitian matrix.
inline Complex inverse(Complex a) { return 1 / a.real(); }

/// The rows (xx, xy) and (yx, yy).
struct Block {
  double xx = 0, xy = 0, yx = 0, yy = 0;

  Block& operator+=(const Block& b) { return *this = {xx + b.xx, xy + b.xy, yx + b.yx, yy + b.yy}; }
  Block& operator-=(const Block& b) { return *this = {xx - b.xx, xy - b.xy, yx - b.yx, yy - b.yy}; }
};

inline Block times(const Block& a, const Block& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy,  //
          a.yx * b.xx + a.yy * b.yx, a.yx * b.xy + a.yy * b.yy};
}
inline Vec2 times(const Block& a, Vec2 v) {
  return {a.xx * v.x + a.xy * v.y, a.yx * v.x + a.yy * v.y};
}
inline Block adjoint(const Block& a) { return {a.xx, a.yx, a.xy, a.yy}; }
inline double determinant(const Block& a) { return a.xx * a.yy - a.xy * a.yx; }
inline bool is_positive(const Block& a) { return a.xx > 0 && determinant(a) > 0; }
inline Block inverse(const Block& a) {
  const double scale = 1 / determinant(a);
  return {scale * a.yy, -scale * a.xy, -scale * a.yx, scale * a.xx};
}

}  // namespace wrapatlas
