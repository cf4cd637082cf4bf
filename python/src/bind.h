// What the module is put together from. Each part is a file.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "wrapatlas/model.h"

namespace wrapatlas::python {

namespace nb = nanobind;

void bind_mesh(nb::module_& module);
void bind_settings(nb::module_& module);
void bind_packing(nb::module_& module);
void bind_check(nb::module_& module);
void bind_textures(nb::module_& module);
void bind_render(nb::module_& module);
void bind_simplify(nb::module_& module);

/// A mesh as Python holds it. No one changes it once it is made.
struct PyMesh {
  std::shared_ptr<const Model> model;
  /// false: positions were made up, as only UVs were given.
  bool has_space = true;

  [[nodiscard]] const Mesh& mesh() const { return model->mesh; }
};

/// v the other way: glTF counts it from the top, the other formats from the bottom.
Mesh upside_down(Mesh mesh);

}  // namespace wrapatlas::python
