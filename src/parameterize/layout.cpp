// Lévy, Petitjean, Ray & Maillot 2002, Least squares conformal maps (SIGGRAPH 2002), with shapes in
// place of local coordinates, so that it lays out given angles as well. With U in the complex plane
// each triangle asks for
//   U2 - U0 = z (U1 - U0),
// and misses it by 2 |b| h if the map to the plane is w -> a w + b conj(w) and h is the height over
// edge 01. The conformal energy, area * |b|^2, is thus the squared error times edge / (8 h): as
// edge 01 is 1 to our shapes and h the imaginary part of z, errors weigh 1 / h. The normal
// equations are Hermitian; complex, they have half the unknowns of the paper's real ones. Two
// points of the border, far from each other, are pinned.
#include "parameterize/layout.h"

#include <algorithm>
#include <array>

#include "parameterize/ldl.h"
#include "parameterize/pattern.h"

namespace wrapatlas {
namespace {

/// Flatter triangles count as this flat: those of no area would outweigh all others.
constexpr double kFlattest = 0.025;

std::size_t farthest_on_border(const Disc& disc, std::size_t from) {
  double farthest = 0;
  std::size_t found = (from + disc.border.size() / 2) % disc.border.size();
  for (std::size_t i = 0; i < disc.border.size(); ++i) {
    const Vec3 d = disc.points[disc.border[i]] - disc.points[disc.border[from]];
    if (dot(d, d) > farthest) {
      farthest = dot(d, d);
      found = i;
    }
  }
  return found;
}

std::array<std::uint32_t, 2> far_points(const Disc& disc) {
  const std::size_t one = farthest_on_border(disc, 0), other = farthest_on_border(disc, one);
  return {disc.border[one], disc.border[other]};
}

Pattern pattern_without(const std::array<std::uint32_t, 2>& pins, const Disc& disc,
                        std::span<const std::uint32_t> order) {
  std::vector<bool> free(disc.points.size(), true);
  for (const std::uint32_t pin : pins) free[pin] = false;
  return make_pattern(disc, order, free);
}

class Layout {
 public:
  Layout(const Disc& disc, std::span<const std::uint32_t> order, std::span<const Shape> shapes)
      : disc_(disc),
        shapes_(shapes),
        pins_(far_points(disc)),
        pattern_(pattern_without(pins_, disc, order)),
        factor_(pattern_),
        at_(disc.points.size()) {
    at_[pins_[1]] = 1;
  }

  bool solve() {
    if (!factor_.factor(assemble())) return false;
    // Maps as good as conformal are many, and make the equations worse by n^2; but what rounding
    // took from the first step the second gives back, as it starts from the triangles' errors.
    step();
    step();
    return true;
  }

  [[nodiscard]] std::vector<Vec2> points() const {
    std::vector<Vec2> points;
    points.reserve(at_.size());
    for (const Complex& p : at_) points.push_back({p.real(), p.imag()});
    return points;
  }

 private:
  /// What a triangle's error has of each of its corners, and which corners those are.
  struct Row {
    std::array<Complex, 3> factor;
    std::array<std::size_t, 3> corner;
    double weight;
  };
  [[nodiscard]] Row row_of(std::size_t triangle) const {
    const Shape& shape = shapes_[triangle];
    const std::size_t second = next3(shape.first);
    return {{shape.ratio - 1.0, -shape.ratio, 1.0},
            {shape.first, second, next3(second)},
            1 / std::max(shape.ratio.imag(), kFlattest)};
  }

  [[nodiscard]] std::vector<Complex> assemble() const {
    std::vector<Complex> entries(pattern_.row.size());
    for (std::size_t t = 0; t < shapes_.size(); ++t) {
      const Row row = row_of(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = pattern_.column[disc_.triangles[t][row.corner[i]]];
        if (column < 0) continue;
        entries[pattern_.diagonal(column)] += row.weight * std::norm(row.factor[i]);
        const int edge = pattern_.edge_entry[3 * t + row.corner[i]];
        if (edge < 0) continue;
        const std::size_t j = next3(i);
        const Complex product = row.weight * times(adjoint(row.factor[i]), row.factor[j]);
        const int other = pattern_.column[disc_.triangles[t][row.corner[j]]];
        entries[edge] += column < other ? product : adjoint(product);
      }
    }
    return entries;
  }

  /// From where the points are to where they should be.
  void step() {
    std::vector<Complex> change(pattern_.size());  // at first, downhill
    for (std::size_t t = 0; t < shapes_.size(); ++t) {
      const Row row = row_of(t);
      Complex error = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        error += times(row.factor[i], at_[disc_.triangles[t][row.corner[i]]]);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const int column = pattern_.column[disc_.triangles[t][row.corner[i]]];
        if (column >= 0) change[column] -= row.weight * times(adjoint(row.factor[i]), error);
      }
    }
    factor_.solve(change);
    for (std::size_t p = 0; p < at_.size(); ++p) {
      if (pattern_.column[p] >= 0) at_[p] += change[pattern_.column[p]];
    }
  }

  const Disc& disc_;
  std::span<const Shape> shapes_;
  std::array<std::uint32_t, 2> pins_;
  Pattern pattern_;
  Ldl<Complex> factor_;
  std::vector<Complex> at_;  // per point
};

}  // namespace

std::optional<std::vector<Vec2>> lay_out(const Disc& disc, std::span<const std::uint32_t> order,
                                         std::span<const Shape> shapes) {
  Layout layout(disc, order, shapes);
  if (!layout.solve()) return std::nullopt;
  return layout.points();
}

}  // namespace wrapatlas
