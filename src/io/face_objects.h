// How readers note which faces are of which object.
#pragma once

#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// Says that the faces from `first` on are of `object`; those before have been told. Objects are
/// numbered from 0 in the order of their first faces, and nothing is stored while there is only
/// one.
inline void assign_object(Mesh& mesh, std::size_t first, std::uint32_t object) {
  if (first == mesh.face_count() || (object == 0 && mesh.face_object.empty())) return;
  if (mesh.face_object.empty()) mesh.face_object.assign(first, 0);
  mesh.face_object.resize(mesh.face_count(), object);
}

}  // namespace wrapatlas
