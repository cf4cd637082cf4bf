// An OBJ file with new UVs.
#pragma once

#include <string_view>

#include "io/file.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// Hands on the bytes, piece by piece, of an OBJ file with the UVs of `atlas`. `mesh` is what
/// read_obj made of `bytes`, and `atlas` fits it.
///
/// Only vt lines and the vt indices of f (l, surf) lines differ from `bytes`. A vt line takes the
/// new value in its place; if it needs several, the others stand before the first f line that uses
/// them, and all vt indices become positive and absolute. If faces are cut, their f lines become
/// several, new v, vn and vt lines stand before them, and all indices are renumbered.
/// If a `material_file` is named, it takes the place of those that the file names.
/// Stops at the first error of `put` and returns it.
Status rewrite_obj(std::string_view bytes, const Mesh& mesh, const AtlasMesh& atlas,
                   std::string_view material_file, const PutBytes& put);

}  // namespace wrapatlas
