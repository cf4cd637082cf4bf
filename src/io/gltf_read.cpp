// glTF 2.0 and GLB to one Mesh.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "io/face_labels.h"
#include "io/formats.h"
#include "io/gltf_primitives.h"
#include "io/gltf_scene.h"
#include "io/gltf_shading.h"

namespace wrapatlas {
namespace {

std::vector<std::filesystem::path> files_beside(const GltfFile& file) {
  std::vector<std::filesystem::path> paths;
  for (const GltfSideFile& buffer : file.side_files) paths.push_back(buffer.path);
  for (const Json& image : array_member(file.json, "images")) {
    const Json* uri = find_member(image, "uri");
    if (uri == nullptr || !uri->is_string()) continue;
    const auto& text = uri->get_ref<const std::string&>();
    if (text.starts_with("data:") || !is_plain_relative_uri(text)) continue;
    if (const auto name = percent_decode(text)) paths.push_back(file.folder / *name);
  }
  return paths;
}

/// Faces of primitives without a material have number 0.
std::vector<std::uint32_t> materials_of(const GltfContents& contents) {
  std::vector<std::uint32_t> labels;
  for (const GltfPrimitive& primitive : contents.primitives) {
    const Json& json = primitive_json(contents.file.json, primitive);
    const auto found = json.find("material");
    const std::uint64_t known = array_member(contents.file.json, "materials").size();
    std::uint64_t number = known;  // none
    if (found != json.end()) number = as_integer(*found).value_or(known);
    const std::uint64_t label = number < known ? number + 1 : 0;
    assign_label(labels, primitive.first_face, primitive.first_face + primitive.face_count,
                 static_cast<std::uint32_t>(label));
  }
  return labels;
}

}  // namespace

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
  if (Status read = read_primitives(*contents, options, model.mesh, model.remarks); !read) {
    return read.error();
  }
  if (model.mesh.face_count() == 0) {
    return contents->file.error("", "it has no triangles", "export a model with faces");
  }
  model.face_material = materials_of(*contents);
  if (options.shading) {
    if (Status read = read_gltf_shading(*contents, model); !read) return read.error();
  }
  if (options.in_scene) {
    if (Status placed = place_in_scene(*contents, model); !placed) return placed.error();
  }
  remark_on_textures(*contents, model.remarks);
  model.side_files = files_beside(contents->file);
  model.source = make_gltf_source(std::move(contents));
  return model;
}

}  // namespace wrapatlas
