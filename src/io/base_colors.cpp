#include <utility>

#include "wrapatlas/model.h"
#include "wrapatlas/model_textures.h"

namespace wrapatlas {

bool is_base_color(std::string_view place) {
  for (const char* name : {"baseColorTexture", "diffuseTexture", "map_Kd"}) {
    if (place.ends_with(name)) return true;
  }
  return false;
}

Result<BaseColors> base_colors(const Model& model, int threads) {
  BaseColors own;
  if (model.mesh.texcoords.empty() || !model.source) return own;
  auto textures = load_textures(model, true);
  if (!textures) {
    if (textures.error().kind == ErrorKind::usage) return own;
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
    if (own.groups.size() <= use.material) own.groups.resize(use.material + std::size_t{1});
    own.groups[use.material] = {&maps, use.source};
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
