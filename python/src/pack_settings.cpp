#include "pack_settings.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <numbers>

#include "bind.h"
#include "pack/request.h"
#include "settings.h"

namespace wrapatlas::python {
namespace {

void bind_pack_settings(nb::module_& module) {
  nb::class_<PackSettings> settings(module, "PackSettings");
  settings.def(nb::init<>());
  add_choice(
      settings, "method", kMethods, [](PackSettings & s) -> auto& { return s.options.method; });
  add_choice(
      settings, "wrap", kWraps, [](PackSettings & s) -> auto& { return s.options.wrap; });
  add_choice(
      settings, "coverage", kCoverages,
      [](PackSettings & s) -> auto& { return s.options.coverage; });
  add_choice(
      settings, "rotation_base", kRotationBases,
      [](PackSettings & s) -> auto& { return s.options.rotation_base; });
  add_choice(
      settings, "stacked", kStacked, [](PackSettings & s) -> auto& { return s.stacked; });
  const auto number = [&](const char* name, auto member, Range range) {
    add_number(settings, name, member, range);
  };
  number("width", [](PackSettings & s) -> auto& { return s.options.width; },
         {1, double{kMostTexels}, "texels"});
  number("height", [](PackSettings & s) -> auto& { return s.options.height; },
         {1, double{kMostTexels}, "texels"});
  number("padding", [](PackSettings & s) -> auto& { return s.options.padding; },
         {0, 4096, "texels"});
  number("margin", [](PackSettings & s) -> auto& { return s.options.margin; },
         {0, double{kMostTexels}, "texels"});
  number("block", [](PackSettings & s) -> auto& { return s.options.block; }, {1, 64, "texels"});
  number("density", [](PackSettings & s) -> auto& { return s.density; }, {1e-9, 1e9, "texels"});
  number("pages", [](PackSettings & s) -> auto& { return s.options.pages; },
         {1, double{kMostPages}, "pages"});
  number("time", [](PackSettings & s) -> auto& { return s.options.time; }, {0, 1e6, "seconds"});
  number("moves", [](PackSettings & s) -> auto& { return s.options.moves; }, {0, 1e15, "moves"});
  number("rotations", [](PackSettings & s) -> auto& { return s.options.rotations; },
         {1, 3600, "angles"});
  number("grid", [](PackSettings & s) -> auto& { return s.options.grid; }, {0, 8192, "cells"});
  number("scale_start", [](PackSettings & s) -> auto& { return s.options.start_upper; }, {0.1, 1});
  number("lambda_", [](PackSettings & s) -> auto& { return s.options.lambda; }, {0, 1e6});
  number("seed", [](PackSettings & s) -> auto& { return s.options.seed; }, {0, 4294967295});
  number("threads", [](PackSettings & s) -> auto& { return s.options.threads; },
         {0, 1024, "threads"});
  settings
      .def_prop_rw(
          "no_inner", [](const PackSettings& s) { return !s.options.inner; },
          [](PackSettings& s, bool on) { s.options.inner = !on; })
      .def_prop_rw(
          "all_sides", [](const PackSettings& s) { return s.options.all_sides; },
          [](PackSettings& s, bool on) { s.options.all_sides = on; })
      .def_rw("cut", &PackSettings::cut)
      .def_rw("check", &PackSettings::check)
      .def_prop_ro("can_wrap", [](const PackSettings& s) { return can_wrap(s.options.method); })
      .def(
          "set_aspect",
          [](PackSettings& s, const std::string& text) {
            if (const Status ok = set_aspect(s.options, text, "aspect="); !ok) raise(ok.error());
          },
          nb::arg("aspect"))
      .def("set_default_padding",
           [](PackSettings& s) {
             s.options.padding = default_padding(s.options.width, s.options.height);
           })
      .def("use_pages_as_needed", [](PackSettings& s) { s.options.pages = 0; });
}

void bind_unwrap_settings(nb::module_& module) {
  nb::class_<UnwrapSettings> settings(module, "UnwrapSettings");
  settings.def(nb::init<>());
  add_number(settings, "max_stretch",
             [](UnwrapSettings & s) -> auto& { return s.options.max_stretch; }, {1, 1000});
  add_number(settings, "max_charts",
             [](UnwrapSettings & s) -> auto& { return s.options.max_charts; }, {0, 1e9, "charts"});
  add_number(settings, "max_extent",
             [](UnwrapSettings & s) -> auto& { return s.options.max_extent; }, {0, 1000});
  add_number(settings, "iterations",
             [](UnwrapSettings & s) -> auto& { return s.options.flatten.iterations; },
             {1, kMostIterations});
  add_choice(
      settings, "stretch", kStretches,
      [](UnwrapSettings & s) -> auto& { return s.options.stretch; });
  add_choice(
      settings, "flatten", kFlattenMethods,
      [](UnwrapSettings & s) -> auto& { return s.options.flatten.method; });
  settings
      .def("set_default_extent",
           [](UnwrapSettings& s, const PackSettings& pack) {
             s.options.max_extent = default_extent(pack.options.wrap);
           })
      .def_prop_rw(
          "hard_edges",
          [](const UnwrapSettings& s) {
            return s.options.surface.hard_angle * 180 / std::numbers::pi;
          },
          [](UnwrapSettings& s, nb::handle value) {
            s.options.surface.hard_angle =
                number_from("hard_edges", value, {0, 180, "degrees"}, false) * std::numbers::pi /
                180;
          })
      .def_prop_rw(
          "keep_seams", [](const UnwrapSettings& s) { return s.options.surface.uv_seams; },
          [](UnwrapSettings& s, bool on) { s.options.surface.uv_seams = on; })
      .def_rw("split_materials", &UnwrapSettings::split_materials);
}

/// Names of the methods that read an option; of all, if it is none of a single method's.
std::vector<std::string> readers_of(const std::string& option) {
  std::vector<std::string> names;
  for (const MethodOption& one : method_options()) {
    if (option != one.option) continue;
    for (const Method method : one.methods) names.emplace_back(name_of(kMethods, method));
    return names;
  }
  for (const Named<Method>& method : kMethods) names.emplace_back(method.name);
  return names;
}

}  // namespace

void bind_settings(nb::module_& module) {
  bind_pack_settings(module);
  bind_unwrap_settings(module);
  module.def("readers_of", &readers_of, nb::arg("option"));
}

}  // namespace wrapatlas::python
