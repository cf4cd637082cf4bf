#include "output_paths.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/file.h"
#include "options.h"

namespace wrapatlas::cli {
namespace {

namespace fs = std::filesystem;

/// Devices and pipes take any number of outputs.
bool is_file(const std::string& path) {
  if (path.empty() || path == "-") return false;
  std::error_code code;
  const fs::file_type type = fs::status(path, code).type();
  return type == fs::file_type::regular || type == fs::file_type::not_found;
}

Status refuse(std::span<const OutputPath> outputs, const fs::path& read, const char* what) {
  for (const OutputPath& output : outputs) {
    if (!is_file(output.path) || !same_file(output.path, read)) continue;
    return usage(fmt::format("{} {}", output.option, output.path),
                 fmt::format("it would overwrite {}", what), "give another name");
  }
  return Done{};
}

}  // namespace

Status refuse_equal_outputs(std::span<const OutputPath> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputPath& output = outputs[i];
    if (!is_file(output.path)) continue;
    for (const OutputPath& other : outputs.first(i)) {
      if (!is_file(other.path) || !same_file(output.path, other.path)) continue;
      return usage(fmt::format("{} {}", output.option, output.path),
                   fmt::format("{} names the same file", other.option),
                   "give each output a name of its own");
    }
  }
  return Done{};
}

Status refuse_overwriting(const std::string& input, const Model& model,
                          std::span<const OutputPath> outputs) {
  if (const Status ok = refuse(outputs, input, "the input"); !ok) return ok;
  for (const fs::path& file : model.side_files) {
    if (const Status ok = refuse(outputs, file, "a file of the input"); !ok) return ok;
  }
  for (const std::string& name : model.material_files) {
    const fs::path file = fs::path(input).parent_path() / name;
    if (const Status ok = refuse(outputs, file, "a file of the input"); !ok) return ok;
  }
  return Done{};
}

}  // namespace wrapatlas::cli
