// Textures: baked, moved to another atlas, read and written.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <numbers>

#include "arrays.h"
#include "bind.h"
#include "long_work.h"
#include "settings.h"
#include "wrapatlas/bake.h"
#include "wrapatlas/transfer.h"

namespace wrapatlas::python {
namespace {

constexpr Named<TextureRole> kRoles[] = {
    {"color", TextureRole::color}, {"normals", TextureRole::normals}, {"data", TextureRole::data}};
constexpr Named<Repeat> kRepeats[] = {
    {"repeat", Repeat::repeat}, {"mirror", Repeat::mirror}, {"clamp", Repeat::clamp}};

std::vector<BakedMap> maps_of(const std::vector<std::string>& kinds) {
  std::vector<BakedMap> maps;
  for (const std::string& kind : kinds) {
    const auto map = value_of(kBakedMaps, kind);
    if (!map) {
      raise(usage("map='" + kind + "'", "no such choice",
                  "give tangent, object, position, occlusion or color"));
    }
    if (std::find(maps.begin(), maps.end(), *map) != maps.end()) {
      raise(usage("map='" + kind + "'", "it is asked for twice", "name each once"));
    }
    maps.push_back(*map);
  }
  return maps;
}

std::shared_ptr<BakeResult> bake_maps(const PyMesh& low, const PyMesh& high,
                                      const std::vector<std::string>& kinds,
                                      const std::optional<AnyArray>& color, BakeOptions options,
                                      nb::object progress) {
  const std::vector<BakedMap> maps = maps_of(kinds);
  for (const PyMesh* mesh : {&low, &high}) {
    if (!mesh->has_space) raise(usage("bake", "a mesh has no positions", "pass them"));
  }
  Texture texture;
  if (color) texture = read_texture(*color, "color_from");
  options.v_points_down = low.model->v_points_down;
  LongWork work(std::move(progress), false);
  BakeResult result = work.run<BakeResult>([&] {
    BakeSource source;
    source.mesh = &high.mesh();
    source.v_points_down = high.model->v_points_down;
    if (color) {
      srgb_to_linear(texture);
      source.color = &texture;
    }
    options.progress = [&work](double share) { return work.tell("bake", share); };
    auto baked = bake(low.mesh(), source, maps, options);
    if (!baked) return baked;
    for (std::size_t i = 0; i < maps.size(); ++i) {
      if (maps[i] == BakedMap::color) linear_to_srgb(baked->maps[i]);
    }
    work.tell("bake", 1);
    return baked;
  });
  if (!result.met) {
    raise(bad_input("high", fmt::format("no ray met it within {:.4g}", result.distance),
                    "lay both meshes over each other, facing alike, or give a larger distance="));
  }
  return std::make_shared<BakeResult>(std::move(result));
}

void bind_bake(nb::module_& module) {
  nb::class_<BakeOptions> options(module, "BakeSettings");
  options.def(nb::init<>());
  const auto number = [&](const char* name, auto member, Range range) {
    add_number(options, name, member, range);
  };
  number("width", [](BakeOptions & o) -> auto& { return o.width; },
         {1, double{kMostTexels}, "texels"});
  number("height", [](BakeOptions & o) -> auto& { return o.height; },
         {1, double{kMostTexels}, "texels"});
  number("samples", [](BakeOptions & o) -> auto& { return o.samples; }, {1, 16});
  options.def_rw("fit", &BakeOptions::fit);
  number("bleed", [](BakeOptions & o) -> auto& { return o.bleed; },
         {0, double{kMostTexels}, "texels"});
  number("distance", [](BakeOptions & o) -> auto& { return o.distance; }, {0, 1e30});
  number("occlusion_rays", [](BakeOptions & o) -> auto& { return o.occlusion_rays; }, {1, 65536});
  number("occlusion_distance", [](BakeOptions & o) -> auto& { return o.occlusion_distance; },
         {0, 1e30});
  number("threads", [](BakeOptions & o) -> auto& { return o.threads; }, {0, 1024, "threads"});
  add_choice(
      options, "wrap", kWraps, [](BakeOptions & o) -> auto& { return o.wrap; });
  const auto angle = [&](const char* name, double BakeOptions::*member) {
    options.def_prop_rw(
        name, [member](const BakeOptions& o) { return o.*member * 180 / std::numbers::pi; },
        [member, name](BakeOptions& o, nb::handle value) {
          o.*member = number_from(name, value, {0, 180, "degrees"}, false) * std::numbers::pi / 180;
        });
  };
  angle("hard_edges", &BakeOptions::hard_angle);
  angle("high_hard_edges", &BakeOptions::high_hard_angle);
  nb::class_<BakeResult>(module, "BakedMaps")
      .def(
          "take",
          [](BakeResult& b, std::size_t i) {
            if (i >= b.maps.size()) throw nb::index_error("no such map");
            return own(std::move(b.maps[i]));
          },
          nb::arg("index"), "The map, which is not here any more then: (height, width, channels)")
      .def(
          "take_inside",
          [](BakeResult& b, std::size_t width, std::size_t height) {
            return own(std::move(b.inside), {height, width});
          },
          nb::arg("width"), nb::arg("height"))
      .def_prop_ro("texels_nearest", [](const BakeResult& b) { return b.texels_nearest; })
      .def_prop_ro("faces_without_uv", [](const BakeResult& b) { return b.faces_without_uv; })
      .def_prop_ro("faces_outside", [](const BakeResult& b) { return b.faces_outside; })
      .def_prop_ro("distance", [](const BakeResult& b) { return b.distance; })
      .def_prop_ro("position_origin",
                   [](const BakeResult& b) {
                     const Vec3 p = b.low_corner;
                     return std::tuple(p.x, p.y, p.z);
                   })
      .def_prop_ro("position_extent", [](const BakeResult& b) { return b.extent; });
  module.def("bake", &bake_maps, nb::arg("low"), nb::arg("high"), nb::arg("kinds"),
             nb::arg("color").none(), nb::arg("settings"), nb::arg("progress").none());
}

struct TransferSettings {
  TransferOptions options;
  TextureRole role = TextureRole::color;
  Repeat repeat = Repeat::repeat;
  bool keep_tangents = false;  ///< of all faces
};

/// `textures`: of each group of faces.
nb::ndarray<nb::numpy, float> transfer_texture(const PyMesh& before, const PyMesh& after,
                                               const std::vector<std::optional<AnyArray>>& textures,
                                               const std::optional<AnyArray>& face_group,
                                               const TransferSettings& settings,
                                               nb::object progress) {
  std::vector<Texture> old;
  for (const std::optional<AnyArray>& texture : textures) {
    old.push_back(texture ? read_texture(*texture, "texture") : Texture());
  }
  std::vector<std::uint32_t> group(before.mesh().face_count(), 0);
  if (face_group) {
    group = read_indices(*face_group, "face_texture", old.size(), "textures");
  }
  TransferTarget target{settings.role, 1, std::vector<TransferSource>(old.size())};
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (old[i].values.empty()) continue;
    target.of_group[i].texture = &old[i];
    target.of_group[i].across = target.of_group[i].down = settings.repeat;
    target.channels = std::max(target.channels, old[i].channels);
  }
  TransferOptions options = settings.options;
  options.v_points_down = after.model->v_points_down;
  const bool turned = before.model->v_points_down != after.model->v_points_down;
  const Mesh other_way = turned ? upside_down(before.mesh()) : Mesh();
  const Mesh& source = turned ? other_way : before.mesh();
  const std::vector<std::uint8_t> keeps(settings.keep_tangents ? group.size() : 0, 1);
  options.keeps_tangents = keeps;
  LongWork work(std::move(progress), false);
  auto made = work.run<std::vector<Texture>>([&] {
    options.progress = [&work](double share) { return work.tell("transfer", share); };
    auto result = transfer(source, after.mesh(), group, {&target, 1}, options);
    if (result) work.tell("transfer", 1);
    return result;
  });
  return own(std::move(made.front()));
}

void bind_transfer(nb::module_& module) {
  nb::class_<TransferSettings> settings(module, "TransferSettings");
  settings.def(nb::init<>());
  add_number(settings, "width", [](TransferSettings & s) -> auto& { return s.options.width; },
             {1, double{kMostTexels}, "texels"});
  add_number(settings, "height", [](TransferSettings & s) -> auto& { return s.options.height; },
             {1, double{kMostTexels}, "texels"});
  add_number(settings, "bleed", [](TransferSettings & s) -> auto& { return s.options.bleed; },
             {0, double{kMostTexels}, "texels"});
  add_number(settings, "threads", [](TransferSettings & s) -> auto& { return s.options.threads; },
             {0, 1024, "threads"});
  add_choice(
      settings, "wrap", kWraps, [](TransferSettings & s) -> auto& { return s.options.wrap; });
  add_choice(
      settings, "role", kRoles, [](TransferSettings & s) -> auto& { return s.role; });
  add_choice(
      settings, "repeat", kRepeats, [](TransferSettings & s) -> auto& { return s.repeat; });
  settings.def_prop_rw(
      "keep_tangents", [](const TransferSettings& s) { return s.keep_tangents; },
      [](TransferSettings& s, bool on) { s.keep_tangents = on; });
  module.def("transfer", &transfer_texture, nb::arg("before"), nb::arg("after"),
             nb::arg("textures"), nb::arg("face_texture").none(), nb::arg("settings"),
             nb::arg("progress").none());
}

nb::bytes encode(const AnyArray& pixels, int bits) {
  const Texture texture = read_texture(pixels, "image");
  const std::string png = take([&] {
    const nb::gil_scoped_release unlocked;
    return encode_texture(texture, bits);
  }());
  return nb::bytes(png.data(), png.size());
}

void save_pixels(const std::string& path, const AnyArray& pixels, int bits) {
  const Texture texture = read_texture(pixels, "image");
  const Status ok = [&] {
    const nb::gil_scoped_release unlocked;
    return save_texture(path, texture, bits);
  }();
  if (!ok) raise(ok.error());
}

nb::ndarray<nb::numpy, float> load_pixels(const std::string& path) {
  auto texture = [&] {
    const nb::gil_scoped_release unlocked;
    return load_texture(path);
  }();
  return own(take(std::move(texture)));
}

}  // namespace

void bind_textures(nb::module_& module) {
  bind_bake(module);
  bind_transfer(module);
  module.def("encode_png", &encode, nb::arg("pixels"), nb::arg("bits"));
  module.def("save_image", &save_pixels, nb::arg("path"), nb::arg("pixels"), nb::arg("bits"));
  module.def("load_image", &load_pixels, nb::arg("path"));
}

}  // namespace wrapatlas::python
