// Which face of an atlas is which face (or which part of which face) of the mesh it was made from.
#pragma once

#include <cstdint>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/result.h"

namespace wrapatlas::validate {

struct FaceMatch {
  /// Where a corner of the atlas was in the reference's UVs.
  struct Corner {
    Vec2 uv;
    double doubt = 0;       ///< reference UV units by which rounded positions may have moved it;
                            ///< infinite where the positions do not tell
    bool original = false;  ///< it is a corner of the reference, not a new point
  };

  std::vector<std::uint32_t> source;   ///< per face of the atlas: face of the reference
  std::vector<Corner> corners;         ///< per corner of the atlas; unset without UVs
  std::vector<std::uint32_t> missing;  ///< faces of the reference that the atlas has not
};

/// Both meshes must pass validate_mesh. A face of the reference answers, in order, either to one
/// face with the same corners or to several in a row that tile it. The order is that of the files
/// or, if that fails, object by object, as glTF has them (order_by_object). Error input: a face of
/// the atlas that is no part of the reference at its place in the order. O(corners) for uncut
/// faces.
Result<FaceMatch> match_faces(const Mesh& atlas, const Mesh& reference, Vec2 atlas_size);

}  // namespace wrapatlas::validate
