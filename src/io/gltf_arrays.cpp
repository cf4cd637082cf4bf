#include "io/gltf_arrays.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/gltf_references.h"

namespace wrapatlas {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kManifold = "EXT_mesh_manifold";
constexpr const char* kQuantization = "KHR_mesh_quantization";

template <typename T>
std::string packed_as(const std::vector<std::uint32_t>& indices) {
  std::string bytes(indices.size() * sizeof(T), '\0');
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto value = static_cast<T>(indices[i]);
    std::memcpy(bytes.data() + i * sizeof(T), &value, sizeof(T));
  }
  return bytes;
}

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// One set of attributes, or one morph target, on its way to longer arrays.
class Extender {
 public:
  Extender(const GltfContents& contents, const GltfLayer& layer, GltfEdit& edit)
      : contents_(contents), layer_(layer), edit_(edit) {}

  /// Replaces all accessors in `attributes` but the UVs that are rewritten.
  Status extend(Json& attributes, bool is_target) {
    std::vector<Attribute> arrays;
    for (const auto& [name, index] : attributes.items()) {
      if (!is_target && name == contents_.texcoord_name) continue;
      const Result<GltfAccessor> accessor = open_accessor(contents_.file, *as_integer(index));
      if (!accessor) return accessor.error();
      const GltfAccessor format = extended_format(*accessor, name, layer_.extra());
      arrays.push_back({name, *accessor, format,
                        extended_attribute(*accessor, format, name, is_target, layer_.extra())});
    }
    if (!is_target) blend_skins(arrays);
    for (Attribute& array : arrays) attributes[array.name] = add(array);
    return Done{};
  }

 private:
  struct Attribute {
    std::string name;
    GltfAccessor accessor, format;
    std::string bytes;  ///< in that format
  };

  void blend_skins(std::vector<Attribute>& arrays) const {
    const auto find = [&](const std::string& name) -> Attribute* {
      for (Attribute& array : arrays) {
        if (array.name == name && array.accessor.components == 4) return &array;
      }
      return nullptr;
    };
    std::vector<GltfSkinSet> sets;
    for (std::size_t n = 0;; ++n) {
      Attribute* joints = find("JOINTS_" + std::to_string(n));
      Attribute* weights = find("WEIGHTS_" + std::to_string(n));
      if (joints == nullptr || weights == nullptr) break;
      sets.push_back({&joints->accessor, &weights->accessor, &joints->bytes, &weights->bytes});
    }
    if (!sets.empty() && !layer_.extra().blends.empty()) blend_skin(sets, layer_.extra());
  }

  std::uint64_t add(Attribute& array) {
    Json json = edit_.json["accessors"][array.accessor.index];
    json.erase("byteOffset");
    json.erase("sparse");
    const std::size_t stride = padded_stride(array.format);
    if (array.format.component != array.accessor.component) {
      json["componentType"] = static_cast<int>(array.format.component);
      json.erase("normalized");
    }
    json["count"] = array.bytes.size() / stride;
    if (array.name == "POSITION" || json.contains("min") || json.contains("max")) {
      set_bounds(json, array.format, array.bytes, stride);
    }
    return edit_.add_accessor(std::move(json), std::move(array.bytes),
                              stride == array.format.element_size ? 0 : stride,
                              GltfTarget::vertices);
  }

  const GltfContents& contents_;
  const GltfLayer& layer_;
  GltfEdit& edit_;
};

GltfComponent old_index_type(const GltfContents& contents, const Json& primitive) {
  const Json* indices = find_member(primitive, "indices");
  if (indices == nullptr) return GltfComponent::u16;
  const Result<GltfAccessor> accessor = open_accessor(contents.file, *as_integer(*indices));
  return accessor ? accessor->component : GltfComponent::u16;
}

}  // namespace

void set_bounds(Json& json, const GltfAccessor& accessor, std::string_view bytes,
                std::size_t stride) {
  GltfAccessor raw = accessor;
  raw.normalized = false;
  const bool is_float = raw.component == GltfComponent::f32;
  json.erase("min");
  json.erase("max");
  if (raw.matrix) return;
  Json lowest = Json::array(), highest = Json::array();
  for (std::size_t c = 0; c < raw.components; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t at = 0; at < bytes.size(); at += stride) {
      const double value = raw.value(bytes.data() + at, c);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (!std::isfinite(low) || !std::isfinite(high)) return;
    if (is_float) {
      lowest.push_back(low);
      highest.push_back(high);
    } else {
      lowest.push_back(static_cast<std::int64_t>(low));
      highest.push_back(static_cast<std::int64_t>(high));
    }
  }
  json["min"] = std::move(lowest);
  json["max"] = std::move(highest);
}

std::uint64_t add_indices(GltfEdit& edit, const std::vector<std::uint32_t>& indices,
                          std::size_t vertex_count, GltfComponent smallest) {
  // The largest value of each type means "primitive restart" to some graphics interfaces.
  GltfComponent type = smallest;
  if (vertex_count > 255 && type == GltfComponent::u8) type = GltfComponent::u16;
  if (vertex_count > 65535) type = GltfComponent::u32;
  Json json = {
      {"componentType", static_cast<int>(type)}, {"count", indices.size()}, {"type", "SCALAR"}};
  if (type == GltfComponent::u32) {
    return edit.add_accessor(std::move(json), bytes_of(indices), GltfTarget::indices);
  }
  return edit.add_accessor(std::move(json),
                           type == GltfComponent::u8 ? packed_as<std::uint8_t>(indices)
                                                     : packed_as<std::uint16_t>(indices),
                           0, GltfTarget::indices);
}

std::uint64_t add_uvs(GltfEdit& edit, const std::vector<GltfUv>& uvs) {
  Json json = {{"componentType", static_cast<int>(GltfComponent::f32)},
               {"count", uvs.size()},
               {"type", "VEC2"}};
  return edit.add_accessor(std::move(json), bytes_of(uvs), GltfTarget::vertices);
}

Status write_arrays(const GltfContents& contents, const GltfPlans& plans, GltfEdit& edit) {
  struct Arrays {
    bool made = false;
    Json attributes, targets;
  };
  std::vector<Arrays> arrays(plans.layers.size());
  bool draco = false, manifold = false;
  for (const GltfPlan& plan : plans.plans) {
    const GltfLayer& layer = plans.layers[plan.layer];
    Arrays& made = arrays[plan.layer];
    Json& json = primitive_json(edit.json, *plan.primitive);
    if (!made.made) {
      made.made = true;
      made.attributes = json["attributes"];
      made.targets = array_member(json, "targets");
      if (!layer.extra().vertices.empty()) {
        Extender extender(contents, layer, edit);
        if (Status done = extender.extend(made.attributes, false); !done) return done;
        for (Json& target : made.targets) {
          if (Status done = extender.extend(target, true); !done) return done;
        }
      }
      if (plan.has_texcoords) {
        made.attributes[contents.texcoord_name] = add_uvs(edit, layer.uvs());
      }
    }
    json["attributes"] = made.attributes;
    if (!made.targets.empty()) json["targets"] = made.targets;
    if (plan.new_indices) {
      json["indices"] =
          add_indices(edit, plan.indices, layer.uvs().size(), old_index_type(contents, json));
      if (json.contains("mode")) json["mode"] = 4;
    }
    // Copies of the old geometry that readers would prefer.
    if (remove_extension(json, kDraco)) draco = true;
    Json& mesh = edit.json["meshes"][plan.primitive->mesh];
    if (plan.new_indices && remove_extension(mesh, kManifold)) manifold = true;
  }
  if (draco) unlist_extension(edit.json, kDraco);
  if (manifold) unlist_extension(edit.json, kManifold);
  // It is no object of the file, so what is listed has to be known from the types.
  if (needs_quantization(contents.file.json) && !needs_quantization(edit.json)) {
    unlist_extension(edit.json, kQuantization);
  }
  return Done{};
}

}  // namespace wrapatlas
