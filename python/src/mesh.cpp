// Meshes: from arrays, from files, and back.
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <optional>

#include "arrays.h"
#include "bind.h"
#include "mesh/triangulate.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas::python {
namespace {

std::vector<std::uint32_t> read_faces(const AnyArray& array, const std::string& name,
                                      std::size_t count, const std::string& what) {
  if (array.ndim() != 2 || array.shape(1) < 3) {
    raise(usage(name, fmt::format("its shape is {}", shape_text(array)),
                "pass (F, 3): the corners of each triangle"));
  }
  if (array.shape(0) == 0) raise(bad_input(name, "there are no faces", "pass at least one"));
  return read_indices(array, name, count, what);
}

/// Names of our arrays, where the library speaks of files.
Error as_array(Error error) {
  if (error.what.rfind("a coordinate", 0) == 0) {
    error.what = "a coordinate is NaN, infinite or beyond 1e30";
    error.remedy = "pass finite numbers";
  }
  return error;
}

PyMesh from_arrays(const std::optional<AnyArray>& positions, const AnyArray& faces,
                   const std::optional<AnyArray>& uv, const std::optional<AnyArray>& uv_faces,
                   const std::optional<AnyArray>& objects) {
  auto model = std::make_shared<Model>();
  Mesh& mesh = model->mesh;
  if (uv) mesh.texcoords = read_vec2(*uv, "uv");
  if (positions) {
    mesh.positions = read_vec3(*positions, "positions");
    mesh.corner_position = read_faces(faces, "faces", mesh.positions.size(), "positions");
  } else {
    // Faces hang together by their indices: no two vertices are at one place.
    mesh.positions.reserve(mesh.texcoords.size());
    for (std::size_t i = 0; i < mesh.texcoords.size(); ++i) {
      mesh.positions.push_back({mesh.texcoords[i].x, mesh.texcoords[i].y, static_cast<double>(i)});
    }
    mesh.corner_position = read_faces(faces, "faces", mesh.texcoords.size(), "UVs");
  }
  const std::size_t size = faces.shape(1), count = faces.shape(0);
  mesh.face_begin.resize(count + 1);
  for (std::size_t f = 0; f <= count; ++f) {
    mesh.face_begin[f] = static_cast<std::uint32_t>(f * size);
  }
  if (!uv) {
    mesh.corner_texcoord.assign(mesh.corner_count(), kNone);
  } else if (uv_faces) {
    mesh.corner_texcoord = read_faces(*uv_faces, "uv_faces", mesh.texcoords.size(), "UVs");
    if (uv_faces->shape(0) != count || uv_faces->shape(1) != size) {
      raise(usage("uv_faces",
                  fmt::format("its shape is {}, that of faces {}", shape_text(*uv_faces),
                              shape_text(faces)),
                  "pass the corners of the same faces"));
    }
  } else {
    if (mesh.texcoords.size() != mesh.positions.size()) {
      raise(usage("uv",
                  fmt::format("there are {} for {} positions", mesh.texcoords.size(),
                              mesh.positions.size()),
                  "pass one for each, or uv_faces"));
    }
    mesh.corner_texcoord = mesh.corner_position;
  }
  if (objects) {
    mesh.face_object = read_indices(*objects, "objects", kNone, "objects");
    if (objects->ndim() != 1 || mesh.face_object.size() != count) {
      raise(usage("objects", fmt::format("its shape is {}", shape_text(*objects)),
                  fmt::format("pass ({},): one for each face", count)));
    }
  }
  if (const Status ok = validate_mesh(mesh); !ok) raise(as_array(ok.error()));
  return {model, positions.has_value()};
}

PyMesh load(const std::string& path, int texcoord, bool in_scene) {
  LoadOptions options;
  options.texcoord_set = texcoord;
  options.in_scene = in_scene;
  options.may_add_set = true;
  Result<Model> model = [&] {
    const nb::gil_scoped_release unlocked;
    return load_model(path, options);
  }();
  auto shared = std::make_shared<Model>(take(std::move(model)));
  const bool is_gltf = shared->format == FileFormat::gltf || shared->format == FileFormat::glb;
  if (texcoord > 0 && !is_gltf) {
    raise(usage(fmt::format("texcoord={}", texcoord), path + " can hold one UV set only",
                "leave it out: only glTF files have several sets"));
  }
  if (in_scene && is_gltf) shared->source.reset();  // saved, it is a new file
  return {shared};
}

/// Corners of faces, by face: if all have the same number of them.
std::size_t common_size(const Mesh& mesh) {
  const std::size_t size = mesh.face_size(0);
  for (std::size_t f = 1; f < mesh.face_count(); ++f) {
    if (mesh.face_size(f) != size) {
      raise(usage("mesh", "its faces have different numbers of corners",
                  "use triangulated(), or face_begin and corner_position"));
    }
  }
  return size;
}

PyMesh triangulate(const PyMesh& mesh) {
  auto model = std::make_shared<Model>();
  Triangulated triangles = triangulated(mesh.mesh());
  model->mesh = std::move(triangles.mesh);
  model->v_points_down = mesh.model->v_points_down;
  return {model, mesh.has_space};
}

void save(const PyMesh& mesh, const std::string& path) {
  if (!mesh.has_space) raise(usage(path, "there are no positions to write", "pass positions="));
  const Status ok = [&] {
    const nb::gil_scoped_release unlocked;
    AtlasMesh atlas = keep_texcoords(mesh.mesh());
    round_texcoords_to_float(atlas);
    return save_model(*mesh.model, atlas, path);
  }();
  if (!ok) raise(ok.error());
}

constexpr auto kInside = nb::rv_policy::reference_internal;

}  // namespace

Mesh upside_down(Mesh mesh) {
  for (Vec2& uv : mesh.texcoords) uv.y = 1 - uv.y;
  return mesh;
}

void bind_mesh(nb::module_& module) {
  nb::class_<PyMesh>(
      module, "Mesh",
      "Polygons with a position and, maybe, a UV at each corner. Its arrays are views of its own "
      "memory, and cannot be written to.")
      .def(nb::init<const PyMesh&>(), nb::arg("other"))
      .def_prop_ro(
          "positions", [](const PyMesh& m) { return view_of(m.mesh().positions); }, kInside,
          "(P, 3) float64")
      .def_prop_ro(
          "uv", [](const PyMesh& m) { return view_of(m.mesh().texcoords); }, kInside,
          "(T, 2) float64; no rows if it has no UVs. v points up, but for meshes loaded from glTF: "
          "see v_points_down")
      .def_prop_ro(
          "faces",
          [](const PyMesh& m) { return rows_of(m.mesh().corner_position, common_size(m.mesh())); },
          kInside,
          "(F, k) uint32 into positions; k is 3 for triangles. UsageError if faces have different "
          "numbers of corners")
      .def_prop_ro(
          "uv_faces",
          [](const PyMesh& m) { return rows_of(m.mesh().corner_texcoord, common_size(m.mesh())); },
          kInside, "(F, k) uint32 into uv; 4294967295 at corners without a UV")
      .def_prop_ro(
          "face_begin", [](const PyMesh& m) { return view_of(m.mesh().face_begin); }, kInside,
          "(F + 1,) uint32: face f has the corners face_begin[f] to face_begin[f + 1] - 1")
      .def_prop_ro(
          "corner_position", [](const PyMesh& m) { return view_of(m.mesh().corner_position); },
          kInside, "(C,) uint32 into positions")
      .def_prop_ro(
          "corner_uv", [](const PyMesh& m) { return view_of(m.mesh().corner_texcoord); }, kInside,
          "(C,) uint32 into uv; 4294967295 at corners without a UV")
      .def_prop_ro(
          "face_material", [](const PyMesh& m) { return view_of(m.model->face_material); }, kInside,
          "(F,) uint32: the number of each face's material in the file; no entries if there is "
          "one alone")
      .def_prop_ro(
          "face_count", [](const PyMesh& m) { return m.mesh().face_count(); }, "Faces")
      .def_prop_ro(
          "v_points_down", [](const PyMesh& m) { return m.model->v_points_down; },
          "v = 0 is the top row of a texture: meshes loaded from glTF, and what is made of them")
      .def("_triangulated", &triangulate)
      .def("_save", &save, nb::arg("path"))
      .def_prop_ro("_has_space", [](const PyMesh& m) { return m.has_space; });
  module.def("mesh_from_arrays", &from_arrays, nb::arg("positions").none(), nb::arg("faces"),
             nb::arg("uv").none(), nb::arg("uv_faces").none(), nb::arg("objects").none());
  module.def("load", &load, nb::arg("path"), nb::arg("texcoord"), nb::arg("in_scene"));
}

}  // namespace wrapatlas::python
