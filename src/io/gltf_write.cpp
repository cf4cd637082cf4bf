// A loaded glTF with new UVs.
#include <algorithm>

#include "io/gltf_arrays.h"
#include "io/gltf_images.h"
#include "io/gltf_primitives.h"
#include "io/gltf_save.h"
#include "io/gltf_shading.h"
#include "io/gltf_textures.h"

namespace wrapatlas {
namespace {

/// A path's ending decides between GLB and JSON; any other keeps what was read.
bool wants_glb(const std::filesystem::path& path, bool was_glb) {
  const std::string ending = path.extension().string();
  const auto is = [&](std::string_view other) {
    return std::equal(ending.begin(), ending.end(), other.begin(), other.end(), [](char a, char b) {
      return a == b || (a >= 'A' && a <= 'Z' && a + 32 == b);
    });
  };
  return is(".glb") || (was_glb && !is(".gltf"));
}

class GltfSource : public Model::Source {
 public:
  explicit GltfSource(std::shared_ptr<const GltfContents> contents)
      : contents_(std::move(contents)) {}

  Status save(const std::filesystem::path& path, const Mesh& mesh,
              const AtlasMesh& atlas) const override {
    return save(path, mesh, atlas, {});
  }

  [[nodiscard]] Result<ModelTextures> textures(bool base_colors_alone) const override {
    return read_gltf_textures(*contents_, base_colors_alone);
  }

  [[nodiscard]] std::vector<std::array<float, 3>> base_factors() const override {
    return read_gltf_factors(*contents_);
  }

  Status save(const std::filesystem::path& path, const Mesh& mesh, const AtlasMesh& atlas,
              std::span<const NewTexture> textures) const override {
    GltfEdit edit(contents_->file);
    const Result<GltfPlans> plans = plan_vertices(*contents_, mesh, atlas);
    if (!plans) return plans.error();
    if (Status written = write_arrays(*contents_, *plans, edit); !written) return written;
    set_repeating_samplers(edit.json, texture_uses(*contents_), atlas.wrap);
    if (!textures.empty()) replace_gltf_textures(*contents_, textures, edit);
    edit.finish();
    return save_gltf(contents_->file, edit, path, wants_glb(path, contents_->file.binary));
  }

 private:
  std::shared_ptr<const GltfContents> contents_;
};

}  // namespace

std::unique_ptr<Model::Source> make_gltf_source(std::shared_ptr<const GltfContents> contents) {
  return std::make_unique<GltfSource>(std::move(contents));
}

}  // namespace wrapatlas
