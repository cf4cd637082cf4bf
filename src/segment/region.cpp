#include "segment/region.h"

#include "mesh/polygon_plane.h"

namespace wrapatlas {

FaceShapes face_shapes(const Surface& surface) {
  FaceShapes shapes;
  const std::size_t count = surface.face_count();
  shapes.normal.resize(count);
  shapes.centroid.resize(count);
  shapes.area.resize(count);
  for (std::size_t face = 0; face < count; ++face) {
    const std::uint32_t begin = surface.face_begin[face];
    const std::uint32_t size = surface.face_begin[face + 1] - begin;
    const auto point = [&](std::uint32_t i) {
      return surface.points[surface.corner_vertex[begin + i]];
    };
    const Vec3 normal = newell_normal(size, point);
    shapes.area[face] = 0.5 * length(normal);
    shapes.whole_area += shapes.area[face];
    shapes.normal[face] = unit(normal);
    Vec3 sum;
    for (std::uint32_t i = 0; i < size; ++i) sum = sum + point(i);
    shapes.centroid[face] = (1.0 / size) * sum;
  }
  return shapes;
}

Region make_region(const Surface& surface, std::vector<std::uint32_t> faces, FaceOwners& owners,
                   std::uint32_t a, std::uint32_t b) {
  Region region;
  region.faces = std::move(faces);
  for (std::uint32_t i = 0; i < region.size(); ++i) owners.place[region.faces[i]] = i;
  region.arc_begin.reserve(region.size() + std::size_t{1});
  region.arcs.reserve(3 * std::size_t{region.size()});
  for (const std::uint32_t face : region.faces) {
    for (std::uint32_t c = surface.face_begin[face]; c < surface.face_begin[face + 1]; ++c) {
      if (surface.corner_twin[c] == kNone) continue;
      const std::uint32_t other = surface.corner_face[surface.corner_twin[c]];
      const std::uint32_t chart = owners.chart[other];
      if (chart == a || chart == b) {
        region.arcs.push_back({owners.place[other], c});
      }
    }
    region.arc_begin.push_back(static_cast<std::uint32_t>(region.arcs.size()));
  }
  return region;
}

}  // namespace wrapatlas
