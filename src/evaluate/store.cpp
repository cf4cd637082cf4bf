#include "evaluate/store.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "io/file.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;

fs::path setting_path(const fs::path& folder) { return folder / "settings.json"; }
fs::path meshes_folder(const fs::path& folder) { return folder / "meshes"; }

Status make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error) return Done{};
  return Error{ErrorKind::output, path.string(),
               fmt::format("cannot make this folder ({})", error.message()),
               "choose another with -o"};
}

/// What the option that made an entry of the setting is called.
std::string option_of(const std::string& name) {
  if (name == "contenders") return "--methods";
  if (name == "width" || name == "height") return "--resolution";
  if (name == "inner") return "--no-inner";
  if (name == "unwrap") return "--max-stretch, --unwrap";
  std::string option = "--" + name;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::string in_words(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::vector<std::string> contenders;
  for (const Json& one : value) {
    contenders.push_back(one.value("name", "?") + " (wrap " + one.value("wrap", "?") + ")");
  }
  return fmt::format("{}", fmt::join(contenders, ", "));
}

/// "--padding: 0 there, 2 here": the first value that differs.
std::string difference(const Json& there, const Json& here) {
  for (const auto& [name, value] : here.items()) {
    const Json other = there.contains(name) ? there.at(name) : Json();
    if (other == value) continue;
    return fmt::format("{}: {} there, {} here", option_of(name), in_words(other), in_words(value));
  }
  return "it is of another version";
}

/// "2" before "10", words by letters.
std::tuple<std::size_t, std::string> natural(const std::string& text) {
  const bool number = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return {number ? text.size() : 0, text};
}

bool in_order(const MeshResult& a, const MeshResult& b) {
  if (a.facts.group != b.facts.group) return a.facts.group < b.facts.group;
  return natural(fs::path(a.facts.file).stem().string()) <
         natural(fs::path(b.facts.file).stem().string());
}

}  // namespace

Result<Store> Store::open(const fs::path& folder, const Setting& setting) {
  std::error_code error;
  const bool is_new = !fs::exists(setting_path(folder), error);
  if (is_new && fs::exists(folder, error) && !fs::is_empty(folder, error)) {
    return Error{ErrorKind::usage, folder.string(), "holds something else than results of bench",
                 "give -o a new folder"};
  }
  for (const fs::path& path : {folder, meshes_folder(folder), folder / "charts"}) {
    if (const Status ok = make_folder(path); !ok) return ok.error();
  }
  const Json here = setting_json(setting);
  if (is_new) {
    if (const Status ok = write_file(setting_path(folder), here.dump(1) + "\n"); !ok) {
      return ok.error();
    }
    return Store(folder);
  }
  const auto there = read_setting(folder);
  if (!there) return there.error();
  if (*there != here) {
    return Error{ErrorKind::usage, folder.string(),
                 "holds results of another setting: " + difference(*there, here),
                 "give -o another folder, or the same options"};
  }
  return Store(folder);
}

bool Store::has(const std::string& id) const {
  std::error_code ignored;
  return fs::exists(meshes_folder(folder_) / (id + ".json"), ignored);
}

Status Store::put(const MeshResult& result) const {
  return write_file(meshes_folder(folder_) / (result.facts.id + ".json"),
                    result_json(result).dump() + "\n");
}

Status Store::write_csv(const Setting& setting) const {
  const auto results = read_results(folder_);
  if (!results) return results.error();
  std::string text = csv_header();
  for (const MeshResult& result : *results) text += csv_rows(result, setting);
  return write_file(folder_ / "runs.csv", text);
}

Result<std::vector<MeshResult>> read_results(const fs::path& folder) {
  std::vector<MeshResult> results;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(meshes_folder(folder), error)) {
    if (entry.path().extension() != ".json") continue;
    const auto text = read_file(entry.path());
    if (!text) return text.error();
    auto result = result_from(*text);
    if (!result) {
      Error broken = result.error();
      broken.where = entry.path().string();
      return broken;
    }
    results.push_back(std::move(*result));
  }
  if (error) {
    return Error{ErrorKind::input, folder.string(),
                 fmt::format("holds no results ({})", error.message()),
                 "give the folder that wrapatlas bench -o made"};
  }
  std::sort(results.begin(), results.end(), in_order);
  return results;
}

Result<Json> read_setting(const fs::path& folder) {
  const auto text = read_file(setting_path(folder));
  if (!text) {
    return Error{ErrorKind::input, folder.string(), "holds no results of bench",
                 "give the folder that wrapatlas bench -o made"};
  }
  try {
    return Json::parse(*text);
  } catch (const Json::exception&) {
    return Error{ErrorKind::input, setting_path(folder).string(), "not what bench wrote there",
                 "run bench again with another folder"};
  }
}

}  // namespace wrapatlas
