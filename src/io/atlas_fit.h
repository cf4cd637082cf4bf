// What saving needs of an atlas besides its writer: that it fits the mesh, and the other v axis.
#pragma once

#include "wrapatlas/atlas.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

/// Checks all that the writers rely on: array sizes, indices in range, every source face present
/// and in order, each corner from its own face, and uncut faces unchanged. O(corners).
Status check_fit(const Mesh& mesh, const AtlasMesh& atlas);

/// The atlas with v replaced by 1 - v. Where v wraps, each chart is then shifted by a whole number
/// so that its smallest v lies in [0,1) again.
AtlasMesh turn_upside_down(AtlasMesh atlas);

}  // namespace wrapatlas
