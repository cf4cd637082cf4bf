// The textures of a loaded model: what its materials use, and others in their place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wrapatlas/transfer.h"

namespace wrapatlas {

/// A place of a material at which a texture is named, and read by the UVs that were loaded.
struct TextureUse {
  std::uint32_t material = 0;  ///< as Model::face_material numbers it
  std::string place;           ///< within the material: "normalTexture"
  TextureRole role = TextureRole::data;
  std::size_t image = 0;  ///< into ModelTextures::images
  TransferSource source;  ///< how it is read; its texture is null
};

struct ModelTextures {
  std::vector<Texture> images;
  std::vector<TextureUse> uses;  ///< in the order of the file
  /// Per face: its vertices have tangents of their own; empty: no face's have.
  std::vector<std::uint8_t> face_has_tangents;
  bool has_variants = false;  ///< faces have other materials too (KHR_materials_variants)
};

/// Does a place hold the colour of the surface: baseColorTexture, diffuseTexture, map_Kd?
bool is_base_color(std::string_view place);

/// A texture that takes the place of others.
struct NewTexture {
  std::string png;                ///< the bytes of the file
  std::string name;               ///< "baseColorTexture"
  std::vector<std::size_t> uses;  ///< of ModelTextures::uses
};

/// The colours that the materials of a model give its faces.
struct BaseColors {
  BaseColors() = default;
  BaseColors(BaseColors&&) = default;
  BaseColors& operator=(BaseColors&&) = default;
  BaseColors(const BaseColors&) = delete;  // `groups` point into `maps`
  BaseColors& operator=(const BaseColors&) = delete;
  ~BaseColors() = default;

  std::vector<MipMaps> maps;              ///< linear light
  std::vector<GroupColor> groups;         ///< empty: no material has any
  std::vector<std::uint32_t> face_group;  ///< per face; empty with `groups`
};

class Model;

/// Decodes all textures that follow the loaded UVs, or base colours alone. Errors: usage (a format
/// without textures), input (a texture that is missing, or neither PNG nor JPEG).
Result<ModelTextures> load_textures(const Model& model, bool base_colors_alone = false);

/// The textures of base colours alone (baseColorTexture, diffuseTexture, map_Kd), and the factors
/// of materials (baseColorFactor, diffuseFactor; Kd where there is no map_Kd). No textures, without
/// an error, for formats that have none and for meshes without UVs. Errors: input.
Result<BaseColors> base_colors(const Model& model, int threads = 0);

}  // namespace wrapatlas
