// A model file: read it, look at its mesh, write it back with new UVs.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "wrapatlas/atlas.h"
#include "wrapatlas/mesh.h"
#include "wrapatlas/model_textures.h"
#include "wrapatlas/result.h"
#include "wrapatlas/tangents.h"

namespace wrapatlas {

enum class FileFormat { obj, off, ply, stl, gltf, glb };

/// By the file's ending, case ignored. Error: usage, listing the endings known.
Result<FileFormat> format_from_path(const std::filesystem::path& path);

struct LoadOptions {
  int texcoord_set = 0;  ///< K of TEXCOORD_K (glTF)
  /// The set may also be the one after the last that the primitives have: the mesh has no UVs then,
  /// and save_model adds the set (glTF; the other formats have one, which may always be missing).
  bool may_add_set = false;
  bool shading = false;  ///< fill Model::corner_normal, corner_tangent and corner_color
  /// The mesh is what the scene shows, meshes placed by the nodes that have them (glTF). Not for
  /// models that are to be saved as glTF with all else that they hold.
  bool in_scene = false;
};

/// A file in memory: its mesh, and what is needed to write it back unchanged but for the UVs.
/// Movable, not copyable.
class Model {
 public:
  /// Format-private part of a loaded file, kept to write it back.
  struct Source {
    virtual ~Source() = default;
    /// Writes the file with the UVs of `atlas`; `path` names side files (.bin). For save_model,
    /// which has checked that the atlas belongs to the mesh.
    virtual Status save(const std::filesystem::path& path, const Mesh& mesh,
                        const AtlasMesh& atlas) const = 0;
    /// For load_textures, and for save_model with other textures. Error: usage, where the format
    /// has none.
    [[nodiscard]] virtual Result<ModelTextures> textures(bool base_colors_alone) const;
    virtual Status save(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas,
                        std::span<const NewTexture> textures) const;
    /// Per material of face_material, as GroupColor has it; it may be shorter. For base_colors.
    [[nodiscard]] virtual std::vector<std::array<float, 3>> base_factors() const { return {}; }
  };

  Mesh mesh;
  std::vector<std::uint32_t> face_material;  ///< per face a number of its material; empty: all one
  /// Per corner of the mesh, unit, or zero where there is none; empty: the file has none, or
  /// LoadOptions::shading is off.
  std::vector<Vec3> corner_normal;
  /// Per corner of the mesh (glTF's TANGENT); empty as above.
  std::vector<CornerTangent> corner_tangent;
  /// Per corner of the mesh: red, green, blue in linear light; empty as above.
  std::vector<std::array<float, 3>> corner_color;
  FileFormat format = FileFormat::obj;
  std::vector<std::string> remarks;         ///< what was repaired or left aside, one line each
  std::vector<std::string> material_files;  ///< that an OBJ names (mtllib), as written there
  std::vector<std::filesystem::path>
      side_files;                  ///< that it refers to: buffers, materials, pictures
  bool v_points_down = false;      ///< v = 0 is the top row of the texture (glTF)
  std::unique_ptr<Source> source;  ///< null for formats that cannot hold UVs
};

/// Reads a model. The mesh passes validate_mesh. Errors name file and line (or accessor).
Result<Model> load_model(const std::filesystem::path& path, const LoadOptions& options = {});

/// Reads a model from bytes, as load_model does; `name` stands in errors. Side files are looked up
/// beside `base`. For fuzzers and callers with their own file systems.
Result<Model> load_model_bytes(std::string bytes, FileFormat format, std::string_view name,
                               const std::filesystem::path& base, const LoadOptions& options = {});

/// Whether save_model writes what was read in one format back whole in the other: else the mesh
/// alone, which LoadOptions::in_scene then places as the nodes did.
bool keeps_all(FileFormat output, FileFormat input);

/// Writes the model with new UVs. Same format as read (gltf and glb count as one): everything else
/// is kept. Another format (obj, ply, gltf, glb): positions, faces, UVs and which faces are of
/// one object, alone. Written to a temporary file beside `path` and renamed, so a failure leaves
/// nothing half-written.
Status save_model(const Model& model, const AtlasMesh& atlas, const std::filesystem::path& path);

/// Whether save_model with textures can write to that path, which must be of the model's own
/// format. Errors: usage.
Status takes_textures(const Model& model, const std::filesystem::path& path);

/// The same with other textures in the place of those that they were made from. `path` is of the
/// model's own format. Errors: usage (another format, or one without textures), output.
Status save_model(const Model& model, const AtlasMesh& atlas, const std::filesystem::path& path,
                  std::span<const NewTexture> textures);

/// A mesh with `atlas` applied: what load_model would read back, but for rounding.
Mesh apply_atlas(const Mesh& mesh, const AtlasMesh& atlas);

}  // namespace wrapatlas
