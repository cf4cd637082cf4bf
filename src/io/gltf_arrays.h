// The arrays of planned primitives: from layers to accessors.
#pragma once

#include "io/gltf_edit.h"
#include "io/gltf_layers.h"

namespace wrapatlas {

/// Adds the accessors of all layers and points the planned primitives to them. `edit` borrows UVs
/// and indices from `plans`, and from the vectors given to the functions below.
Status write_arrays(const GltfContents& contents, const GltfPlans& plans, GltfEdit& edit);

/// "min" and "max" of `count` elements as an accessor's JSON has them: raw values, tight.
void set_bounds(Json& json, const GltfAccessor& accessor, std::string_view bytes,
                std::size_t stride);

/// Indices in the smallest type that is at least `smallest` and can name `vertex_count` vertices.
std::uint64_t add_indices(GltfEdit& edit, const std::vector<std::uint32_t>& indices,
                          std::size_t vertex_count, GltfComponent smallest);

/// UVs as float pairs.
std::uint64_t add_uvs(GltfEdit& edit, const std::vector<GltfUv>& uvs);

}  // namespace wrapatlas
