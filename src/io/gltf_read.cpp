// glTF 2.0 and GLB to one Mesh.
#include <fmt/format.h>

#include <algorithm>

#include "io/formats.h"
#include "io/gltf_primitives.h"

namespace wrapatlas {

Result<Model> read_gltf(std::string bytes, bool binary, std::string_view name,
                        const std::filesystem::path& base, const LoadOptions& options) {
  if (options.texcoord_set < 0) {
    return Error{ErrorKind::usage, std::string(name),
                 fmt::format("there is no UV set {}", options.texcoord_set), "count from 0"};
  }
  auto contents = std::make_shared<GltfContents>();
  contents->texcoord_name = fmt::format("TEXCOORD_{}", options.texcoord_set);
  Result<GltfFile> file = open_gltf(std::move(bytes), binary, name, base);
  if (!file) return file.error();
  contents->file = *std::move(file);
  if (Status known = check_extensions(contents->file); !known) return known.error();

  Model model;
  model.format = binary ? FileFormat::glb : FileFormat::gltf;
  model.v_points_down = true;
  if (Status read = read_primitives(*contents, model.mesh, model.remarks); !read) {
    return read.error();
  }
  if (model.mesh.face_count() == 0) {
    return contents->file.error("", "it has no triangles", "export a model with faces");
  }
  remark_on_textures(*contents, model.remarks);
  model.source = make_gltf_source(std::move(contents));
  return model;
}

}  // namespace wrapatlas
