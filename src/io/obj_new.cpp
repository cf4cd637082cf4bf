// A new OBJ file: positions, UVs, faces, each under the number of its object if there are several.
#include <algorithm>
#include <numeric>

#include "io/file.h"
#include "io/formats.h"
#include "io/number.h"

namespace wrapatlas {
namespace {

/// Objects one after the other: a name that came back would begin an object of its own.
std::vector<std::uint32_t> faces_by_object(const Mesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  std::stable_sort(faces.begin(), faces.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.object_of(a) < mesh.object_of(b);
  });
  return faces;
}

}  // namespace

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
  std::uint32_t object = kNone;  // of the last face
  for (const std::uint32_t face : faces_by_object(applied)) {
    if (!applied.face_object.empty() && applied.object_of(face) != object) {
      object = applied.object_of(face);
      out += "o ";
      append_integer(out, std::int64_t{object} + 1);
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
