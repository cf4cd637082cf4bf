// Normals and colours of a glTF's vertices.
#pragma once

#include "io/gltf_primitives.h"

namespace wrapatlas {

/// Fills Model::corner_normal (NORMAL), corner_tangent (TANGENT) and corner_color (COLOR_0; white
/// where a primitive has none) of a model whose mesh is there. Errors: input.
Status read_gltf_shading(const GltfContents& contents, Model& model);

/// What KHR_materials_pbrSpecularGlossiness says of a material; null: nothing. Its diffuse colour
/// and texture count then, in place of the base colour beside them.
const Json* specular_glossiness(const Json& material);

/// Per material, counted as Model::face_material does: the factor of its base (or diffuse) colour.
std::vector<std::array<float, 3>> read_gltf_factors(const GltfContents& contents);

}  // namespace wrapatlas
