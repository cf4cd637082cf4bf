// The cells of the domain that one placed chart covers, as bits: for the overlap of two charts.
#pragma once

#include <cstdint>
#include <vector>

#include "guided/piece.h"

namespace wrapatlas {

/// Rows of bits, folded onto the domain.
class Cover {
 public:
  /// The cells of a piece whose cell (0,0) lies at (x, y).
  void set(const Domain& domain, const Piece& piece, int x, int y);
  /// Cells that both cover.
  [[nodiscard]] static std::int64_t shared(const Cover& a, const Cover& b);

 private:
  int domain_height_ = 0;
  int y_ = 0, rows_ = 0;  ///< row of the domain of the first row of bits; number of rows
  int first_word_ = 0, end_word_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace wrapatlas
