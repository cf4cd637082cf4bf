// Which primitives of a glTF are in the Mesh, and where.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf_accessor.h"
#include "io/gltf_json.h"
#include "wrapatlas/model.h"

namespace wrapatlas {

/// One triangle primitive. Its faces are a run of the Mesh's, its vertices a run of the positions:
/// vertex v of the primitive is position first_position + v.
struct GltfPrimitive {
  std::uint32_t mesh = 0, primitive = 0;  ///< where it is in the JSON
  std::uint32_t first_face = 0, face_count = 0;
  std::uint32_t first_position = 0, vertex_count = 0;
  bool has_texcoords = false;  ///< of the set that was asked for
};

/// What save needs to know of a loaded file.
struct GltfContents {
  GltfFile file;
  std::string texcoord_name;              ///< "TEXCOORD_0"
  std::vector<GltfPrimitive> primitives;  ///< in the order of their faces
};

/// The primitive's object in `json`.
inline const Json& primitive_json(const Json& json, const GltfPrimitive& primitive) {
  return json["meshes"][primitive.mesh]["primitives"][primitive.primitive];
}
inline Json& primitive_json(Json& json, const GltfPrimitive& primitive) {
  return json["meshes"][primitive.mesh]["primitives"][primitive.primitive];
}

/// Appends the triangles of all meshes to `mesh`, each as an object, and lists their primitives.
Status read_primitives(GltfContents& contents, const LoadOptions& options, Mesh& mesh,
                       std::vector<std::string>& remarks);

/// Refuses files whose geometry is in an extension that we do not know.
Status check_extensions(const GltfFile& file);

/// What the user should know of textures, once for the file.
void remark_on_textures(const GltfContents& contents, std::vector<std::string>& remarks);

/// The part of a loaded glTF that writes it back.
std::unique_ptr<Model::Source> make_gltf_source(std::shared_ptr<const GltfContents> contents);

}  // namespace wrapatlas
