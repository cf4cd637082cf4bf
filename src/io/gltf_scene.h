// Where the nodes of a glTF put its meshes.
#pragma once

#include "io/gltf_primitives.h"

namespace wrapatlas {

/// Replaces the model's mesh, and what hangs on its faces and corners, by what the scene shows:
/// each mesh once for every node that has it, moved by the node's transform; what skins do is left
/// out. A file without nodes that have meshes stays as it is. Errors: input (nodes in a circle,
/// more than 2^31 corners).
Status place_in_scene(const GltfContents& contents, Model& model);

}  // namespace wrapatlas
