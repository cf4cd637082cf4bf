#include "validate/texel_items.h"

#include "validate/close_pairs.h"
#include "validate/polygon.h"
#include "validate/stored.h"

namespace wrapatlas::validate {
namespace {

constexpr double kTextHalfUnit = 5e-9;
constexpr double kLargestRoundedUv = 4;

/// By how much UVs stored with limited precision may be off, relative to their size.
double stored_precision(const Mesh& mesh) {
  Stored stored;
  for (const Vec2 uv : mesh.texcoords) {
    if (!stored.as_floats(uv.x) || !stored.as_floats(uv.y)) return kTextHalfUnit;
  }
  return stored.float_error();
}

}  // namespace

TexelItems items_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_chart, Vec2 size,
                    const std::vector<double>& rounding) {
  TexelItems found;
  found.items.reserve(mesh.face_count());
  std::vector<Vec2> polygon;
  std::vector<Triangle> triangles;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t chart = face_chart[f];
    if (chart == kNone) continue;
    polygon.clear();
    triangles.clear();
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      const Vec2 uv = mesh.texcoords[mesh.corner_texcoord[c]];
      polygon.push_back({uv.x * size.x, uv.y * size.y});
    }
    const double clear = rounding[chart] + kSlack;
    if (cover_polygon(polygon, clear, triangles)) found.crossing_faces.push_back(f);
    for (const Triangle& t : triangles) found.items.push_back({t, chart, chart, chart, f});
  }
  return found;
}

std::vector<double> rounding_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_chart,
                                std::size_t charts, Vec2 size, std::span<const Tile> face_tile) {
  std::vector<Vec2> largest(charts);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (face_chart[f] == kNone) continue;
    const Tile tile = face_tile.empty() ? Tile{} : face_tile[f];
    const Vec2 limit{kLargestRoundedUv + std::abs(tile.column),
                     kLargestRoundedUv + std::abs(tile.row)};
    Vec2& most = largest[face_chart[f]];
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      const Vec2 uv = mesh.texcoords[mesh.corner_texcoord[c]];
      most = {std::max(most.x, std::min(std::abs(uv.x), limit.x)),
              std::max(most.y, std::min(std::abs(uv.y), limit.y))};
    }
  }
  const double relative = stored_precision(mesh);
  std::vector<double> rounding(charts);
  for (std::size_t i = 0; i < charts; ++i) {
    rounding[i] = relative * std::hypot(size.x * largest[i].x, size.y * largest[i].y);
  }
  return rounding;
}

}  // namespace wrapatlas::validate
