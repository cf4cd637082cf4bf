// pack() and unwrap(), and what they return.
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include "arrays.h"
#include "long_work.h"
#include "names.h"
#include "packed.h"
#include "wrapatlas/picture.h"
#include "wrapatlas/unwrap.h"

namespace wrapatlas::python {
namespace {

PackedMesh pack_mesh(const PyMesh& mesh, const PackSettings& settings, nb::object progress,
                     bool keep_best) {
  LongWork work(std::move(progress), keep_best);
  return work.run<PackedMesh>([&]() -> Result<PackedMesh> {
    return make_packed(mesh, std::nullopt, settings, [&](auto stage, double share, double best) {
      return work.tell(stage, share, best);
    });
  });
}

/// Flat charts, not packed yet.
Result<Unwrapping> cut_and_flatten(const PyMesh& mesh, const UnwrapSettings& settings, int threads,
                                   LongWork& work) {
  UnwrapOptions options = settings.options;
  options.threads = threads;
  if (settings.split_materials) options.surface.face_labels = mesh.model->face_material;
  options.progress = [&work](const UnwrapProgress& progress) {
    return work.tell("unwrap", progress.fraction, static_cast<double>(progress.charts));
  };
  auto unwrapping = unwrap(mesh.mesh(), options);
  if (!unwrapping) return unwrapping;
  work.tell("unwrap", 1, static_cast<double>(unwrapping->charts.size()));
  if (mesh.model->v_points_down) {
    for (Vec2& uv : unwrapping->mesh.texcoords) uv.y = -uv.y;
  }
  return unwrapping;
}

PackedMesh unwrap_mesh(const PyMesh& mesh, const UnwrapSettings& settings,
                       const PackSettings& pack_settings, nb::object progress, bool keep_best) {
  LongWork work(std::move(progress), keep_best);
  return work.run<PackedMesh>([&]() -> Result<PackedMesh> {
    auto unwrapping = cut_and_flatten(mesh, settings, pack_settings.options.threads, work);
    if (!unwrapping) return unwrapping.error();
    return make_packed(
        mesh, std::move(*unwrapping), pack_settings,
        [&](auto stage, double share, double best) { return work.tell(stage, share, best); });
  });
}

PyMesh new_mesh(const PackedMesh& packed) {
  auto model = std::make_shared<Model>();
  model->mesh = apply_atlas(packed->mesh(), packed->atlas);
  model->v_points_down = packed->source.model->v_points_down;
  const auto& materials = packed->source.model->face_material;
  if (!materials.empty()) {
    for (const std::uint32_t face : packed->atlas.face_source) {
      model->face_material.push_back(materials[face]);
    }
  }
  return {model, packed->source.has_space};
}

void save(const PackedMesh& packed, const std::string& path) {
  if (!packed->source.has_space) {
    raise(usage(path, "there are no positions to write", "pass positions="));
  }
  const Status ok = [&] {
    const nb::gil_scoped_release unlocked;
    return save_model(*packed->source.model, packed->atlas, path);
  }();
  if (!ok) raise(ok.error());
}

PictureOptions picture_options(const PackedMesh& packed, int size, bool tiles) {
  PictureOptions options;
  options.size = size;
  options.tile2x2 = tiles;
  options.v_points_down = packed->source.model->v_points_down;
  return options;
}

nb::ndarray<nb::numpy, std::uint8_t> draw(const PackedMesh& packed, int size, bool tiles) {
  Image image = [&] {
    const nb::gil_scoped_release unlocked;
    return draw_atlas(packed->charts.charts, packed->packing, picture_options(packed, size, tiles));
  }();
  const std::vector<std::size_t> shape{static_cast<std::size_t>(image.height),
                                       static_cast<std::size_t>(image.width), 3};
  return own(std::move(image.rgb), shape);
}

void save_picture(const PackedMesh& packed, const std::string& path, int size, bool tiles) {
  const Status ok = [&] {
    const nb::gil_scoped_release unlocked;
    return save_atlas_picture(path, packed->charts.charts, packed->packing,
                              picture_options(packed, size, tiles));
  }();
  if (!ok) raise(ok.error());
}

/// Per chart two rows of three: texel = matrix * (u, v, 1).
nb::ndarray<nb::numpy, double> transforms(const PackedMesh& packed) {
  const std::size_t count = packed->packing.placements.size();
  std::vector<double> values;
  values.reserve(6 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Similarity t = packed->packing.transform(i);
    const double c = t.scale * t.cos_angle, s = t.scale * t.sin_angle;
    values.insert(values.end(), {c, -s, t.translation.x, s, c, t.translation.y});
  }
  return own(std::move(values), {count, 2, 3});
}

template <typename T, typename Value>
nb::ndarray<nb::numpy, T> per_chart(const PackedMesh& packed, const Value& value) {
  std::vector<T> values;
  for (std::size_t i = 0; i < packed->packing.placements.size(); ++i) values.push_back(value(i));
  const std::size_t count = values.size();
  return own(std::move(values), {count});
}

/// Do a chart's UVs reach over the end of its tile, along u and along v?
nb::ndarray<nb::numpy, std::uint8_t> wraps(const PackedMesh& packed) {
  std::vector<Box2> boxes(packed->charts.charts.size());
  const AtlasMesh& atlas = packed->atlas;
  for (std::size_t f = 0; f < atlas.face_count(); ++f) {
    const std::uint32_t chart = packed->charts.face_chart[atlas.face_source[f]];
    if (chart == kNone) continue;
    for (std::uint32_t c = atlas.face_begin[f]; c < atlas.face_begin[f + 1]; ++c) {
      boxes[chart].add(atlas.texcoords[atlas.corner_texcoord[c]]);
    }
  }
  std::vector<std::uint8_t> result;
  for (const Box2& box : boxes) {
    const bool any = !box.empty() && packed->packing.pages == 1;
    result.push_back(any && wraps_u(atlas.wrap) && box.max.x > 1 ? 1 : 0);
    result.push_back(any && wraps_v(atlas.wrap) && (box.max.y > 1 || box.min.y < 0) ? 1 : 0);
  }
  return own(std::move(result), {boxes.size(), 2});
}

View<std::uint32_t, 2> faces(const PackedMesh& packed) {
  const std::size_t faces = packed->atlas.face_count(), corners = packed->vertices.of_corner.size();
  bool triangles = corners == 3 * faces;
  for (std::size_t f = 0; triangles && f < faces; ++f) {
    triangles = packed->atlas.face_begin[f + 1] - packed->atlas.face_begin[f] == 3;
  }
  if (!triangles) {
    raise(usage("faces", "not all are triangles", "use face_begin and corner_vertex"));
  }
  return rows_of(packed->vertices.of_corner, 3);
}

constexpr auto kInside = nb::rv_policy::reference_internal;
constexpr auto kOwn = nb::rv_policy::automatic;  // arrays that own their memory

void bind_arrays(nb::class_<PackedMesh>& packing) {
  packing
      .def_prop_ro(
          "vmapping", [](const PackedMesh& p) { return view_of(p->vertices.mapping); }, kInside,
          "(N,) uint32: which vertex of the source each new vertex is. With export=\"cut\" some "
          "lie "
          "between vertices: the nearest of them; see sources")
      .def_prop_ro(
          "uv", [](const PackedMesh& p) { return rows_of(p->vertices.uv, 2); }, kInside,
          "(N, 2) float32: of each new vertex, in parts of the atlas' width and height. v points "
          "up "
          "(down, if the mesh is from glTF). May exceed 1 on axes that wrap; several pages are "
          "UDIM "
          "tiles")
      .def_prop_ro("faces", &faces, kInside, "(F, 3) uint32 into the new vertices")
      .def_prop_ro(
          "face_begin", [](const PackedMesh& p) { return view_of(p->atlas.face_begin); }, kInside,
          "(F + 1,) uint32: of polygons, as in Mesh")
      .def_prop_ro(
          "corner_vertex", [](const PackedMesh& p) { return view_of(p->vertices.of_corner); },
          kInside, "(C,) uint32 into the new vertices")
      .def_prop_ro(
          "face_source", [](const PackedMesh& p) { return view_of(p->atlas.face_source); }, kInside,
          "(F,) uint32: the source's face that each is, or is a part of")
      .def_prop_ro(
          "sources",
          [](const PackedMesh& p) {
            return View<std::uint32_t, 2>(
                reinterpret_cast<const std::uint32_t*>(p->vertices.sources.data()),
                {p->vertices.sources.size(), 3});
          },
          kInside, "(N, 3) uint32: vertices of the source that each new vertex is a mean of")
      .def_prop_ro(
          "weights",
          [](const PackedMesh& p) {
            return View<double, 2>(reinterpret_cast<const double*>(p->vertices.weights.data()),
                                   {p->vertices.weights.size(), 3});
          },
          kInside, "(N, 3) float64: with which weights")
      .def_prop_ro(
          "face_chart", [](const PackedMesh& p) { return view_of(p->charts.face_chart); }, kInside,
          "Per face of the source (uint32) its chart; 4294967295 without UVs")
      .def_prop_ro(
          "placements", &transforms, kOwn,
          "(charts, 2, 3) float64: texel = placement @ (u, v, 1), with u, v those that were "
          "packed")
      .def_prop_ro(
          "angles",
          [](const PackedMesh& p) {
            return per_chart<double>(p, [&](auto i) { return p->packing.placements[i].angle; });
          },
          kOwn, "(charts,) float64: radians, counter-clockwise")
      .def_prop_ro(
          "chart_pages",
          [](const PackedMesh& p) {
            return per_chart<std::int32_t>(p,
                                           [&](auto i) { return p->packing.placements[i].page; });
          },
          kOwn, "(charts,) int32, from 0 on")
      .def_prop_ro("_wraps", &wraps, kOwn)
      .def_prop_ro(
          "face_stretch",
          [](const PackedMesh& p) {
            static const std::vector<double> none;
            return view_of(p->unwrapping ? p->unwrapping->face_stretch : none);
          },
          kInside,
          "Of unwrap: per face of the source (float64) how far it is stretched, 1 being not "
          "at all; 0: folded. Else no entries");
}

void bind_numbers(nb::class_<PackedMesh>& packing) {
  const auto number = [&](const char* name, auto value, const char* help) {
    packing.def_prop_ro(name, value, help);
  };
  number(
      "chart_count", [](const PackedMesh& p) { return p->charts.charts.size(); }, "Charts");
  number(
      "width", [](const PackedMesh& p) { return p->packing.width; }, "Texels, of each page");
  number(
      "height", [](const PackedMesh& p) { return p->packing.height; }, "Texels, of each page");
  number(
      "pages", [](const PackedMesh& p) { return p->packing.pages; }, "In use");
  number(
      "efficiency", [](const PackedMesh& p) { return p->packing.efficiency; },
      "Share of the atlas that charts cover, 0 to 1");
  number(
      "scale", [](const PackedMesh& p) { return p->packing.scale; }, "Texels per UV unit packed");
  number(
      "density", [](const PackedMesh& p) { return p->packing.scale * p->uv_density; },
      "Texels per unit of surface, a mean; 0 if no positions were given");
  number(
      "padding", [](const PackedMesh& p) { return p->settings.options.padding; },
      "Texels between charts, at least");
  number(
      "interrupted", [](const PackedMesh& p) { return p->packing.interrupted; },
      "The search was stopped early: this is the best it had");
  number(
      "wrap", [](const PackedMesh& p) { return std::string(name_of(kWraps, p->packing.wrap)); },
      "Axes that wrap: uv, u, v or none");
  number(
      "method",
      [](const PackedMesh& p) {
        return std::string(name_of(kMethods, p->settings.options.method));
      },
      "The packer");
  number(
      "is_cut", [](const PackedMesh& p) { return p->settings.cut; },
      "Faces were cut at the border, so that all UVs lie in [0, 1]");
  number(
      "charts_beyond_limits",
      [](const PackedMesh& p) {
        std::size_t count = 0;
        if (!p->unwrapping) return count;
        for (const UnwrappedChart& chart : p->unwrapping->charts) count += chart.is_good ? 0 : 1;
        return count;
      },
      "Of unwrap: single faces that cannot be flattened within the limits");
  number(
      "stretch_l2",
      [](const PackedMesh& p) {
        double worst = 0;
        if (!p->unwrapping) return worst;
        for (const UnwrappedChart& chart : p->unwrapping->charts) {
          worst = std::max(worst, chart.distortion.l2);
        }
        return worst;
      },
      "Of unwrap: the largest L2 stretch of a chart, 1 being none");
}

}  // namespace

void bind_packing(nb::module_& module) {
  nb::class_<PackedMesh> packing(
      module, "PackedMesh",
      "What pack and unwrap return. Its arrays are views of its own memory, and cannot be written "
      "to.");
  bind_arrays(packing);
  bind_numbers(packing);
  packing.def(nb::init<const PackedMesh&>(), nb::arg("other"))
      .def_prop_ro("_mesh", &new_mesh, "The mesh with its new UVs; a new one each time")
      .def_prop_ro(
          "_source", [](const PackedMesh& p) { return p->source; }, "The mesh that was given")
      .def("_save", &save, nb::arg("path"))
      .def("_draw", &draw, nb::arg("size"), nb::arg("tiles"))
      .def("_save_picture", &save_picture, nb::arg("path"), nb::arg("size"), nb::arg("tiles"))
      .def_prop_ro("_report", [](const PackedMesh& p) { return p->report; });
  module.def("pack", &pack_mesh, nb::arg("mesh"), nb::arg("settings"), nb::arg("progress").none(),
             nb::arg("keep_best"));
  module.def("unwrap", &unwrap_mesh, nb::arg("mesh"), nb::arg("settings"), nb::arg("pack_settings"),
             nb::arg("progress").none(), nb::arg("keep_best"));
}

}  // namespace wrapatlas::python
