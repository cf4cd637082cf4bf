// Some faces of a mesh as a mesh of their own.
#pragma once

#include <cstdint>
#include <span>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// The named faces in the order given, with the positions and UVs that they use and no others.
Mesh select_faces(const Mesh& mesh, std::span<const std::uint32_t> faces);

}  // namespace wrapatlas
