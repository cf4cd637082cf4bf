// Fewer triangles.
#include "wrapatlas/simplify.h"

#include "bind.h"
#include "long_work.h"

namespace wrapatlas::python {
namespace {

PyMesh simplify_mesh(const PyMesh& mesh, std::uint32_t faces, bool keep_seams,
                     nb::object progress) {
  if (!mesh.has_space) raise(usage("simplify", "the mesh has no positions", "pass them"));
  LongWork work(std::move(progress), false);
  Simplification result = work.run<Simplification>([&] {
    SimplifyOptions options;
    options.target_faces = faces;
    options.keep_uv_seams = keep_seams;
    options.progress = [&work](const SimplifyProgress& progress_now) {
      return work.tell("simplify", progress_now.fraction, static_cast<double>(progress_now.faces));
    };
    auto simplified = simplify(mesh.mesh(), options);
    if (simplified) work.tell("simplify", 1, static_cast<double>(simplified->mesh.face_count()));
    return simplified;
  });
  auto model = std::make_shared<Model>();
  model->mesh = std::move(result.mesh);
  model->v_points_down = mesh.model->v_points_down;
  return {model, true};
}

}  // namespace

void bind_simplify(nb::module_& module) {
  module.def("simplify", &simplify_mesh, nb::arg("mesh"), nb::arg("faces"), nb::arg("keep_seams"),
             nb::arg("progress").none());
}

}  // namespace wrapatlas::python
