// A new OBJ file: positions, UVs, faces, each under the number of its object if there are several.
#include "io/file.h"
#include "io/formats.h"
#include "io/number.h"

namespace wrapatlas {

Status write_new_obj(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas) {
  const Mesh applied = apply_atlas(mesh, atlas);
  std::string out;
  for (const Vec3& p : applied.positions) {
    out += 'v';
    for (const double value : {p.x, p.y, p.z}) {
      out += ' ';
      append_number(out, value);
    }
    out += '\n';
  }
  for (const Vec2& uv : applied.texcoords) {
    out += "vt ";
    append_float(out, uv.x);
    out += ' ';
    append_float(out, uv.y);
    out += '\n';
  }
  for (std::size_t face = 0; face < applied.face_count(); ++face) {
    const bool is_other = face == 0 ? !applied.face_object.empty()
                                    : applied.object_of(face) != applied.object_of(face - 1);
    if (is_other) {
      out += "o ";
      append_integer(out, std::int64_t{applied.object_of(face)} + 1);
      out += '\n';
    }
    out += 'f';
    for (std::uint32_t c = applied.face_begin[face]; c < applied.face_begin[face + 1]; ++c) {
      out += ' ';
      append_integer(out, std::int64_t{applied.corner_position[c]} + 1);
      if (applied.corner_texcoord[c] == kNone) continue;
      out += '/';
      append_integer(out, std::int64_t{applied.corner_texcoord[c]} + 1);
    }
    out += '\n';
  }
  return write_file(path, out);
}

}  // namespace wrapatlas
