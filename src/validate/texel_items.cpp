#include "validate/texel_items.h"

#include <charconv>

#include "validate/polygon.h"

namespace wrapatlas::validate {
namespace {

constexpr double kFloatHalfUnit = 1.0 / (1 << 24);
constexpr double kTextHalfUnit = 5e-9;
constexpr double kLargestRoundedUv = 4;

/// Is the number what one reads where someone wrote a float with no more digits than it takes?
bool is_short_text_of_float(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, static_cast<float>(x)).ptr;
  double read = 0;
  std::from_chars(text, end, read);
  return read == x;
}

/// By how much UVs stored with limited precision may be off, relative to their size.
double stored_precision(const Mesh& mesh) {
  bool floats = true;
  for (const Vec2 uv : mesh.texcoords) {
    for (const double x : {uv.x, uv.y}) {
      if (static_cast<double>(static_cast<float>(x)) == x) continue;
      if (!is_short_text_of_float(x)) return kTextHalfUnit;
      floats = false;
    }
  }
  return floats ? kFloatHalfUnit : 2 * kFloatHalfUnit;  // rounded to a float, and that to text
}

}  // namespace

std::vector<Item> items_of(const Mesh& mesh, const std::vector<std::uint32_t>& face_chart,
                           Vec2 size) {
  std::vector<Item> items;
  items.reserve(mesh.face_count());
  std::vector<Vec2> polygon;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (face_chart[f] == kNone) continue;
    polygon.clear();
    triangles.clear();
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      const Vec2 uv = mesh.texcoords[mesh.corner_texcoord[c]];
      polygon.push_back({uv.x * size.x, uv.y * size.y});
    }
    cut_into_triangles(polygon, triangles);
    for (const auto& t : triangles) {
      items.push_back({{polygon[t[0]], polygon[t[1]], polygon[t[2]]},
                       face_chart[f],
                       face_chart[f],
                       face_chart[f],
                       f});
    }
  }
  return items;
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
