// The parts of the judgement, and what they share.
#pragma once

#include <functional>
#include <vector>

#include "validate/close_pairs.h"
#include "validate/connectivity.h"
#include "validate/face_match.h"
#include "validate/findings.h"
#include "validate/similarity_fit.h"
#include "validate/texel_items.h"
#include "validate/tiles.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::validate {

/// One call of check_atlas.
class Checker {
 public:
  Checker(const Mesh& atlas, const Mesh* reference, const CheckOptions& options)
      : moved_(options.pages > 1 ? atlas : Mesh{}),
        atlas_(options.pages > 1 ? moved_ : atlas),
        reference_(reference),
        options_(options),
        size_{static_cast<double>(options.width), static_cast<double>(options.height)},
        wraps_{wraps_u(options.wrap), wraps_v(options.wrap)},
        findings_(report_, options.max_findings) {}

  Result<CheckReport> run();

 private:
  using FindPairs = std::function<Result<ClosePairs>(std::span<const Item>)>;

  void find_tiles(const std::vector<std::uint32_t>& face_group, std::size_t groups);
  void take_pieces_for_charts(const FaceCharts& own);
  void take_items(TexelItems found);
  Status compare(FaceCharts& pieces);
  void fit(const std::vector<std::uint32_t>& face_piece);
  void check_areas_of_faces();
  Status reassemble();
  Status find_stacks_of_reference();
  [[nodiscard]] std::vector<std::array<double, 2>> shifts_to_stacks() const;
  void make_items();
  void check_tiles();
  void check_sides();
  [[nodiscard]] Result<ClosePairs> find_on_pages(const FindPairs& find) const;
  Status check_distances();
  Status remark_folds();
  [[nodiscard]] std::string describe(const PairRecord& record) const;
  [[nodiscard]] std::string on_page(std::uint32_t face) const;

  Mesh moved_;         ///< the atlas, if it has several pages, charts moved to the first tile
  const Mesh& atlas_;  ///< that, or the one given
  const Mesh* reference_;
  const CheckOptions& options_;
  Vec2 size_;
  std::array<bool, 2> wraps_;
  CheckReport report_;
  Findings findings_;
  std::vector<std::uint32_t> face_chart_;  ///< per face of the atlas
  std::vector<Tile> face_tile_;            ///< per face of the atlas; empty if it is one page
  std::vector<double> rounding_;           ///< per chart, texels
  std::vector<Item> items_;                ///< page by page
  FaceCharts original_;                    ///< of the reference
  FaceMatch match_;
  Fits fits_;
  std::vector<std::uint32_t> stack_;  ///< per chart: first chart of its stack
};

}  // namespace wrapatlas::validate
