// wrapatlas._core: the library as Python calls it. What users see is in the .py files beside it.
#include "bind.h"

NB_MODULE(_core, module) {
  namespace python = wrapatlas::python;
  module.doc() = "The library behind the package. Not a public interface: it may change.";
  module.attr("VERSION") = WRAPATLAS_VERSION;
  python::bind_mesh(module);
  python::bind_settings(module);
  python::bind_packing(module);
  python::bind_check(module);
  python::bind_textures(module);
  python::bind_render(module);
  python::bind_simplify(module);
}
