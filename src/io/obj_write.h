// An OBJ file with new UVs.
#pragma once

#include <string>
#include <string_view>

#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// The bytes of an OBJ file with the UVs of `atlas`. `mesh` is what read_obj made of `bytes`, and
/// `atlas` fits it.
///
/// Only vt lines and the vt indices of f (l, surf) lines differ from `bytes`. A vt line takes the
/// new value in its place; if it needs several, the others stand before the first f line that uses
/// them, and all vt indices become positive and absolute. If faces are cut, their f lines become
/// several, new v, vn and vt lines stand before them, and all indices are renumbered.
std::string rewrite_obj(std::string_view bytes, const Mesh& mesh, const AtlasMesh& atlas);

}  // namespace wrapatlas
