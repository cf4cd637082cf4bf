// The exact check of a finished atlas.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bind.h"
#include "settings.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::python {
namespace {

CheckReport check(const PyMesh& atlas, const std::optional<PyMesh>& reference,
                  const CheckOptions& options) {
  for (const auto& [name, texels] :
       {std::pair{"padding", options.padding}, std::pair{"margin", options.margin}}) {
    if (texels < std::min(options.width, options.height)) continue;
    raise(usage(fmt::format("{}={}", name, texels),
                fmt::format("no less than a side of {} x {} texels", options.width, options.height),
                "give less, or the resolution of the atlas"));
  }
  auto report = [&]() -> Result<CheckReport> {
    const nb::gil_scoped_release unlocked;
    CheckOptions here = options;
    here.v_points_down = atlas.model->v_points_down;
    if (!reference) return check_atlas(atlas.mesh(), nullptr, here);
    if (reference->model->v_points_down == atlas.model->v_points_down) {
      return check_atlas(atlas.mesh(), &reference->mesh(), here);
    }
    const Mesh turned = upside_down(reference->mesh());
    return check_atlas(atlas.mesh(), &turned, here);
  }();
  CheckReport found = take(std::move(report));
  if (found.charts == 0) {
    raise(bad_input("atlas", "no face has UVs, so there is no atlas",
                    "check a mesh that was packed"));
  }
  return found;
}

void bind_options(nb::module_& module) {
  nb::class_<CheckOptions> options(module, "CheckSettings");
  options.def(nb::init<>());
  const auto number = [&](const char* name, auto member, Range range) {
    add_number(options, name, member, range);
  };
  number("width", [](CheckOptions & o) -> auto& { return o.width; },
         {1, double{kMostTexels}, "texels"});
  number("height", [](CheckOptions & o) -> auto& { return o.height; },
         {1, double{kMostTexels}, "texels"});
  number("padding", [](CheckOptions & o) -> auto& { return o.padding; },
         {0, double{kMostTexels}, "texels"});
  number("margin", [](CheckOptions & o) -> auto& { return o.margin; },
         {0, double{kMostTexels}, "texels"});
  number("tolerance", [](CheckOptions & o) -> auto& { return o.tolerance; },
         {0, double{kMostTexels}, "texels"});
  number("pages", [](CheckOptions & o) -> auto& { return o.pages; },
         {1, double{kMostPages}, "pages"});
  number("findings", [](CheckOptions & o) -> auto& { return o.max_findings; }, {0, 1e9});
  number("threads", [](CheckOptions & o) -> auto& { return o.threads; }, {0, 1024, "threads"});
  add_choice(
      options, "wrap", kWraps, [](CheckOptions & o) -> auto& { return o.wrap; });
  add_choice(
      options, "cut", kWraps, [](CheckOptions & o) -> auto& { return o.cut; });
  options.def_rw("stacked_ok", &CheckOptions::stacked_ok);
}

}  // namespace

void bind_check(nb::module_& module) {
  bind_options(module);
  nb::class_<Finding>(module, "Finding", "A promise that an atlas breaks.")
      .def_prop_ro(
          "kind", [](const Finding& f) { return name_of(kViolations, f.kind); },
          "overlap, gap, self_overlap, bounds, margin, missing_face, not_similar, mirrored or "
          "scale")
      .def_ro("text", &Finding::text, "One line in words")
      .def_ro("amount", &Finding::amount,
              "Texels: the depth of an overlap, or a distance; or the ratio of two scales")
      .def("__repr__", [](const Finding& f) { return "<Finding: " + f.text + ">"; });
  nb::class_<CheckReport>(module, "CheckReport", "What check found. True if all holds.")
      .def_prop_ro(
          "ok", [](const CheckReport& r) { return r.ok(); }, "No promise is broken")
      .def("__bool__", [](const CheckReport& r) { return r.ok(); })
      .def_ro("violations", &CheckReport::violations, "How many there are, described or not")
      .def_ro("findings", &CheckReport::findings, "Descriptions of the first of them")
      .def_ro("remarks", &CheckReport::remarks,
              "Defects of the input that are not the packing's fault, in words")
      .def_ro("charts", &CheckReport::charts)
      .def_ro("faces", &CheckReport::faces)
      .def_ro("faces_without_uv", &CheckReport::faces_without_uv)
      .def_ro("pages", &CheckReport::pages, "In use")
      .def_ro("smallest_gap", &CheckReport::smallest_gap,
              "Texels between charts; gap_reach, if there is none below it")
      .def_ro("gap_reach", &CheckReport::gap_reach, "Texels: from here on gaps are not looked for")
      .def_ro("efficiency", &CheckReport::efficiency, "Share of the atlas covered, 0 to 1")
      .def_ro("scale", &CheckReport::scale, "Texels per UV unit of the reference; 0 without one")
      .def("__repr__", [](const CheckReport& r) {
        return r.ok() ? fmt::format("<CheckReport: ok, {} charts>", r.charts)
                      : fmt::format("<CheckReport: {} violations>", r.violations);
      });
  module.def("check", &check, nb::arg("atlas"), nb::arg("reference").none(), nb::arg("settings"));
}

}  // namespace wrapatlas::python
