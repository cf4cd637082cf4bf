#include "atlas/chart_uvs.h"
#include "atlas/uncut_atlas.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas {

AtlasMesh export_continuous(const Mesh& mesh, const ChartSet& charts, const Packing& packing,
                            bool v_points_down) {
  AtlasMesh atlas = uncut_atlas(mesh);
  atlas.pages = packing.pages;
  std::vector<std::uint32_t> first_texcoord;
  bool leaves_u = false, leaves_v = false;
  for (std::size_t chart = 0; chart < charts.charts.size(); ++chart) {
    first_texcoord.push_back(static_cast<std::uint32_t>(atlas.texcoords.size()));
    const Vec2 tile = tile_offset(packing, chart, v_points_down);
    const bool other_u = tile.x != 0, other_v = tile.y != 0;
    for (const Vec2 uv : atlas_uvs(charts.charts[chart], packing, chart, v_points_down)) {
      leaves_u = leaves_u || other_u || (wraps_u(packing.wrap) && uv.x > 1);
      leaves_v = leaves_v || other_v || (wraps_v(packing.wrap) && (uv.y > 1 || uv.y < 0));
      atlas.texcoords.push_back(uv + tile);
    }
  }
  atlas.wrap = wrap_on(leaves_u, leaves_v);

  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint32_t chart = charts.face_chart[face];
    if (chart == kNone) continue;
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      atlas.corner_texcoord[c] = first_texcoord[chart] + charts.corner_point[c];
    }
  }
  return atlas;
}

}  // namespace wrapatlas
