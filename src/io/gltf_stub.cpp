#include "io/formats.h"

namespace wrapatlas {

Result<Model> read_gltf(std::string, bool, std::string_view name, const std::filesystem::path&,
                        const LoadOptions&) {
  return Error{ErrorKind::input, std::string(name), "this build cannot read glTF", "use .obj"};
}

Status write_new_gltf(const std::filesystem::path& path, const Mesh&, const AtlasMesh&, bool) {
  return Error{ErrorKind::output, path.string(), "this build cannot write glTF", "use .obj"};
}

}  // namespace wrapatlas
