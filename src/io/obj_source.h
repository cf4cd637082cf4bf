// A loaded OBJ file: written back with new UVs, and with other pictures in its materials.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wrapatlas/model.h"

namespace wrapatlas {

struct ObjSource final : Model::Source {
  Status save(const std::filesystem::path& path, const Mesh& mesh,
              const AtlasMesh& atlas) const override;
  [[nodiscard]] Result<ModelTextures> textures(bool base_colors_alone) const override;
  [[nodiscard]] std::vector<std::array<float, 3>> base_factors() const override;
  /// Its material libraries and their pictures, as far as they can be read.
  [[nodiscard]] std::vector<std::filesystem::path> side_files() const;
  /// Beside the model go its materials as one library, and the pictures: "a.obj", "a.mtl",
  /// "a-map_Kd.png".
  Status save(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas,
              std::span<const NewTexture> textures) const override;

  std::string bytes;
  std::filesystem::path folder;             ///< where its material libraries are
  std::vector<std::string> material_files;  ///< as Model has them
  std::vector<std::string> materials;       ///< their names, by the numbers of face_material
};

}  // namespace wrapatlas
