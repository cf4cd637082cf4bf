#include "io/gltf_shading.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/number.h"
#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

/// One value per vertex, of three numbers or more; nothing where the primitive has none.
Result<std::optional<GltfAccessor>> open_attribute(const GltfContents& contents,
                                                   const GltfPrimitive& primitive,
                                                   const char* name) {
  const Json& attributes = primitive_json(contents.file.json, primitive)["attributes"];
  const auto found = attributes.find(name);
  const auto index = found == attributes.end() ? std::nullopt : as_integer(*found);
  if (!index) return std::optional<GltfAccessor>();
  const Result<GltfAccessor> accessor = open_accessor(contents.file, *index);
  if (!accessor) return accessor.error();
  const bool usable =
      !accessor->matrix && accessor->components >= 3 && accessor->count == primitive.vertex_count;
  return usable ? std::optional(*accessor) : std::nullopt;
}

void read_normals(const GltfPrimitive& primitive, const GltfAccessor& accessor, Model& model) {
  const Mesh& mesh = model.mesh;
  model.corner_normal.resize(mesh.corner_count());
  const std::uint32_t first = mesh.face_begin[primitive.first_face];
  const std::uint32_t end = mesh.face_begin[primitive.first_face + primitive.face_count];
  for (std::uint32_t c = first; c < end; ++c) {
    const char* element = accessor.element(mesh.corner_position[c] - primitive.first_position);
    const Vec3 n{accessor.value(element, 0), accessor.value(element, 1),
                 accessor.value(element, 2)};
    const bool usable = std::abs(n.x) + std::abs(n.y) + std::abs(n.z) < kCoordinateLimit;
    model.corner_normal[c] = usable ? unit(n) : Vec3{};
  }
}

void read_colors(const GltfPrimitive& primitive, const GltfAccessor& accessor, Model& model) {
  model.position_color.resize(model.mesh.positions.size(), {1, 1, 1});
  for (std::size_t i = 0; i < accessor.count; ++i) {
    const char* element = accessor.element(i);
    for (std::size_t c = 0; c < 3; ++c) {
      const double part = accessor.value(element, c);
      model.position_color[primitive.first_position + i][c] =
          static_cast<float>(part > 0 ? std::min(part, 1.0) : 0);
    }
  }
}

}  // namespace

Status read_gltf_shading(const GltfContents& contents, Model& model) {
  for (const GltfPrimitive& primitive : contents.primitives) {
    const auto normals = open_attribute(contents, primitive, "NORMAL");
    if (!normals) return normals.error();
    if (*normals) read_normals(primitive, **normals, model);
    const auto colors = open_attribute(contents, primitive, "COLOR_0");
    if (!colors) return colors.error();
    if (*colors) read_colors(primitive, **colors, model);
  }
  return Done{};
}

}  // namespace wrapatlas
