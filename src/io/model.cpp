#include "wrapatlas/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <new>
#include <utility>

#include "io/atlas_fit.h"
#include "io/file.h"
#include "io/formats.h"

namespace wrapatlas {
namespace {

struct Ending {
  std::string_view text;
  FileFormat format;
};
constexpr std::array<Ending, 6> kEndings{{{".obj", FileFormat::obj},
                                          {".off", FileFormat::off},
                                          {".ply", FileFormat::ply},
                                          {".stl", FileFormat::stl},
                                          {".gltf", FileFormat::gltf},
                                          {".glb", FileFormat::glb}}};

bool counts_v_downward(FileFormat format) {
  return format == FileFormat::gltf || format == FileFormat::glb;
}

Result<Model> read(std::string bytes, FileFormat format, std::string_view name,
                   const std::filesystem::path& base, const LoadOptions& options) {
  switch (format) {
    case FileFormat::obj:
      return read_obj(std::move(bytes), name, base, options.shading);
    case FileFormat::off:
      return read_off(bytes, name);
    case FileFormat::ply:
      return read_ply(std::move(bytes), name, options.shading);
    case FileFormat::stl:
      return read_stl(std::move(bytes), name);
    case FileFormat::gltf:
    case FileFormat::glb:
      break;
  }
  return read_gltf(std::move(bytes), format == FileFormat::glb, name, base, options);
}

Status write_new(FileFormat format, const std::filesystem::path& path, const Mesh& mesh,
                 const AtlasMesh& atlas) {
  switch (format) {
    case FileFormat::obj:
      return write_new_obj(path, mesh, atlas);
    case FileFormat::ply:
      return write_new_ply(path, mesh, atlas);
    case FileFormat::gltf:
    case FileFormat::glb:
      return write_new_gltf(path, mesh, atlas, format == FileFormat::glb);
    case FileFormat::off:
    case FileFormat::stl:
      break;
  }
  return Error{ErrorKind::usage, path.string(),
               fmt::format("{} files cannot hold UVs", format == FileFormat::off ? "OFF" : "STL"),
               "write .obj, .ply, .gltf or .glb"};
}

/// The model in `format`, as save_model promises.
Status write_model(const Model& model, const AtlasMesh& atlas, const std::filesystem::path& path,
                   FileFormat format) {
  if (Status fits = check_fit(model.mesh, atlas); !fits) return fits;
  if (model.source && keeps_all(format, model.format))
    return model.source->save(path, model.mesh, atlas);
  if (counts_v_downward(format) != model.v_points_down) {
    return write_new(format, path, model.mesh, turn_upside_down(atlas));
  }
  return write_new(format, path, model.mesh, atlas);
}

Error no_textures() {
  return {ErrorKind::usage, "", "this format has no textures", "export it as .glb"};
}

}  // namespace

bool keeps_all(FileFormat output, FileFormat input) {
  const auto is_gltf = [](FileFormat f) { return f == FileFormat::gltf || f == FileFormat::glb; };
  return output == input || (is_gltf(output) && is_gltf(input));
}

Result<FileFormat> format_from_path(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Ending& known : kEndings) {
    if (ending == known.text) return known.format;
  }
  return Error{ErrorKind::usage, path.string(),
               ending.empty() ? "the name has no ending that says its format"
                              : fmt::format("the ending '{}' is not known", ending),
               "use .obj, .off, .ply, .stl, .gltf or .glb"};
}

Result<Model> load_model(const std::filesystem::path& path, const LoadOptions& options) {
  const Result<FileFormat> format = format_from_path(path);
  if (!format) return format.error();
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return load_model_bytes(*std::move(bytes), *format, path.string(), path.parent_path(), options);
}

Result<Model> load_model_bytes(std::string bytes, FileFormat format, std::string_view name,
                               const std::filesystem::path& base, const LoadOptions& options) {
  Result<Model> model = read(std::move(bytes), format, name, base, options);
  if (!model) return model.error();
  if (Status valid = validate_mesh(model->mesh); !valid) {
    Error error = valid.error();
    error.where = fmt::format("{}: {}", name, error.where);
    return error;
  }
  if (model->mesh.face_count() == 0) {
    return Error{ErrorKind::input, std::string(name), "the file holds no faces",
                 "export the mesh again with its faces"};
  }
  return model;
}

Result<ModelTextures> Model::Source::textures(bool) const {
  return Error{ErrorKind::usage, "", "textures are read from glTF and OBJ alone",
               "export it as .glb"};
}

Status Model::Source::save(const std::filesystem::path& path, const Mesh&, const AtlasMesh&,
                           std::span<const NewTexture>) const {
  return Error{ErrorKind::usage, path.string(), "textures are written to glTF and OBJ alone",
               "export the model as .glb"};
}

Result<ModelTextures> load_textures(const Model& model, bool base_colors_alone) {
  if (model.source) return model.source->textures(base_colors_alone);
  return no_textures();
}

Status takes_textures(const Model& model, const std::filesystem::path& path) {
  const Result<FileFormat> format = format_from_path(path);
  if (!format) return format.error();
  const bool has_textures =
      model.source && (model.format == FileFormat::obj || model.format == FileFormat::gltf ||
                       model.format == FileFormat::glb);
  if (!has_textures) return no_textures();
  if (keeps_all(*format, model.format)) return Done{};
  return Error{ErrorKind::usage, path.string(), "another format than the model's",
               "keep its ending: its materials would be lost"};
}

Status save_model(const Model& model, const AtlasMesh& atlas, const std::filesystem::path& path,
                  std::span<const NewTexture> textures) {
  if (Status ok = takes_textures(model, path); !ok) return ok;
  if (Status fits = check_fit(model.mesh, atlas); !fits) return fits;
  OutputTransaction files;
  if (Status ok = model.source->save(path, model.mesh, atlas, textures); !ok) return ok;
  return files.commit();
}

Status save_model(const Model& model, const AtlasMesh& atlas, const std::filesystem::path& path) {
  const Result<FileFormat> format = format_from_path(path);
  if (!format) return format.error();
  OutputTransaction files;  // a .gltf and its .bin
  if (Status written = write_model(model, atlas, path, *format); !written) return written;
  return files.commit();
}

}  // namespace wrapatlas
