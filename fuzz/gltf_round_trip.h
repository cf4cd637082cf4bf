// What both glTF fuzzers do: read, give every other face new UVs, write, and cut.
#pragma once

#include <cstdlib>
#include <string>

#include "../src/io/formats.h"

namespace wrapatlas {

/// Faces with UVs in one of two places, by the parity of their number.
inline AtlasMesh fuzz_atlas(const Mesh& mesh) {
  AtlasMesh atlas;
  atlas.wrap = Wrap::uv;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      const bool has = mesh.corner_texcoord[c] != kNone;
      atlas.corner_source.push_back(c);
      atlas.corner_cut.push_back(kNone);
      atlas.corner_texcoord.push_back(has ? static_cast<std::uint32_t>(atlas.texcoords.size())
                                          : kNone);
      if (has) atlas.texcoords.push_back({c % 3 * 0.5, f % 2 * 0.25});
    }
    atlas.face_source.push_back(f);
    atlas.face_begin.push_back(static_cast<std::uint32_t>(atlas.corner_source.size()));
  }
  return atlas;
}

/// Each face cut in two at the middle of its first edge.
inline AtlasMesh fuzz_cut(const Mesh& mesh) {
  AtlasMesh atlas;
  const auto add = [&](std::uint32_t source, std::uint32_t cut, bool has) {
    atlas.corner_source.push_back(source);
    atlas.corner_cut.push_back(cut);
    atlas.corner_texcoord.push_back(has ? 0 : kNone);
  };
  atlas.texcoords.push_back({0.5, 0.5});
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t c = mesh.face_begin[f];
    const bool has = mesh.corner_texcoord[c] != kNone;
    atlas.cut_points.push_back({{c, c + 1, c}, {0.5, 0.5, 0}, f});
    for (const std::uint32_t side : {c, c + 1}) {
      add(side == c ? c : kNone, side == c ? kNone : f, has);
      add(side == c ? kNone : c + 1, side == c ? f : kNone, has);
      add(c + 2, kNone, has);
      atlas.face_source.push_back(f);
      atlas.face_begin.push_back(static_cast<std::uint32_t>(atlas.corner_source.size()));
    }
  }
  atlas.cut_position_count = static_cast<std::uint32_t>(mesh.face_count());
  return atlas;
}

inline void fuzz_gltf(std::string bytes, bool binary) {
  const Result<Model> model =
      read_gltf(std::move(bytes), binary, "fuzz", "/nonexistent/fuzz", LoadOptions{});
  if (!model) return;
  if (!validate_mesh(model->mesh)) std::abort();
  if (model->mesh.face_count() > 5000) return;  // time is better spent on other inputs
  for (const AtlasMesh& atlas : {fuzz_atlas(model->mesh), fuzz_cut(model->mesh)}) {
    if (!model->source->save("/dev/null", model->mesh, atlas)) std::abort();
  }
}

}  // namespace wrapatlas
