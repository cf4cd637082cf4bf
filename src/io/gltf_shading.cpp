#include "io/gltf_shading.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/number.h"
#include "mesh/polygon_plane.h"
#include "wrapatlas/transfer.h"

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

Vec3 vector_of(const GltfAccessor& accessor, const char* element) {
  return {accessor.value(element, 0), accessor.value(element, 1), accessor.value(element, 2)};
}

/// Unit, or zero where it is no vector.
Vec3 direction_of(const Vec3& v) {
  const bool usable = std::abs(v.x) + std::abs(v.y) + std::abs(v.z) < kCoordinateLimit;
  return usable ? unit(v) : Vec3{};
}

/// Calls visit(corner, its element of the accessor) for the corners of a primitive.
template <typename Visit>
void for_each_corner(const GltfPrimitive& primitive, const GltfAccessor& accessor, const Mesh& mesh,
                     Visit&& visit) {
  const std::uint32_t first = mesh.face_begin[primitive.first_face];
  const std::uint32_t end = mesh.face_begin[primitive.first_face + primitive.face_count];
  for (std::uint32_t c = first; c < end; ++c) {
    visit(c, accessor.element(mesh.corner_position[c] - primitive.first_position));
  }
}

void read_normals(const GltfPrimitive& primitive, const GltfAccessor& accessor, Model& model) {
  model.corner_normal.resize(model.mesh.corner_count());
  for_each_corner(primitive, accessor, model.mesh, [&](std::uint32_t c, const char* element) {
    model.corner_normal[c] = direction_of(vector_of(accessor, element));
  });
}

void read_tangents(const GltfPrimitive& primitive, const GltfAccessor& accessor, Model& model) {
  if (accessor.components != 4) return;
  model.corner_tangent.resize(model.mesh.corner_count());
  for_each_corner(primitive, accessor, model.mesh, [&](std::uint32_t c, const char* element) {
    model.corner_tangent[c] = {direction_of(vector_of(accessor, element)),
                               accessor.value(element, 3) < 0 ? -1.0F : 1.0F};
  });
}

void read_colors(const GltfPrimitive& primitive, const GltfAccessor& accessor, Model& model) {
  model.corner_color.resize(model.mesh.corner_count(), {1, 1, 1});
  const auto part = [](double value) {
    return static_cast<float>(value > 0 ? std::min(value, 1.0) : 0);
  };
  for_each_corner(primitive, accessor, model.mesh, [&](std::uint32_t c, const char* element) {
    const Vec3 color = vector_of(accessor, element);
    model.corner_color[c] = {part(color.x), part(color.y), part(color.z)};
  });
}

struct Attribute {
  const char* name;
  void (*read)(const GltfPrimitive&, const GltfAccessor&, Model&);
};
constexpr Attribute kAttributes[] = {
    {"NORMAL", read_normals}, {"TANGENT", read_tangents}, {"COLOR_0", read_colors}};

}  // namespace

Status read_gltf_shading(const GltfContents& contents, Model& model) {
  for (const GltfPrimitive& primitive : contents.primitives) {
    for (const auto& [name, read] : kAttributes) {
      const auto accessor = open_attribute(contents, primitive, name);
      if (!accessor) return accessor.error();
      if (*accessor) read(primitive, **accessor, model);
    }
  }
  return Done{};
}

const Json* specular_glossiness(const Json& material) {
  const Json* extensions = find_member(material, "extensions");
  return extensions == nullptr ? nullptr
                               : find_member(*extensions, "KHR_materials_pbrSpecularGlossiness");
}

std::vector<std::array<float, 3>> read_gltf_factors(const GltfContents& contents) {
  std::vector<std::array<float, 3>> factors{kNoFactor};  // of faces without a material
  for (const Json& material : array_member(contents.file.json, "materials")) {
    std::array<float, 3>& factor = factors.emplace_back(kNoFactor);
    const auto read = [&factor](const Json* holder, const char* key) {
      if (holder == nullptr) return;
      const Json& values = array_member(*holder, key);
      for (std::size_t c = 0; c < 3 && values.size() >= 3; ++c) {
        if (values[c].is_number()) factor[c] = std::clamp(values[c].get<float>(), 0.0F, 1.0F);
      }
    };
    if (const Json* glossy = specular_glossiness(material)) {
      read(glossy, "diffuseFactor");
    } else {
      read(find_member(material, "pbrMetallicRoughness"), "baseColorFactor");
    }
  }
  return factors;
}

}  // namespace wrapatlas
