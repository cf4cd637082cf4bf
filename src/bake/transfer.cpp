// What a transfer needs before it can begin.
#include "wrapatlas/transfer.h"

#include <algorithm>

#include "bake/drawable.h"
#include "bake/resampler.h"

namespace wrapatlas {
namespace {

Status check(const Mesh& before, const Mesh& after, std::span<const std::uint32_t> group,
             std::span<const TransferTarget> targets, const TransferOptions& options) {
  const auto usage = [](const char* where, const char* what, const char* remedy) {
    return Error{ErrorKind::usage, where, what, remedy};
  };
  if (!(options.bleed >= 0)) return usage("bleed", "less than 0", "0 leaves it to dilation");
  if (Status size = check_texture_size(options.width, options.height); !size) return size;
  if (before.face_begin != after.face_begin || before.corner_position != after.corner_position) {
    return usage("meshes", "they differ in more than their UVs", "pass the same faces");
  }
  if (before.texcoords.empty() || after.texcoords.empty()) {
    return Error{ErrorKind::input, "mesh", "it has no UVs", "unwrap it first"};
  }
  if (!options.keeps_tangents.empty() && options.keeps_tangents.size() != before.face_count()) {
    return usage("tangents", "not one for each face", "pass one for each, or none");
  }
  if (group.size() != before.face_count()) {
    return usage("groups", "not one for each face", "pass one for each");
  }
  for (const TransferTarget& target : targets) {
    if (target.channels < 1 || target.channels > kMostChannels) {
      return usage("channels", "not from 1 to 4", "choose another count");
    }
    if (!group.empty() && *std::max_element(group.begin(), group.end()) >= target.of_group.size()) {
      return usage("groups", "a face's has no entry", "pass an entry for each group");
    }
  }
  return Done{};
}

/// Only triangles that have UVs in both.
void drop_faces_without_uv(const Triangulated& before, Triangulated& after) {
  for (std::size_t c = 0; c < after.mesh.corner_count(); ++c) {
    if (before.mesh.corner_texcoord[c] == kNone) after.mesh.corner_texcoord[c] = kNone;
  }
}

}  // namespace

Result<std::vector<Texture>> transfer(const Mesh& before, const Mesh& after,
                                      std::span<const std::uint32_t> group,
                                      std::span<const TransferTarget> targets,
                                      const TransferOptions& options) {
  if (const Status ok = check(before, after, group, targets, options); !ok) return ok.error();
  const Triangulated from = triangulated(before);
  Triangulated to = triangulated(after);
  drop_faces_without_uv(from, to);
  const TexelSamples samples(to.mesh, options.width, options.height, options.wrap,
                             options.v_points_down, 1);
  if (const Status ok = check_samples(samples, to, "after"); !ok) return ok.error();
  auto bleed =
      Bleed::build(to.mesh, samples, options.width, options.height, options.wrap, options.bleed);
  if (!bleed) return bleed.error();
  std::vector<Texture> textures;
  Resampler resampler(from, to, group, options, samples, *bleed);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    textures.emplace_back(options.width, options.height, targets[i].channels);
    if (!resampler.run(targets[i], textures.back(), i, targets.size())) {
      return Error{ErrorKind::interrupted, "", "stopped", ""};
    }
  }
  return textures;
}

}  // namespace wrapatlas
