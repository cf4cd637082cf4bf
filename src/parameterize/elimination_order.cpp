#include <vector>

#include "parameterize/pattern.h"

// A program that links this library may use Eigen itself, compiled for other instruction sets, and
// the linker must not mix the two: ours goes by another name.
#define EIGEN_MPL2_ONLY
#define EIGEN_DONT_PARALLELIZE
#define Eigen wrapatlas_eigen
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace wrapatlas {

std::vector<std::uint32_t> elimination_order(const Disc& disc) {
  std::vector<std::uint32_t> order(disc.points.size());
  for (std::uint32_t p = 0; p < order.size(); ++p) order[p] = p;
  Pattern pattern = make_pattern(disc, order, std::vector<bool>(order.size(), true));
  const std::vector<double> ones(pattern.row.size(), 1);
  const Eigen::Map<const Eigen::SparseMatrix<double>> graph(
      pattern.size(), pattern.size(), static_cast<Eigen::Index>(ones.size()), pattern.begin.data(),
      pattern.row.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> found;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), found);
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = static_cast<std::uint32_t>(found.indices()(static_cast<Eigen::Index>(k)));
  }
  return order;
}

}  // namespace wrapatlas
