// From an edited glTF to files.
#pragma once

#include <filesystem>

#include "io/gltf_edit.h"

namespace wrapatlas {

/// Writes the edited file as GLB or as JSON. Side files of buffers are written first, beside
/// `path`, under names that the source does not use, so that a failure breaks neither the source
/// nor an older `path`.
Status save_gltf(const GltfFile& file, GltfEdit& edit, const std::filesystem::path& path,
                 bool binary);

}  // namespace wrapatlas
