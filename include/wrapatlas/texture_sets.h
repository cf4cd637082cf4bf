// Which faces of a textured model share an atlas, and which textures it will have.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/model_textures.h"
#include "wrapatlas/transfer.h"

namespace wrapatlas {

/// One new texture of a set, for all uses that are read alike: of one role, from the same images.
struct SetTexture {
  TransferTarget target;          ///< points into ModelTextures::images
  std::string name;               ///< of the first of its places: "baseColorTexture"
  std::vector<std::size_t> uses;  ///< of ModelTextures::uses
};

/// Faces that get one new atlas.
struct TextureSet {
  std::vector<std::uint32_t> faces;  ///< of the model, ascending; all have UVs
  Mesh mesh;                         ///< these faces alone, with their UVs
  /// Per face of `mesh`: faces of one group have the same old textures.
  std::vector<std::uint32_t> group;
  std::vector<std::uint8_t> keeps_tangents;  ///< per face of `mesh`, as TransferOptions has it
  std::vector<Vec2> texels;  ///< per group: of its largest texture, per unit of u and of v
  std::vector<SetTexture> textures;
};

/// Sets of materials that have the same textures, in the order of their first faces; or, if they
/// are `merged`, one set of all that have any. Faces without UVs or textures are in none.
/// `face_material` as Model has it. O(n log n).
std::vector<TextureSet> texture_sets(const Mesh& mesh, std::span<const std::uint32_t> face_material,
                                     const ModelTextures& textures, bool merged);

/// The set's mesh with UVs in texels of its old textures, groups apart from each other: what is to
/// be packed for it to keep its detail.
Mesh mesh_in_texels(const TextureSet& set);

/// Scales the UVs of each chart of `mesh` so that its faces have as much area in UV, together, as
/// they have in `texels`, which is the same mesh with other UVs. Charts may come to lie on each
/// other. `face_chart`: per face. Charts that have no area in one of both are scaled as all are
/// together. O(corners).
void scale_to_texels(Mesh& mesh, std::span<const std::uint32_t> face_chart, const Mesh& texels);

/// The share of the area in `texels` that is of faces with less than nine tenths of their texels
/// along a unit in `mesh`, times `scale`: they lose detail. The same faces in both. O(corners).
double share_thinned(const Mesh& mesh, double scale, const Mesh& texels);

}  // namespace wrapatlas
