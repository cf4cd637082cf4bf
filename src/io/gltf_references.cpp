#include "io/gltf_references.h"

#include <algorithm>
#include <string_view>

#include "io/gltf_accessor.h"

namespace wrapatlas {
namespace {

/// Extensions whose integers are no accessors and no buffer views.
bool refers_to_textures_at_most(std::string_view extension) {
  for (const std::string_view prefix :
       {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"}) {
    if (extension.starts_with(prefix)) return true;
  }
  return false;
}

void visit_integers(const Json& value, const std::function<void(std::uint64_t)>& visit) {
  if (value.is_structured()) {
    for (const Json& member : value) visit_integers(member, visit);
  } else if (const auto number = as_integer(value)) {
    visit(*number);
  }
}

bool is_quantized(const Json& accessors, const std::string& name, const Json& index) {
  const auto number = as_integer(index);
  if (!number || *number >= accessors.size()) return false;
  const Json& accessor = accessors[*number];
  const auto component =
      static_cast<GltfComponent>(integer_member(accessor, "componentType", 0).value_or(0));
  if (component == GltfComponent::f32) return false;
  if (name == "POSITION" || name == "NORMAL" || name == "TANGENT") return true;
  if (!name.starts_with("TEXCOORD_")) return false;
  const Json* normalized = find_member(accessor, "normalized");
  const bool is_signed = component == GltfComponent::i8 || component == GltfComponent::i16;
  return is_signed || normalized == nullptr || *normalized != true;
}

bool is_any_quantized(const Json& accessors, const Json& attributes) {
  if (!attributes.is_object()) return false;
  for (const auto& [name, index] : attributes.items()) {
    if (is_quantized(accessors, name, index)) return true;
  }
  return false;
}

bool is_used(const Json& value, const std::string& extension) {
  if (!value.is_structured()) return false;
  const Json* extensions = find_member(value, "extensions");
  if (extensions != nullptr && find_member(*extensions, extension.c_str()) != nullptr) return true;
  return std::any_of(value.begin(), value.end(),
                     [&](const Json& member) { return is_used(member, extension); });
}

}  // namespace

void for_each_extension_integer(const Json& value,
                                const std::function<void(std::uint64_t)>& visit) {
  if (!value.is_structured()) return;
  if (const Json* extensions = find_member(value, "extensions"); extensions != nullptr) {
    for (const auto& [name, extension] : extensions->items()) {
      if (!refers_to_textures_at_most(name)) visit_integers(extension, visit);
    }
  }
  for (const Json& member : value) for_each_extension_integer(member, visit);
}

bool needs_quantization(const Json& json) {
  const Json& accessors = array_member(json, "accessors");
  for (const Json& mesh : array_member(json, "meshes")) {
    for (const Json& primitive : array_member(mesh, "primitives")) {
      const Json* attributes = find_member(primitive, "attributes");
      if (attributes != nullptr && is_any_quantized(accessors, *attributes)) return true;
      for (const Json& target : array_member(primitive, "targets")) {
        if (is_any_quantized(accessors, target)) return true;
      }
    }
  }
  return false;
}

bool remove_extension(Json& object, const char* extension) {
  if (!object.is_object()) return false;
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return false;
  if (extensions->erase(extension) == 0) return false;
  if (extensions->empty()) object.erase("extensions");
  return true;
}

void unlist_extension(Json& json, const std::string& extension) {
  if (is_used(json, extension)) return;
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const auto names = json.find(list);
    if (names == json.end() || !names->is_array()) continue;
    Json kept = Json::array();
    for (const Json& name : *names) {
      if (name != extension) kept.push_back(name);
    }
    if (kept.empty()) {
      json.erase(list);
    } else {
      *names = std::move(kept);
    }
  }
}

}  // namespace wrapatlas
