#include <utility>

#include "io/mtl.h"
#include "wrapatlas/model.h"
#include "wrapatlas/model_textures.h"

namespace wrapatlas {

bool is_base_color(std::string_view place) {
  return place.ends_with("baseColorTexture") || place.ends_with("diffuseTexture") ||
         lower(place) == "map_kd";
}

namespace {

GroupColor& group_of(std::size_t material, BaseColors& own) {
  if (own.groups.size() <= material) own.groups.resize(material + 1);
  return own.groups[material];
}

Status add_textures(const Model& model, int threads, BaseColors& own) {
  auto textures = load_textures(model, true);
  if (!textures) {
    if (textures.error().kind == ErrorKind::usage) return Done{};
    return textures.error();
  }
  own.maps.resize(textures->images.size());
  for (const TextureUse& use : textures->uses) {
    MipMaps& maps = own.maps[use.image];
    if (maps.levels.empty()) {
      Texture& image = textures->images[use.image];
      srgb_to_linear(image, threads);
      maps = make_mip_maps(std::move(image), MipFilter::mean);
    }
    GroupColor& group = group_of(use.material, own);
    group.maps = &maps;
    group.source = use.source;
  }
  return Done{};
}

}  // namespace

Result<BaseColors> base_colors(const Model& model, int threads) {
  BaseColors own;
  if (!model.source) return own;
  if (!model.mesh.texcoords.empty()) {
    if (const Status ok = add_textures(model, threads, own); !ok) return ok.error();
  }
  // Beside colours of vertices an OBJ's Kd is, as beside a map_Kd, what its exporter left there.
  const bool painted = model.format == FileFormat::obj && !model.corner_color.empty();
  const auto factors = painted ? std::vector<std::array<float, 3>>() : model.source->base_factors();
  for (std::size_t material = 0; material < factors.size(); ++material) {
    if (factors[material] != kNoFactor) group_of(material, own).factor = factors[material];
  }
  if (own.groups.empty()) return own;
  own.face_group = model.face_material;
  own.face_group.resize(model.mesh.face_count());
  for (const std::uint32_t group : own.face_group) {
    if (own.groups.size() <= group) own.groups.resize(group + std::size_t{1});
  }
  return own;
}

}  // namespace wrapatlas
