// The large model files that reading and writing are timed on.
#pragma once

#include <cstddef>
#include <filesystem>

#include "wrapatlas/result.h"

namespace wrapatlas::bench {

/// A bumpy sheet of quads, each two triangles, in square patches with UVs of their own.
struct Sheet {
  static constexpr int kPatch = 50;  ///< quads along a patch's side
  int columns = 0, rows = 0;         ///< patches

  [[nodiscard]] std::size_t patches() const { return std::size_t(columns) * std::size_t(rows); }
  [[nodiscard]] std::size_t triangles() const { return patches() * 2 * kPatch * kPatch; }
  /// Points of the surface.
  [[nodiscard]] std::size_t positions() const {
    return (std::size_t(columns) * kPatch + 1) * (std::size_t(rows) * kPatch + 1);
  }
  /// UVs; in GLB, where both share one index, vertices.
  [[nodiscard]] std::size_t texcoords() const { return patches() * (kPatch + 1) * (kPatch + 1); }
};

/// The sheet of about that many triangles, at least one patch.
Sheet sheet_of(int triangles);

Status write_sheet_obj(const Sheet& sheet, const std::filesystem::path& path);

/// The binary chunk starts with all positions, then all UVs, then the indices.
Status write_sheet_glb(const Sheet& sheet, const std::filesystem::path& path);

}  // namespace wrapatlas::bench
