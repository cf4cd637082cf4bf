// One reader per file format, and the writers of files that are new rather than edited.
// load_model_bytes and save_model choose among them; nothing else calls them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wrapatlas/model.h"

namespace wrapatlas {

/// Each reader takes the whole file and keeps its bytes if it can be written back. `name` stands
/// in errors. Meshes are checked for indices and coordinates, so that errors can name the line.
Result<Model> read_obj(std::string bytes, std::string_view name, const std::filesystem::path& base,
                       bool shading);
Result<Model> read_off(const std::string& bytes, std::string_view name);
Result<Model> read_ply(std::string bytes, std::string_view name, bool shading);
Result<Model> read_stl(std::string bytes, std::string_view name);
Result<Model> read_gltf(std::string bytes, bool binary, std::string_view name,
                        const std::filesystem::path& base, const LoadOptions& options);

/// Each writes positions, faces and UVs to a new file. The UVs stand in the format's own
/// convention: save_model has turned them upside down where that differs from the source's.
Status write_new_obj(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas);
Status write_new_ply(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas);
Status write_new_gltf(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas,
                      bool binary);

}  // namespace wrapatlas
