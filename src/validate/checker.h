// The parts of the judgement, and what they share.
#pragma once

#include <vector>

#include "validate/close_pairs.h"
#include "validate/connectivity.h"
#include "validate/face_match.h"
#include "validate/findings.h"
#include "validate/similarity_fit.h"
#include "validate/texel_items.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::validate {

/// One call of check_atlas.
class Checker {
 public:
  Checker(const Mesh& atlas, const Mesh* reference, const CheckOptions& options)
      : atlas_(atlas),
        reference_(reference),
        options_(options),
        size_{static_cast<double>(options.width), static_cast<double>(options.height)},
        wraps_{wraps_u(options.wrap), wraps_v(options.wrap)},
        findings_(report_, options.max_findings) {}

  Result<CheckReport> run();

 private:
  void take_pieces_for_charts(const FaceCharts& own);
  void take_items(TexelItems found);
  Status compare(FaceCharts& pieces);
  void fit(const std::vector<std::uint32_t>& face_piece);
  void check_areas_of_faces();
  Status reassemble();
  Status find_stacks_of_reference();
  void check_sides();
  Status check_distances();
  Status remark_folds();
  [[nodiscard]] std::string describe(const PairRecord& record) const;

  const Mesh& atlas_;
  const Mesh* reference_;
  const CheckOptions& options_;
  Vec2 size_;
  std::array<bool, 2> wraps_;
  CheckReport report_;
  Findings findings_;
  std::vector<std::uint32_t> face_chart_;  ///< per face of the atlas
  std::vector<double> rounding_;           ///< per chart, texels
  std::vector<Item> items_;
  FaceCharts original_;  ///< of the reference
  FaceMatch match_;
  Fits fits_;
  std::vector<std::uint32_t> stack_;  ///< per chart: first chart of its stack
};

}  // namespace wrapatlas::validate
