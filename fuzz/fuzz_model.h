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

}  // namespace wrapatlas
