// Textures of a glTF's materials, in and out.
#pragma once

#include "io/gltf_edit.h"
#include "io/gltf_primitives.h"
#include "wrapatlas/model_textures.h"

namespace wrapatlas {

/// Those that follow the loaded UVs, decoded; or base colours alone. Errors: input.
Result<ModelTextures> read_gltf_textures(const GltfContents& contents, bool base_colors_alone);

/// Puts new images in the place of those that they were made from: each use then names the new
/// texture, without a transform. Images that nothing uses any more go. `textures` refer to the uses
/// in the order of read_gltf_textures.
void replace_gltf_textures(const GltfContents& contents, std::span<const NewTexture> textures,
                           GltfEdit& edit);

}  // namespace wrapatlas
