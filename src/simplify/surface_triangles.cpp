#include "simplify/surface_triangles.h"

#include <algorithm>
#include <limits>

#include "mesh/triangulate.h"

namespace wrapatlas {
namespace {

constexpr double kCells = 1023;  ///< along the longest side of the box: ten bits each way

/// Two zero bits before each of the ten.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16U) & 0x030000ffU;
  x = (x | x << 8U) & 0x0300f00fU;
  x = (x | x << 4U) & 0x030c30c3U;
  return (x | x << 2U) & 0x09249249U;
}

/// The triangles by their first corner's place on a Z-curve through the box of all points, so that
/// what is near in space is near in memory too.
std::vector<std::uint32_t> near_in_space(const Mesh& triangles) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Vec3& p : triangles.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 size = high - low;
  const double longest = std::max({size.x, size.y, size.z});
  const auto cell = [&](double from_low) {  // not by a factor, which may be infinite
    return longest > 0 ? spread(static_cast<std::uint32_t>(kCells * (from_low / longest))) : 0;
  };
  std::vector<std::uint64_t> keys(triangles.face_count());
  for (std::size_t t = 0; t < keys.size(); ++t) {
    const Vec3 p = triangles.positions[triangles.corner_position[3 * t]] - low;
    const std::uint32_t place = cell(p.x) | cell(p.y) << 1U | cell(p.z) << 2U;
    keys[t] = std::uint64_t{place} << 32U | t;
  }
  std::sort(keys.begin(), keys.end());
  return {keys.begin(), keys.end()};  // the low halves
}

}  // namespace

SurfaceTriangles surface_triangles(const Mesh& mesh) {
  Triangulated all = triangulated(mesh);
  const std::vector<std::uint32_t> order = near_in_space(all.mesh);
  SurfaceTriangles result;
  Mesh& kept = result.mesh;
  kept.positions = std::move(all.mesh.positions);
  kept.texcoords = std::move(all.mesh.texcoords);
  for (const std::uint32_t t : order) {
    const std::uint32_t* position = all.mesh.corner_position.data() + std::size_t{3} * t;
    const Vec3 a = kept.positions[position[0]], b = kept.positions[position[1]];
    const Vec3 c = kept.positions[position[2]];
    if (a == b || b == c || c == a) {
      ++result.dropped;
      continue;
    }
    const std::uint32_t face = all.face_source[t];
    bool has_uvs = true;
    for (std::uint32_t i = mesh.face_begin[face]; i < mesh.face_begin[face + 1]; ++i) {
      has_uvs = has_uvs && mesh.corner_texcoord[i] != kNone;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      kept.corner_position.push_back(position[i]);
      kept.corner_texcoord.push_back(has_uvs ? all.mesh.corner_texcoord[std::size_t{3} * t + i]
                                             : kNone);
    }
    kept.face_begin.push_back(static_cast<std::uint32_t>(kept.corner_position.size()));
    if (!mesh.face_object.empty()) kept.face_object.push_back(mesh.face_object[face]);
    result.source.push_back(face);
  }
  return result;
}

}  // namespace wrapatlas
