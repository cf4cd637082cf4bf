// wrapatlas transfer: a textured model gets new atlases, and all its textures move there.

#include "wrapatlas/transfer.h"

#include <fmt/format.h>

#include <filesystem>

#include "common.h"
#include "io/file.h"
#include "transfer_atlas.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/model_textures.h"

namespace wrapatlas::cli {
namespace {

/// Of packing, but not here; left out of the help.
constexpr const char* kRefused[] = {"--density", "--pages", "--udim", "--export"};

Status check_options(const CLI::App& app, TransferArguments& a) {
  a.size_given = app.count("--resolution") > 0;
  std::vector<Ignored> ignored{
      {"--aspect", !a.size_given, "the size is chosen, and square", "give --resolution too"}};
  for (const char* option : kRefused) {
    ignored.push_back({option, true, "textures move to one page, charts whole", "leave it out"});
  }
  if (const Status ok = refuse_ignored(app, ignored); !ok) return ok;
  return Done{};
}

/// "atlas.png" for the only one; "atlas-2.png" for the second of several.
std::string picture_path(const std::string& path, std::size_t index, std::size_t count) {
  if (count < 2) return path;
  std::filesystem::path numbered(path);
  numbered.replace_filename(
      fmt::format("{}-{}{}", numbered.stem().string(), index + 1, numbered.extension().string()));
  return numbered.string();
}

/// Of several atlases pictures have other names than the one that was looked at.
Status check_pictures(const PackArguments& pack, const Model& model, std::size_t count) {
  if (pack.image.empty()) return Done{};
  std::vector<OutputPath> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    pictures.push_back({"--image", picture_path(pack.image, i, count)});
    if (const Status ok = check_writable(pictures.back().path); !ok) return ok;
  }
  if (const Status ok = refuse_overwriting(pack.input, model, pictures); !ok) return ok;
  pictures.push_back({"-o", pack.output});
  pictures.push_back({"--json", pack.json});
  return refuse_equal_outputs(pictures);
}

struct Totals {
  std::size_t images_before = 0, texels_before = 0, images = 0, texels = 0, charts = 0;
};

Totals totals_of(const ModelTextures& old, const std::vector<NewAtlas>& atlases) {
  Totals t;
  t.images_before = old.images.size();
  for (const Texture& image : old.images) t.texels_before += image.texel_count();
  for (const NewAtlas& atlas : atlases) {
    t.charts += atlas.charts.charts.size();
    t.images += atlas.textures.size();
    for (const Texture& texture : atlas.textures) t.texels += texture.texel_count();
  }
  return t;
}

Json report_of(const TransferArguments& a, const std::vector<TextureSet>& sets,
               const std::vector<NewAtlas>& atlases, const Totals& totals, double seconds) {
  Json list = Json::array();
  for (std::size_t i = 0; i < atlases.size(); ++i) {
    const Packing& packing = atlases[i].packing;
    Json textures = Json::array();
    for (const SetTexture& texture : sets[i].textures) {
      textures.push_back({{"name", texture.name}, {"channels", texture.target.channels}});
    }
    list.push_back({{"faces", sets[i].faces.size()},
                    {"charts", atlases[i].charts.charts.size()},
                    {"width", packing.width},
                    {"height", packing.height},
                    {"efficiency", packing.efficiency},
                    {"texel_scale", packing.scale},
                    {"thinned", atlases[i].thinned},
                    {"textures", textures}});
  }
  return {{"version", WRAPATLAS_VERSION},
          {"command", "transfer"},
          {"input", a.pack.input},
          {"output", a.pack.output},
          {"wrap", name_of(kWraps, a.pack.options.wrap)},
          {"padding", a.pack.options.padding},
          {"bleed", a.bleed},
          {"atlases", list},
          {"images_before", totals.images_before},
          {"images", totals.images},
          {"texels_before", totals.texels_before},
          {"texels", totals.texels},
          {"seconds", {{"total", seconds}}},
          {"peak_memory_mb", peak_memory_mb()}};
}

/// Everything that was asked for, or nothing.
Status write(const TransferArguments& a, const Model& model, const std::vector<TextureSet>& sets,
             const std::vector<NewAtlas>& atlases, const Json& report) {
  AtlasMesh whole = keep_texcoords(model.mesh);
  std::vector<NewTexture> textures;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    place_part(whole, sets[i].faces, atlases[i].atlas);
    for (std::size_t t = 0; t < sets[i].textures.size(); ++t) {
      auto png = encode_texture(atlases[i].textures[t], a.bits);
      if (!png) return png.error();
      const SetTexture& texture = sets[i].textures[t];
      const std::string name =
          sets.size() == 1 ? texture.name : fmt::format("{}-{}", i + 1, texture.name);
      textures.push_back({*std::move(png), name, texture.uses});
    }
  }
  OutputTransaction outputs;
  if (const Status ok = save_model(model, whole, a.pack.output, textures); !ok) return ok;
  for (std::size_t i = 0; i < sets.size() && !a.pack.image.empty(); ++i) {
    PictureOptions picture = a.pack.picture;
    picture.v_points_down = model.v_points_down;
    const std::string path = picture_path(a.pack.image, i, sets.size());
    if (const Status ok =
            save_atlas_picture(path, atlases[i].charts.charts, atlases[i].packing, picture);
        !ok) {
      return ok;
    }
  }
  if (!a.pack.json.empty()) {
    if (const Status ok = write_json(a.pack.json, report); !ok) return ok;
  }
  return outputs.commit();
}

void say_result(const TransferArguments& a, const std::vector<NewAtlas>& atlases,
                const Totals& totals, double seconds) {
  constexpr double kWorthSaying = 0.01;
  for (std::size_t i = 0; i < atlases.size(); ++i) {
    if (atlases[i].thinned < kWorthSaying) continue;
    const std::string number = atlases.size() > 1 ? fmt::format("atlas {}: ", i + 1) : "";
    const bool is_of_size = a.size_given && atlases[i].packing.scale < 0.9;  // of all faces alike
    say("{}: note: {}{:.0f} % of the old texels lie on faces that have less than nine tenths of "
        "their detail now{}\n",
        a.pack.input, number, 100 * atlases[i].thinned,
        is_of_size ? " at this size"
                   : (a.unwrap ? ": a new chart has one scale, its faces had several" : ""));
  }
  constexpr double kMuchMore = 2;
  const double growth =
      static_cast<double>(totals.texels) / static_cast<double>(totals.texels_before);
  if (growth > kMuchMore) {
    say("{}: note: {:.1f} times as many texels as before; --resolution sets a smaller size\n",
        a.pack.input, growth);
  }
  if (atlases.size() > 1) {
    for (std::size_t i = 0; i < atlases.size(); ++i) {
      const Packing& packing = atlases[i].packing;
      say("{}: atlas {}: {} of {} x {}, {:.1f} % in use, scale {:.2f}\n", a.pack.input, i + 1,
          quantity(atlases[i].textures.size(), "image"), packing.width, packing.height,
          100 * packing.efficiency, packing.scale);
    }
  }
  const std::string before =
      fmt::format("{} of {:.2f} million texels", quantity(totals.images_before, "image"),
                  1e-6 * static_cast<double>(totals.texels_before));
  const double after = 1e-6 * static_cast<double>(totals.texels);
  if (atlases.size() == 1) {
    const Packing& packing = atlases.front().packing;
    say("{}: {} -> {} of {} x {}, {:.2f} million, {:.1f} % in use, scale {:.2f}, {:.2f} s -> {}\n",
        a.pack.input, before, quantity(totals.images, "image"), packing.width, packing.height,
        after, 100 * packing.efficiency, packing.scale, seconds, a.pack.output);
  } else {
    say("{}: {} -> {} on {}, {:.2f} million, {:.2f} s -> {}\n", a.pack.input, before,
        quantity(totals.images, "image"), quantity(atlases.size(), "atlas", "atlases"), after,
        seconds, a.pack.output);
  }
}

int run(const CLI::App& app, TransferArguments& a) {
  const double start = seconds_now();
  PackArguments& pack = a.pack;
  if (const Status ok = check_options(app, a); !ok) return report_error(ok.error());
  if (const Status ok = resolve_pack_options(app, pack); !ok) return report_error(ok.error());
  if (const Status ok = check_outputs(pack); !ok) return report_error(ok.error());
  LoadOptions load_options;
  load_options.texcoord_set = pack.texcoord;
  const auto model = load_model(pack.input, load_options);
  if (!model) return report_error(model.error());
  if (const Status ok = takes_textures(*model, pack.output); !ok) {
    return report_error(ok.error().where.empty() ? inside_input(pack, ok.error()) : ok.error());
  }
  if (const Status ok = keep_input(pack, *model); !ok) return report_error(ok.error());
  const auto old = load_textures(*model);
  if (!old) return report_error(inside_input(pack, old.error()));
  if (old->has_variants) {
    return report_error({ErrorKind::input, pack.input,
                         "its faces have other materials too (KHR_materials_variants), whose "
                         "textures would not follow",
                         "take the variants out first"});
  }
  const std::vector<TextureSet> sets =
      texture_sets(model->mesh, model->face_material, *old, a.merge);
  if (sets.empty()) {
    const bool has_uvs = !model->mesh.texcoords.empty();
    return report_error({ErrorKind::input, pack.input, "no face has a texture on these UVs",
                         has_uvs ? "use wrapatlas pack, or another --texcoord"
                                 : "it has no UVs: use wrapatlas unwrap"});
  }
  if (const Status ok = check_pictures(pack, *model, sets.size()); !ok)
    return report_error(ok.error());
  catch_interrupts();
  std::vector<NewAtlas> atlases;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string label =
        sets.size() == 1 ? "" : fmt::format("atlas {} of {}: ", i + 1, sets.size());
    auto atlas = pack_texture_set(a, sets[i], model->v_points_down, label);
    if (!atlas) return report_error(inside_input(pack, atlas.error()));
    if (const Status ok = fill_textures(a, sets[i], model->v_points_down, label, *atlas); !ok) {
      return report_error(inside_input(pack, ok.error()));
    }
    atlases.push_back(*std::move(atlas));
  }
  const Totals totals = totals_of(*old, atlases);
  const double seconds = seconds_now() - start;
  if (const Status ok =
          write(a, *model, sets, atlases, report_of(a, sets, atlases, totals, seconds));
      !ok) {
    return report_error(ok.error());
  }
  if (!pack.quiet) say_result(a, atlases, totals, seconds_now() - start);
  return 0;
}

}  // namespace

Command make_transfer_command(CLI::App& parser) {
  auto arguments = std::make_shared<TransferArguments>();
  CLI::App& app =
      *parser.add_subcommand("transfer", "Pack a textured model anew and move its textures");
  app.add_flag("--merge", arguments->merge,
               "One atlas for all materials; else one for those that have the same textures");
  app.add_flag("--unwrap", arguments->unwrap,
               "Cut the model into new charts, few and large, instead of packing those it has");
  add_bits(app, arguments->bits);
  add_bleed(app, arguments->bleed);
  add_pack_options(app, arguments->pack, "Model with textures: .gltf .glb .obj");
  app.get_option("--output")
      ->description(
          "Where to write it, in the input's format. The pictures of an OBJ go beside it");
  app.get_option("--resolution")->default_str("");
  for (const char* option : kRefused) app.get_option(option)->group("");  // not in the help
  app.footer(
      std::string(kPackExitStatus) +
      "Without --resolution an atlas is about the smallest at which no texture loses texels; with\n"
      "--unwrap, at which faces keep theirs in the mean.\n"
      "--time is for each atlas.\n"
      "Examples:\n"
      "  wrapatlas transfer prop.glb -o moved.glb --padding 8 --image atlas.png\n"
      "  wrapatlas transfer scan.obj -o moved.obj --unwrap --resolution 4096\n"
      "  wrapatlas transfer prop.glb -o moved.glb --merge --resolution 1024 --wrap none");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
