// Where materials use textures, and the samplers that must repeat once charts wrap around.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf_primitives.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// One textureInfo of a material.
struct GltfTextureUse {
  Json::json_pointer where;  ///< of the textureInfo, from the root
  std::uint64_t texture = 0;
  bool follows_atlas = false;  ///< it reads the UV set that is rewritten
  bool transformed = false;    ///< by KHR_texture_transform
};

/// All textureInfos of all materials, those in extensions included, in the order of the file.
std::vector<GltfTextureUse> texture_uses(const GltfContents& contents);

/// Writes wrapS and wrapT of all textures that follow the atlas, 10497 on the axes that wrap.
/// Samplers and textures that something else uses too are cloned where this would change them.
void set_repeating_samplers(Json& json, const std::vector<GltfTextureUse>& uses, Wrap wrap);

}  // namespace wrapatlas
