// Walks over the references between the parts of a glTF.
#pragma once

#include <functional>
#include <string>

#include "io/gltf_json.h"

namespace wrapatlas {

/// Calls visit(index) for each member of `holder` named `key`; J is Json or const Json.
template <typename J, typename Visit>
void visit_member(J& holder, const char* key, const Visit& visit) {
  if (!holder.is_object()) return;
  const auto found = holder.find(key);
  if (found != holder.end()) visit(*found);
}

template <typename J, typename Visit>
void visit_elements(J& holder, const char* key, const Visit& visit) {
  visit_member(holder, key, [&](J& array) {
    if (!array.is_array()) return;
    for (auto& element : array) visit(element);
  });
}

template <typename J, typename Visit>
void visit_values(J& object, const Visit& visit) {
  if (!object.is_object()) return;
  for (auto& element : object.items()) visit(element.value());
}

/// Calls visit(number) for each reference to an accessor in meshes, skins and animations.
template <typename J, typename Visit>
void for_each_accessor_use(J& json, const Visit& visit) {
  visit_elements(json, "meshes", [&](J& mesh) {
    visit_elements(mesh, "primitives", [&](J& primitive) {
      visit_member(primitive, "attributes",
                   [&](J& attributes) { visit_values(attributes, visit); });
      visit_member(primitive, "indices", visit);
      visit_elements(primitive, "targets", [&](J& target) { visit_values(target, visit); });
    });
  });
  visit_elements(json, "skins", [&](J& skin) { visit_member(skin, "inverseBindMatrices", visit); });
  visit_elements(json, "animations", [&](J& animation) {
    visit_elements(animation, "samplers", [&](J& sampler) {
      visit_member(sampler, "input", visit);
      visit_member(sampler, "output", visit);
    });
  });
}

/// Calls visit(number) for each reference of one accessor to a buffer view.
template <typename J, typename Visit>
void for_each_view_use(J& accessor, const Visit& visit) {
  visit_member(accessor, "bufferView", visit);
  visit_member(accessor, "sparse", [&](J& sparse) {
    visit_member(sparse, "indices", [&](J& part) { visit_member(part, "bufferView", visit); });
    visit_member(sparse, "values", [&](J& part) { visit_member(part, "bufferView", visit); });
  });
}

/// Calls visit(integer) for each non-negative integer in extensions that may refer to accessors
/// or buffer views, wherever they are.
void for_each_extension_integer(const Json& value, const std::function<void(std::uint64_t)>& visit);

/// Whether a vertex attribute has a type that only KHR_mesh_quantization allows.
bool needs_quantization(const Json& json);

/// Removes `extension` from the object's extensions; true if it was there.
bool remove_extension(Json& object, const char* extension);

/// Takes it off extensionsUsed and extensionsRequired unless some object still has it.
void unlist_extension(Json& json, const std::string& extension);

}  // namespace wrapatlas
