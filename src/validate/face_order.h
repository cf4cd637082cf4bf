// The order in which a format that holds meshes of primitives would have a mesh's faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas::validate {

/// The faces object by object, in the order of their first faces; in each object those with UVs
/// before those without. O(n log n).
std::vector<std::uint32_t> order_by_object(const Mesh& mesh);

/// The mesh with face order[i] as face i. Its objects are left out.
Mesh reordered(const Mesh& mesh, std::span<const std::uint32_t> order);

}  // namespace wrapatlas::validate
