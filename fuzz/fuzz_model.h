// What every fuzzer of a model format does: read the bytes, write what was read as it is and cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "../tests/support/hand_made_atlas.h"
#include "wrapatlas/model.h"

namespace wrapatlas {

inline int fuzz_model(const std::uint8_t* data, std::size_t size, FileFormat format) {
  std::string bytes(data, data + size);
  const Result<Model> model = load_model_bytes(std::move(bytes), format, "fuzz", {});
  if (!model) return 0;
  if (!validate_mesh(model->mesh)) std::abort();
  for (const AtlasMesh& atlas :
       {identity_atlas(model->mesh), torn_atlas(model->mesh), halved_atlas(model->mesh, 0.3)}) {
    if (!validate_mesh(apply_atlas(model->mesh, atlas))) std::abort();
    if (!model->source) continue;
    if (!model->source->save("/dev/null", model->mesh, atlas) && !atlas.is_cut()) std::abort();
  }
  return 0;
}

/// The file's own normals and colours, and what its materials use. `/nonexistent` has no pictures.
inline void fuzz_shading(const std::string& bytes, FileFormat format) {
  LoadOptions options;
  options.shading = true;
  const Result<Model> model = load_model_bytes(bytes, format, "fuzz", "/nonexistent/fuzz", options);
  if (!model) return;
  const Mesh& mesh = model->mesh;
  const std::size_t normals = model->corner_normal.size(), colors = model->position_color.size();
  if (normals != 0 && normals != mesh.corner_count()) std::abort();
  if (colors != 0 && colors != mesh.positions.size()) std::abort();
  if (const Result<ModelTextures> textures = load_textures(*model)) {
    for (const TextureUse& use : textures->uses) {
      if (use.image >= textures->images.size()) std::abort();
    }
  }
  const Result<BaseColors> base = base_colors(*model);
  if (!base) return;
  if (!base->groups.empty() && base->face_group.size() != mesh.face_count()) std::abort();
  for (const std::uint32_t group : base->face_group) {
    if (group >= base->groups.size()) std::abort();
  }
}

}  // namespace wrapatlas
