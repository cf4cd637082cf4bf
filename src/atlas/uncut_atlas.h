// What every atlas whose faces are those of its mesh has in common.
#pragma once

#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// The faces and corners of the mesh, uncut, without UVs: no texcoords, all corner_texcoord kNone.
AtlasMesh uncut_atlas(const Mesh& mesh);

}  // namespace wrapatlas
