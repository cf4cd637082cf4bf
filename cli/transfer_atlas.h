// One set of textures of a model on its way to a new atlas.
#pragma once

#include <string>
#include <vector>

#include "packing_run.h"
#include "wrapatlas/texture_sets.h"
#include "wrapatlas/transfer.h"
#include "wrapatlas/unwrap.h"

namespace wrapatlas::cli {

struct TransferArguments {
  PackArguments pack;
  int bits = 8;
  double bleed = kDefaultBleed;
  bool merge = false, unwrap = false;
  bool size_given = false;
};

/// What becomes of one set.
struct NewAtlas {
  ChartSet charts;
  Packing packing;
  AtlasMesh atlas;                ///< of the set's mesh
  double thinned = 0;             ///< share_thinned() of the set's faces
  std::vector<Texture> textures;  ///< as TextureSet::textures
};

/// Packs the set's charts, or those that it is cut into, and checks the result exactly. `label`
/// stands in progress lines: "atlas 2 of 5: ".
Result<NewAtlas> pack_texture_set(const TransferArguments& arguments, const TextureSet& set,
                                  bool v_points_down, const std::string& label);

/// Fills its textures.
Status fill_textures(const TransferArguments& arguments, const TextureSet& set, bool v_points_down,
                     const std::string& label, NewAtlas& atlas);

}  // namespace wrapatlas::cli
