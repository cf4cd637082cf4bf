// The readers and writers behind model.h, one pair per format.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wrapatlas/atlas.h"
#include "wrapatlas/mesh.h"
#include "wrapatlas/model.h"
#include "wrapatlas/result.h"

namespace wrapatlas {

Result<Model> read_gltf(std::string bytes, bool binary, std::string_view name,
                        const std::filesystem::path& base, const LoadOptions& options);
Status write_new_gltf(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas,
                      bool binary);

}  // namespace wrapatlas
