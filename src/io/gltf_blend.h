// Vertex attributes of the vertices that new UVs make necessary: copies, and points between.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf_accessor.h"
#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// A point between three vertices of a primitive.
struct GltfBlend {
  std::array<std::uint32_t, 3> vertices{};
  std::array<double, 3> weights{};
  Vec3 position;
};

/// A vertex added behind those of the file.
struct GltfExtraVertex {
  std::uint32_t source = kNone;  ///< a copy of this one, or kNone: the next of the blends
  std::uint32_t blend = kNone;   ///< index into the blends
};

struct GltfExtraVertices {
  std::vector<GltfExtraVertex> vertices;
  std::vector<GltfBlend> blends;
};

/// Elements are this far apart in what the functions below return: a multiple of 4, as vertex
/// attributes must be.
std::size_t padded_stride(const GltfAccessor& accessor);

/// What the extended attribute is stored as: floats where points between the vertices would move
/// the surface or UVs if they were rounded to integers, else what the accessor has. It has no
/// elements, only their type.
GltfAccessor extended_format(const GltfAccessor& accessor, const std::string& semantic,
                             const GltfExtraVertices& extra);

/// All elements of the accessor, and then those of the extra vertices, as `format` says.
/// `semantic` ("NORMAL", "_TEMPERATURE" ...) says how to blend; deltas of morph targets are plain
/// sums.
std::string extended_attribute(const GltfAccessor& accessor, const GltfAccessor& format,
                               const std::string& semantic, bool is_target,
                               const GltfExtraVertices& extra);

/// The influences of joints on a vertex, JOINTS_n and WEIGHTS_n of all n together: blended by
/// adding up per joint, keeping the heaviest and scaling to a sum of 1. Overwrites the blended
/// elements in the bytes that extended_attribute made.
struct GltfSkinSet {
  const GltfAccessor* joints = nullptr;
  const GltfAccessor* weights = nullptr;
  std::string* joints_bytes = nullptr;
  std::string* weights_bytes = nullptr;
};
void blend_skin(const std::vector<GltfSkinSet>& sets, const GltfExtraVertices& extra);

}  // namespace wrapatlas
