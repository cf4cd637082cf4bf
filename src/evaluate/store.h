// The folder that an evaluation is kept in.
//
//   settings.json     what is measured; a folder holds one setting
//   meshes/ID.json    all of one mesh: it appears whole once the mesh is done
//   charts/           meshes that had to be unwrapped
//   runs.csv          all rows, for people and other programs; written from the rest
#pragma once

#include <filesystem>
#include <vector>

#include "evaluate/mesh_result.h"

namespace wrapatlas {

class Store {
 public:
  /// Makes the folder, or goes on in one of the same setting. Errors: usage (another setting, or a
  /// folder that holds something else), output.
  static Result<Store> open(const std::filesystem::path& folder, const Setting& setting);

  [[nodiscard]] bool has(const std::string& id) const;
  /// Written to a temporary file, then renamed: a killed program leaves all of it or nothing.
  Status put(const MeshResult& result) const;
  [[nodiscard]] std::filesystem::path charts_folder() const { return folder_ / "charts"; }
  /// Writes runs.csv from all meshes there are.
  Status write_csv(const Setting& setting) const;

 private:
  explicit Store(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path folder_;
};

/// All meshes of a folder, by group and name. Errors: input (no such folder, a broken file).
Result<std::vector<MeshResult>> read_results(const std::filesystem::path& folder);

/// Its setting, as setting_json wrote it. Error: input.
Result<Json> read_setting(const std::filesystem::path& folder);

}  // namespace wrapatlas
