// A new PLY file: binary, positions and faces, UVs in a list `texcoord` per face.
#include <fmt/format.h>

#include <algorithm>

#include "io/file.h"
#include "io/formats.h"
#include "io/ply_header.h"

namespace wrapatlas {
namespace {

bool fits_float(double value) { return double{static_cast<float>(value)} == value; }

PlyType smallest_count(std::size_t largest) {
  return static_cast<double>(largest) > ply_max(PlyType::uint8) ? PlyType::uint32 : PlyType::uint8;
}

}  // namespace

Status write_new_ply(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas) {
  const Mesh applied = apply_atlas(mesh, atlas);
  const bool has_float_positions = std::all_of(
      applied.positions.begin(), applied.positions.end(),
      [](const Vec3& p) { return fits_float(p.x) && fits_float(p.y) && fits_float(p.z); });
  const PlyType coordinate = has_float_positions ? PlyType::float32 : PlyType::float64;
  std::size_t corners = 0;
  for (std::size_t face = 0; face < applied.face_count(); ++face) {
    corners = std::max<std::size_t>(corners, applied.face_size(face));
  }
  const PlyType count = smallest_count(2 * corners);
  const PlyType index = static_cast<double>(applied.positions.size()) > ply_max(PlyType::int32)
                            ? PlyType::uint32
                            : PlyType::int32;
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n"
      "element face {}\nproperty list {} {} vertex_indices\nproperty list {} float texcoord\n"
      "end_header\n",
      applied.positions.size(), ply_name(coordinate), ply_name(coordinate), ply_name(coordinate),
      applied.face_count(), ply_name(count), ply_name(index), ply_name(count));
  const auto append = [&](PlyType type, double value) {
    append_ply(out, PlyEncoding::little, type, value);
  };
  for (const Vec3& p : applied.positions) {
    for (const double value : {p.x, p.y, p.z}) append(coordinate, value);
  }
  for (std::size_t face = 0; face < applied.face_count(); ++face) {
    const std::uint32_t begin = applied.face_begin[face], end = applied.face_begin[face + 1];
    append(count, end - begin);
    bool has_uvs = true;
    for (std::uint32_t c = begin; c < end; ++c) {
      append(index, applied.corner_position[c]);
      has_uvs = has_uvs && applied.corner_texcoord[c] != kNone;
    }
    append(count, has_uvs ? 2.0 * (end - begin) : 0.0);
    for (std::uint32_t c = begin; has_uvs && c < end; ++c) {
      append(PlyType::float32, applied.texcoords[applied.corner_texcoord[c]].x);
      append(PlyType::float32, applied.texcoords[applied.corner_texcoord[c]].y);
    }
  }
  return write_file(path, out);
}

}  // namespace wrapatlas
