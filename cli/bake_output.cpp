#include "bake_output.h"

#include <fmt/format.h>

#include <algorithm>

namespace wrapatlas::cli {

std::string level_path(const std::string& path, std::size_t level) {
  return fmt::format("{}.{}.png", path.substr(0, path.size() - 4), level);
}

Status save_map(const BakeArguments& a, std::size_t number, Texture& texture) {
  const BakedMap map = a.maps[number];
  MipMaps maps;
  if (a.mips) {
    maps =
        make_mip_maps(std::move(texture), is_direction(map) ? MipFilter::normals : MipFilter::mean);
  } else {
    maps.levels.push_back(std::move(texture));
  }
  const std::string& path = a.outputs[number].path;
  for (std::size_t level = 0; level < maps.levels.size(); ++level) {
    if (map == BakedMap::color) linear_to_srgb(maps.levels[level], a.options.threads);
    const std::string name = level == 0 ? path : level_path(path, level);
    if (const Status ok = save_texture(name, maps.levels[level], a.bits); !ok) return ok;
  }
  return Done{};
}

Json report_of(const BakeArguments& a, const BakeResult& result, double seconds, double baking) {
  const bool is_fitted = a.options.fit && a.options.samples > 1 &&
                         std::any_of(a.maps.begin(), a.maps.end(), is_direction);
  Json maps = Json::array();
  for (std::size_t i = 0; i < a.maps.size(); ++i) {
    maps.push_back({{"kind", name_of(kBakedMaps, a.maps[i])}, {"file", a.outputs[i].path}});
  }
  return {{"version", WRAPATLAS_VERSION},
          {"command", "bake"},
          {"low", a.low},
          {"high", a.high},
          {"maps", maps},
          {"width", a.options.width},
          {"height", a.options.height},
          {"wrap", name_of(kWraps, a.options.wrap)},
          {"samples", a.options.samples},
          {"fit", is_fitted},
          {"bleed", a.options.bleed},
          {"bits", a.bits},
          {"distance", result.distance},
          {"texels_used", result.texels_used},
          {"texels_nearest", result.texels_nearest},
          {"faces_without_uv", result.faces_without_uv},
          {"faces_outside", result.faces_outside},
          {"position_origin", {result.low_corner.x, result.low_corner.y, result.low_corner.z}},
          {"position_extent", result.extent},
          {"threads", a.options.threads},
          {"seconds", {{"total", seconds}, {"bake", baking}}},
          {"peak_memory_mb", peak_memory_mb()}};
}

void summarize(const BakeArguments& a, const BakeResult& result, double seconds) {
  const std::size_t all = std::size_t{1} * a.options.width * a.options.height;
  if (result.faces_without_uv > 0) {
    say("{}: note: {} no UVs, or none of any area, and {} baked\n", a.low,
        quantity(result.faces_without_uv, "face has", "faces have"),
        result.faces_without_uv == 1 ? "is not" : "are not");
  }
  if (result.texels_nearest > 0) {
    const bool many = 4 * result.texels_nearest > result.texels_used;
    say("{}: {}: at {} no ray met {} within {:.4g}; they show its nearest point{}\n", a.low,
        many ? "warning" : "note", quantity(result.texels_nearest, "texel"), a.high,
        result.distance, many ? ": do the two lie over each other? (else --distance)" : "");
  }
  if (a.bits == 8 && std::find(a.maps.begin(), a.maps.end(), BakedMap::positions) != a.maps.end()) {
    say("{}: note: with 8 bits positions are in steps of {:.2g}; --bits 16 has finer ones\n", a.low,
        result.extent / 255);
  }
  if (result.faces_outside > 0) {
    say("{}: warning: {} partly outside the texture, and not baked there: was it packed with "
        "--wrap uv?\n",
        a.low, quantity(result.faces_outside, "face lies", "faces lie"));
  }
  say("{}: {} x {} texels, {:.1f} % of them in use, {:.2f} s -> {}\n", a.low, a.options.width,
      a.options.height, 100.0 * double(result.texels_used) / double(all), seconds, a.output);
}

}  // namespace wrapatlas::cli
