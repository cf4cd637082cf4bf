// Extensions that hide geometry, and textures that the new UVs leave behind.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "io/gltf_primitives.h"
#include "io/gltf_textures.h"

namespace wrapatlas {
namespace {

/// On meshes and primitives, but beside the geometry.
constexpr std::string_view kHarmless[] = {
    "KHR_materials_variants",   "EXT_mesh_features", "EXT_structural_metadata",
    "CESIUM_primitive_outline", "FB_ngon_encoding",  "KHR_mesh_quantization",
    "EXT_meshopt_compression",  // its buffers were checked for a fallback
    "KHR_meshopt_compression"};

bool extended_by(const Json& value, const std::string& extension) {
  const Json* extensions = find_member(value, "extensions");
  return extensions != nullptr && find_member(*extensions, extension.c_str()) != nullptr;
}

void add_extensions(const Json& value, std::set<std::string>& names) {
  const Json* extensions = find_member(value, "extensions");
  if (extensions == nullptr) return;
  for (const auto& item : extensions->items()) names.insert(item.key());
}

/// An extension that we do not know can change the geometry only from where the geometry is.
std::set<std::string> extensions_of_geometry(const Json& json) {
  std::set<std::string> names;
  for (const char* directory : {"buffers", "bufferViews", "accessors", "meshes"}) {
    for (const Json& value : array_member(json, directory)) {
      add_extensions(value, names);
      for (const Json& primitive : array_member(value, "primitives")) {
        add_extensions(primitive, names);
      }
    }
  }
  return names;
}

/// Draco may be optional, but then the accessors must hold the data as well.
bool draco_without_fallback(const Json& json) {
  const Json& accessors = array_member(json, "accessors");
  for (const Json& mesh : array_member(json, "meshes")) {
    for (const Json& primitive : array_member(mesh, "primitives")) {
      if (!extended_by(primitive, "KHR_draco_mesh_compression")) continue;
      const Json* attributes = find_member(primitive, "attributes");
      const Json* position = attributes == nullptr ? nullptr : find_member(*attributes, "POSITION");
      const auto index = position == nullptr ? std::nullopt : as_integer(*position);
      if (index && *index < accessors.size() && !accessors[*index].contains("bufferView"))
        return true;
    }
  }
  return false;
}

Error compressed(const GltfFile& file, std::string_view extension) {
  return file.error("", fmt::format("its geometry needs {}, which is not supported", extension),
                    "decompress it first, e.g. with gltf-transform");
}

}  // namespace

Status check_extensions(const GltfFile& file) {
  const std::set<std::string> geometry = extensions_of_geometry(file.json);
  for (const Json& name : array_member(file.json, "extensionsRequired")) {
    if (!name.is_string()) return file.error("extensionsRequired", "an entry is not a string");
    const auto& extension = name.get_ref<const std::string&>();
    if (std::find(std::begin(kHarmless), std::end(kHarmless), extension) != std::end(kHarmless))
      continue;
    if (geometry.count(extension) != 0) return compressed(file, extension);
  }
  if (draco_without_fallback(file.json)) return compressed(file, "KHR_draco_mesh_compression");
  return Done{};
}

void remark_on_textures(const GltfContents& contents, std::vector<std::string>& remarks) {
  const std::vector<GltfTextureUse> uses = texture_uses(contents);
  const auto ours = [](const GltfTextureUse& use) { return use.follows_atlas; };
  const auto moved = [](const GltfTextureUse& use) { return use.follows_atlas && use.transformed; };
  if (std::any_of(uses.begin(), uses.end(), ours)) {
    remarks.push_back("its textures are made for its UVs: with new ones bake or transfer them");
  }
  if (std::any_of(uses.begin(), uses.end(), moved)) {
    remarks.push_back(fmt::format(
        "KHR_texture_transform on textures that use {}: it stays, and moves the new UVs as well",
        contents.texcoord_name));
  }
}

}  // namespace wrapatlas
