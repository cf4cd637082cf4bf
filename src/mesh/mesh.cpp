#include "wrapatlas/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string_view>
#include <unordered_map>

namespace wrapatlas {
namespace {

bool usable(double value) { return std::abs(value) < 1e30; }  // false for NaN as well

Error bad_mesh(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::input, std::move(where), std::move(what), std::move(remedy)};
}

/// The first i < count with bad(i), or count. Looks at many before it branches, so that compilers
/// can test several at once.
template <typename Bad>
std::size_t first_bad(std::size_t count, const Bad& bad) {
  constexpr std::size_t kBlock = 256;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(count, begin + kBlock);
    bool any = false;
    for (std::size_t i = begin; i < end; ++i) any |= bad(i);
    if (!any) continue;
    while (!bad(begin)) ++begin;
    return begin;
  }
  return count;
}

struct Vec3Hash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
    for (const double value : {p.x, p.y, p.z}) {
      hash ^= std::bit_cast<std::uint64_t>(value + 0.0);  // -0 + 0 is +0
      hash *= 0xff51afd7ed558ccdULL;
      hash ^= hash >> 32U;
    }
    return hash;
  }
};

}  // namespace

Status validate_mesh(const Mesh& mesh) {
  const auto unusable = [](std::string_view what, std::size_t i) {
    return bad_mesh(fmt::format("{} {}", what, i), "a coordinate is not a usable number",
                    "export the mesh again without NaN, infinite or huge values");
  };
  const std::size_t position = first_bad(mesh.positions.size(), [&](std::size_t i) {
    const Vec3& p = mesh.positions[i];
    return !usable(p.x) || !usable(p.y) || !usable(p.z);
  });
  if (position != mesh.positions.size()) return unusable("vertex", position);
  const std::size_t texcoord = first_bad(mesh.texcoords.size(), [&](std::size_t i) {
    return !usable(mesh.texcoords[i].x) || !usable(mesh.texcoords[i].y);
  });
  if (texcoord != mesh.texcoords.size()) return unusable("texture coordinate", texcoord);
  if (mesh.face_begin.empty() || mesh.face_begin.front() != 0 ||
      mesh.face_begin.back() != mesh.corner_position.size() ||
      mesh.corner_texcoord.size() != mesh.corner_position.size()) {
    return bad_mesh("mesh", "corner arrays differ in length", "pass one entry per corner in each");
  }
  if (!mesh.face_object.empty() && mesh.face_object.size() != mesh.face_count()) {
    return bad_mesh("mesh", "the objects of some faces are missing",
                    "pass one entry per face, or none");
  }
  const std::size_t face = first_bad(mesh.face_count(), [&](std::size_t f) {
    return mesh.face_begin[f + 1] < mesh.face_begin[f] + 3;
  });
  if (face != mesh.face_count()) {
    return bad_mesh(fmt::format("face {}", face), "it has fewer than three corners",
                    "remove the face");
  }
  const auto positions = mesh.positions.size(), texcoords = mesh.texcoords.size();
  const std::size_t corner = first_bad(mesh.corner_count(), [&](std::size_t c) {
    const std::uint32_t uv = mesh.corner_texcoord[c];
    return (mesh.corner_position[c] >= positions) | ((uv >= texcoords) & (uv != kNone));
  });
  if (corner != mesh.corner_count()) {
    const bool position_ok = mesh.corner_position[corner] < positions;
    return bad_mesh(
        fmt::format("corner {}", corner),
        fmt::format("it refers to {} {} of {}", position_ok ? "UV" : "vertex",
                    position_ok ? mesh.corner_texcoord[corner] : mesh.corner_position[corner],
                    position_ok ? texcoords : positions),
        "export the mesh again");
  }
  return Done{};
}

std::vector<std::uint32_t> weld_positions(std::span<const Vec3> positions) {
  std::unordered_map<Vec3, std::uint32_t, Vec3Hash> first;
  first.reserve(positions.size());
  std::vector<std::uint32_t> welded(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    welded[i] = first.try_emplace(positions[i], i).first->second;
  }
  return welded;
}

WeldedCorners weld_corners(const Mesh& mesh) {
  const std::vector<std::uint32_t> place = weld_positions(mesh.positions);
  WeldedCorners points;
  points.count = static_cast<std::uint32_t>(place.size());
  points.of_corner.reserve(mesh.corner_count());
  for (const std::uint32_t position : mesh.corner_position) {
    points.of_corner.push_back(place[position]);
  }
  if (mesh.face_object.empty()) return points;
  // The first object at a place takes the place's own number; further ones get new numbers.
  std::vector<std::uint32_t> first_object(place.size(), kNone);
  std::vector<bool> is_taken(place.size(), false);
  std::unordered_map<std::uint64_t, std::uint32_t> further;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t object = mesh.face_object[face];
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      std::uint32_t& point = points.of_corner[c];
      if (!is_taken[point]) first_object[point] = object;
      is_taken[point] = true;
      if (first_object[point] == object) continue;
      const std::uint64_t key = (std::uint64_t{point} << 32U) | object;
      const auto [found, is_new] = further.try_emplace(key, points.count);
      if (is_new) ++points.count;
      point = found->second;
    }
  }
  return points;
}

void triangulate_polygon(std::span<const Vec2> points,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto count = static_cast<std::uint32_t>(points.size());
  if (count == 3) {
    triangles.push_back({0, 1, 2});
    return;
  }
  double area = 0;
  for (std::uint32_t i = 0; i < count; ++i) area += cross(points[i], points[(i + 1) % count]);
  const double sign = area < 0 ? -1 : 1;

  std::vector<std::uint32_t> ring(count);
  for (std::uint32_t i = 0; i < count; ++i) ring[i] = i;
  const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return sign * signed_area2(points[a], points[b], points[c]);
  };
  const auto is_ear = [&](std::size_t i) {
    const std::size_t size = ring.size();
    const std::uint32_t a = ring[(i + size - 1) % size], b = ring[i], c = ring[(i + 1) % size];
    if (turn(a, b, c) <= 0) return false;
    for (const std::uint32_t p : ring) {
      if (p == a || p == b || p == c) continue;
      if (points[p] == points[a] || points[p] == points[b] || points[p] == points[c]) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  };
  while (ring.size() > 3) {
    std::size_t ear = 0;
    while (ear < ring.size() && !is_ear(ear)) ++ear;
    if (ear == ring.size()) break;  // degenerate or self-crossing: fan the rest
    const std::size_t size = ring.size();
    triangles.push_back({ring[(ear + size - 1) % size], ring[ear], ring[(ear + 1) % size]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    triangles.push_back({ring[0], ring[i], ring[i + 1]});
  }
}

}  // namespace wrapatlas
