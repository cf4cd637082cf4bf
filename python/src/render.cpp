// Pictures of models.
#include "wrapatlas/render.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <numbers>

#include "arrays.h"
#include "bind.h"
#include "settings.h"

namespace wrapatlas::python {
namespace {

enum class Light { smooth, flat, none };
constexpr Named<Light> kLights[] = {
    {"smooth", Light::smooth}, {"flat", Light::flat}, {"none", Light::none}};
enum class Space { tangent, object };
constexpr Named<Space> kSpaces[] = {{"tangent", Space::tangent}, {"object", Space::object}};
enum class Filter { trilinear, bilinear };
constexpr Named<Filter> kFilters[] = {{"trilinear", Filter::trilinear},
                                      {"bilinear", Filter::bilinear}};

constexpr double kDegree = std::numbers::pi / 180;

struct RenderSettings {
  RenderOptions options;
  Light shade = Light::smooth;
  Space space = Space::tangent;
  Filter filter = Filter::trilinear;
};

ViewDirection& direction(RenderSettings& s) {
  if (!s.options.from) s.options.from = ViewDirection{};
  s.options.views = 1;
  return *s.options.from;
}

MipMaps mip_maps(const AnyArray& pixels, const char* name, bool directions) {
  Texture texture = read_texture(pixels, name);
  if (directions && texture.channels < 3) {
    raise(bad_input(name, "a grey picture is no normal map", "give one in colour"));
  }
  const nb::gil_scoped_release unlocked;
  if (!directions) srgb_to_linear(texture);
  return make_mip_maps(std::move(texture), directions ? MipFilter::normals : MipFilter::mean);
}

nb::ndarray<nb::numpy, std::uint8_t> render_mesh(const PyMesh& mesh, RenderSettings settings,
                                                 const std::optional<AnyArray>& texture,
                                                 const std::optional<AnyArray>& normal_map,
                                                 const std::optional<PyMesh>& framed_as) {
  RenderOptions& options = settings.options;
  if (!mesh.has_space) raise(usage("render", "the mesh has no positions", "pass them"));
  if ((texture || normal_map) && mesh.mesh().texcoords.empty()) {
    raise(bad_input("render", "the mesh has no UVs for a texture", "unwrap it first"));
  }
  constexpr int kMostPixels = 65536;
  if (options.size * options.views > kMostPixels) {
    raise(usage(fmt::format("views={} size={}", options.views, options.size),
                "a picture has at most 65536 pixels a side", "give less of one of them"));
  }
  MipMaps color, normals;
  if (texture) color = mip_maps(*texture, "texture", false);
  if (normal_map) normals = mip_maps(*normal_map, "normal_map", true);
  if (texture) options.color = &color;
  if (normal_map) options.normals = &normals;
  options.shading = settings.shade == Light::none   ? Shading::none
                    : settings.shade == Light::flat ? Shading::flat
                                                    : Shading::smooth;
  if (normal_map) {
    options.shading =
        settings.space == Space::object ? Shading::object_normals : Shading::tangent_normals;
  }
  options.trilinear = settings.filter == Filter::trilinear;
  options.v_points_down = mesh.model->v_points_down;
  if (framed_as) options.framed = &framed_as->mesh();
  Rendering rendering = [&] {
    const nb::gil_scoped_release unlocked;
    return render(mesh.mesh(), options);
  }();
  std::vector<std::uint8_t> pixels;
  pixels.reserve(rendering.image.values.size());
  for (const float value : rendering.image.values) {
    const double cut = std::min(1.0, std::max(0.0, double(value)));
    pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * cut)));
  }
  const std::vector<std::size_t> shape{static_cast<std::size_t>(rendering.image.height),
                                       static_cast<std::size_t>(rendering.image.width), 3};
  return own(std::move(pixels), shape);
}

}  // namespace

void bind_render(nb::module_& module) {
  nb::class_<RenderSettings> settings(module, "RenderSettings");
  settings.def(nb::init<>());
  add_number(settings, "size", [](RenderSettings & s) -> auto& { return s.options.size; },
             {16, 4096, "pixels"});
  add_number(settings, "views", [](RenderSettings & s) -> auto& { return s.options.views; },
             {1, 64, "views"});
  add_number(settings, "level", [](RenderSettings & s) -> auto& { return s.options.level; },
             {0, 16});
  add_number(settings, "threads", [](RenderSettings & s) -> auto& { return s.options.threads; },
             {0, 1024, "threads"});
  add_choice(
      settings, "wrap", kWraps, [](RenderSettings & s) -> auto& { return s.options.wrap; });
  add_choice(
      settings, "shade", kLights, [](RenderSettings & s) -> auto& { return s.shade; });
  add_choice(
      settings, "space", kSpaces, [](RenderSettings & s) -> auto& { return s.space; });
  add_choice(
      settings, "filter", kFilters, [](RenderSettings & s) -> auto& { return s.filter; });
  settings
      .def(
          "set_azimuth",
          [](RenderSettings& s, nb::handle value) {
            direction(s).azimuth =
                number_from("azimuth", value, {-360, 360, "degrees"}, false) * kDegree;
          },
          nb::arg("degrees"))
      .def(
          "set_elevation",
          [](RenderSettings& s, nb::handle value) {
            direction(s).elevation =
                number_from("elevation", value, {-90, 90, "degrees"}, false) * kDegree;
          },
          nb::arg("degrees"))
      .def(
          "set_hard_edges",
          [](RenderSettings& s, nb::handle value) {
            s.options.hard_angle =
                number_from("hard_edges", value, {0, 180, "degrees"}, false) * kDegree;
          },
          nb::arg("degrees"));
  module.def("render", &render_mesh, nb::arg("mesh"), nb::arg("settings"),
             nb::arg("texture").none(), nb::arg("normal_map").none(), nb::arg("framed_as").none());
}

}  // namespace wrapatlas::python
