#include "io/obj_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/file.h"
#include "io/mtl.h"
#include "io/obj_lines.h"
#include "io/obj_write.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;

struct Library {
  fs::path path;
  std::string bytes;
};

bool is_file(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// Files named with another system's slashes, or by a folder of another machine, are looked for
/// beside the file that names them as well.
fs::path find_beside(const fs::path& folder, const std::string& name) {
  const fs::path slashed = with_slashes(name);
  for (const fs::path& path : {folder / name, folder / slashed, folder / slashed.filename()}) {
    if (is_file(path)) return path;
  }
  return folder / slashed;
}

fs::path picture_path(const fs::path& library, const MtlMap& map) {
  return find_beside(library.parent_path(), std::string(map.picture));
}

/// A line may name several, and one name may hold blanks.
std::vector<fs::path> library_paths(const ObjSource& source) {
  std::vector<fs::path> paths;
  for (const std::string& line : source.material_files) {
    const fs::path whole = find_beside(source.folder, line);
    if (is_file(whole) || line.find(' ') == std::string::npos) {
      paths.push_back(whole);
      continue;
    }
    ObjWords words(line);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      paths.push_back(find_beside(source.folder, std::string(word)));
    }
  }
  return paths;
}

Result<std::vector<Library>> read_libraries(const ObjSource& source) {
  std::vector<Library> libraries;
  for (const fs::path& path : library_paths(source)) {
    auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    libraries.push_back({path, *std::move(bytes)});
  }
  return libraries;
}

/// A map of a material that faces may have: the same list whenever it is asked for.
struct Use {
  std::size_t library = 0, map = 0;
  std::uint32_t material = 0;
  MtlMap what;
};

std::vector<Use> uses_of(const std::vector<Library>& libraries,
                         const std::vector<std::string>& materials) {
  std::vector<Use> uses;
  for (std::size_t library = 0; library < libraries.size(); ++library) {
    const std::vector<MtlMap> maps = read_mtl_maps(libraries[library].bytes);
    for (std::size_t map = 0; map < maps.size(); ++map) {
      const auto found = std::find(materials.begin(), materials.end(), maps[map].material);
      if (found == materials.end() || !maps[map].follows_uvs) continue;
      const auto material = static_cast<std::uint32_t>(found - materials.begin());
      uses.push_back({library, map, material, maps[map]});
    }
  }
  return uses;
}

/// What its pictures are called as seen from another folder, where that is something else.
std::map<std::size_t, std::string> names_from(const fs::path& folder, const Library& library) {
  std::map<std::size_t, std::string> names;
  std::error_code code;
  const auto absolute = [&](const fs::path& path) {
    return fs::weakly_canonical(path.empty() ? "." : path, code);
  };
  const fs::path there = absolute(folder);
  if (there == absolute(library.path.parent_path())) return names;
  const std::vector<MtlMap> maps = read_mtl_maps(library.bytes);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const fs::path picture = picture_path(library.path, maps[i]);
    if (is_file(picture)) names[i] = absolute(picture).lexically_proximate(there).generic_string();
  }
  return names;
}

/// Are most texels unit vectors that point up? What is called a bump map often is a normal map.
bool holds_normals(const Texture& texture) {
  if (texture.channels < 3) return false;
  std::size_t unit = 0;
  for (std::size_t i = 0; i < texture.texel_count(); ++i) {
    const float* value = texture.values.data() + i * static_cast<std::size_t>(texture.channels);
    const float x = 2 * value[0] - 1, y = 2 * value[1] - 1, z = 2 * value[2] - 1;
    if (z > 0 && std::abs(std::sqrt(x * x + y * y + z * z) - 1) < 0.1F) ++unit;
  }
  return 10 * unit >= 9 * texture.texel_count();
}

TextureRole role_of(std::string_view keyword, const Texture& texture) {
  const std::string key = lower(keyword);
  if (key == "norm" || key == "map_kn") return TextureRole::normals;
  for (const char* color : {"map_kd", "map_ka", "map_ks", "map_ke"}) {
    if (key == color) return TextureRole::color;
  }
  const bool bump = key == "bump" || key == "map_bump";
  return bump && holds_normals(texture) ? TextureRole::normals : TextureRole::data;
}

}  // namespace

Status ObjSource::save(const fs::path& path, const Mesh& mesh, const AtlasMesh& atlas) const {
  return write_file(path,
                    [&](const PutBytes& put) { return rewrite_obj(bytes, mesh, atlas, {}, put); });
}

std::vector<fs::path> ObjSource::side_files() const {
  std::vector<fs::path> files;
  for (const fs::path& path : library_paths(*this)) {
    files.push_back(path);
    const auto library = read_file(path);
    if (!library) continue;
    for (const MtlMap& map : read_mtl_maps(*library)) files.push_back(picture_path(path, map));
  }
  return files;
}

Result<ModelTextures> ObjSource::textures(bool base_colors_alone) const {
  const auto libraries = read_libraries(*this);
  if (!libraries) return libraries.error();
  ModelTextures result;
  std::map<fs::path, std::size_t> known;
  for (const Use& use : uses_of(*libraries, materials)) {
    if (base_colors_alone && !is_base_color(use.what.keyword)) continue;
    const fs::path path = picture_path((*libraries)[use.library].path, use.what);
    const auto [found, is_new] = known.try_emplace(path, result.images.size());
    if (is_new) {
      auto texture = load_texture(path);
      if (!texture) {
        Error error = texture.error();
        error.where =
            fmt::format("{}: {} of material {}: {}", (*libraries)[use.library].path.string(),
                        use.what.keyword, use.what.material, error.where);
        return error;
      }
      result.images.push_back(*std::move(texture));
    }
    result.uses.push_back({use.material, std::string(use.what.keyword),
                           role_of(use.what.keyword, result.images[found->second]), found->second,
                           use.what.source});
  }
  return result;
}

std::vector<std::array<float, 3>> ObjSource::base_factors() const {
  std::vector<std::array<float, 3>> factors(materials.size(), kNoFactor);
  for (const fs::path& path : library_paths(*this)) {
    const auto library = read_file(path);
    if (!library) continue;
    for (const auto& [material, color] : read_mtl_colors(*library)) {
      const auto found = std::find(materials.begin(), materials.end(), material);
      if (found != materials.end()) {
        factors[static_cast<std::size_t>(found - materials.begin())] = color;
      }
    }
  }
  return factors;
}

Status ObjSource::save(const fs::path& path, const Mesh& mesh, const AtlasMesh& atlas,
                       std::span<const NewTexture> textures) const {
  const auto libraries = read_libraries(*this);
  if (!libraries) return libraries.error();
  const std::vector<Use> uses = uses_of(*libraries, materials);
  const auto beside = [&](const std::string& ending) {
    return fs::path(path).replace_filename(path.stem().string() + ending);
  };
  std::vector<std::map<std::size_t, std::string>> pictures;
  for (const Library& one : *libraries) pictures.push_back(names_from(path.parent_path(), one));
  std::vector<std::set<std::size_t>> whole(libraries->size());
  const std::vector<fs::path> inputs = side_files();
  const auto refuse_input = [&](const fs::path& output) -> Status {
    const bool is_input = std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
      return same_file(input, output);
    });
    if (!is_input) return Done{};
    return Error{ErrorKind::usage, output.string(),
                 "it would be written over, and is a file of "
                 "the input",
                 "give the output another name"};
  };
  for (const NewTexture& texture : textures) {
    const fs::path picture = beside(fmt::format("-{}.png", texture.name));
    if (Status ok = refuse_input(picture); !ok) return ok;
    if (Status ok = write_file(picture, texture.png); !ok) return ok;
    for (const std::size_t use : texture.uses) {
      pictures[uses[use].library][uses[use].map] = picture.filename().string();
      whole[uses[use].library].insert(uses[use].map);
    }
  }
  const fs::path library = beside(".mtl");
  if (Status ok = refuse_input(library); !ok) return ok;
  std::string all;
  for (std::size_t i = 0; i < libraries->size(); ++i) {
    all += replace_mtl_pictures((*libraries)[i].bytes, pictures[i], whole[i]);
    if (!all.empty() && all.back() != '\n') all += '\n';
  }
  if (Status ok = write_file(library, all); !ok) return ok;
  return write_file(path, [&](const PutBytes& put) {
    return rewrite_obj(bytes, mesh, atlas, library.filename().string(), put);
  });
}

}  // namespace wrapatlas
