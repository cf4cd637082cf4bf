// wrapatlas transfer: a textured model gets a new atlas, and all its textures move there.

#include "wrapatlas/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common.h"
#include "io/file.h"
#include "packing_run.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/model_textures.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::cli {
namespace {

struct TransferArguments {
  PackArguments pack;
  int bits = 8;
};

/// The model with UVs in texels of its textures, each material's charts apart from the others'.
struct TexelMesh {
  Mesh mesh;
  std::vector<std::uint32_t> group;  ///< per face: of the material
  std::size_t group_count = 0;
};

TexelMesh texel_mesh(const Model& model, const ModelTextures& textures) {
  constexpr double kBare = 16;  // texels of a UV unit without textures
  TexelMesh result;
  result.mesh = model.mesh;
  result.group = model.face_material;
  if (result.group.empty()) result.group.assign(model.mesh.face_count(), 0);
  for (const std::uint32_t group : result.group) {
    result.group_count = std::max(result.group_count, std::size_t{group} + 1);
  }
  std::vector<Vec2> size(result.group_count, {kBare, kBare});
  for (const TextureUse& use : textures.uses) {
    if (use.material >= size.size()) continue;  // of a material that no face has
    const auto& m = use.source.matrix;
    const Texture& image = textures.images[use.image];
    Vec2& most = size[use.material];
    most.x = std::max(most.x, std::hypot(m[0] * image.width, m[3] * image.height));
    most.y = std::max(most.y, std::hypot(m[1] * image.width, m[4] * image.height));
  }
  double farthest = 1;
  for (const Vec2 uv : model.mesh.texcoords) {
    farthest = std::max({farthest, std::abs(uv.x), std::abs(uv.y)});
  }
  result.mesh.texcoords.clear();
  for (std::uint32_t face = 0; face < model.mesh.face_count(); ++face) {
    const std::uint32_t group = result.group[face];
    const double apart = 3 * farthest * group;
    for (std::uint32_t c = model.mesh.face_begin[face]; c < model.mesh.face_begin[face + 1]; ++c) {
      std::uint32_t& texcoord = result.mesh.corner_texcoord[c];
      if (texcoord == kNone) continue;
      const Vec2 uv = model.mesh.texcoords[texcoord];
      texcoord = static_cast<std::uint32_t>(result.mesh.texcoords.size());
      result.mesh.texcoords.push_back({size[group].x * (uv.x + apart), size[group].y * uv.y});
    }
  }
  return result;
}

/// One new texture for all uses that are read alike: of one role, from the same images in the same
/// materials.
struct Plan {
  std::vector<TransferTarget> targets;
  std::vector<std::vector<std::size_t>> uses;  ///< per target
  std::vector<std::string> names;
};

Plan plan_of(const ModelTextures& textures, std::size_t group_count) {
  std::map<std::string, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < textures.uses.size(); ++i) {
    if (textures.uses[i].material < group_count) places[textures.uses[i].place].push_back(i);
  }
  std::map<std::string, std::size_t> known;
  Plan plan;
  for (const auto& [place, uses] : places) {
    const TextureRole role = textures.uses[uses.front()].role;
    std::string key = std::to_string(static_cast<int>(role));
    for (const std::size_t use : uses) {
      const TextureUse& one = textures.uses[use];
      key += fmt::format(" {}:{}:{}", one.material, one.image, fmt::join(one.source.matrix, ","));
    }
    const auto [found, is_new] = known.try_emplace(key, plan.targets.size());
    if (is_new) {
      TransferTarget target{role, 1, std::vector<TransferSource>(group_count)};
      for (const std::size_t use : uses) {
        const TextureUse& one = textures.uses[use];
        TransferSource& source = target.of_group[one.material];
        source = one.source;
        source.texture = &textures.images[one.image];
        target.channels = std::max(target.channels, source.texture->channels);
      }
      plan.targets.push_back(std::move(target));
      plan.uses.emplace_back();
      plan.names.push_back(place.substr(place.rfind('/') + 1));
    }
    std::vector<std::size_t>& all = plan.uses[found->second];
    all.insert(all.end(), uses.begin(), uses.end());
  }
  return plan;
}

Status check_options(const CLI::App& app, const TransferArguments& a) {
  const std::string why = "all textures move to one page", remedy = "leave it out";
  const Ignored ignored[] = {
      {"--density", true, why, remedy},
      {"--pages", true, why, remedy},
      {"--udim", true, why, remedy},
      {"--export", true, "charts stay whole", remedy},
      {"--aspect", app.count("--resolution") == 0, "the size is chosen, and square",
       "give --resolution too"},
  };
  if (const Status ok = refuse_ignored(app, ignored); !ok) return ok;
  if (a.bits != 8 && a.bits != 16) {
    return usage(fmt::format("--bits {}", a.bits), "PNG has no such values", "give 8 or 16");
  }
  return Done{};
}

/// Packs at the size asked for, or at the smallest of whole fours at which no texel is lost.
Result<Packing> pack_texels(PackArguments& a, const ChartSet& charts, bool chosen) {
  catch_interrupts();
  ProgressLine line(!a.quiet);
  a.options.progress = [&line](const Progress& progress) {
    line.show(progress);
    return !interrupted();
  };
  if (chosen) return pack(charts.charts, a.options);
  const double asked = a.options.time;
  a.options.time = 0;
  double side = std::sqrt(charts.total_area() / 0.75);
  constexpr double kMost = 16384;
  for (int round = 0;; ++round) {
    side = 4 * std::ceil(std::max(side, 1.0) / 4);
    if (side > kMost) {
      return Error{ErrorKind::no_packing, a.input,
                   fmt::format("to lose no texel the atlas would have {:.0f} a side", side),
                   "give --resolution; where textures repeat often, they had better stay"};
    }
    a.options.width = a.options.height = static_cast<int>(side);
    const bool last = round == 3;
    if (last) a.options.time = asked;
    auto packing = pack(charts.charts, a.options);
    if (!packing || packing->interrupted || last) return packing;
    side *= 1.002 / packing->scale;
  }
}

Json report_of(const TransferArguments& a, const ModelTextures& old, const Plan& plan,
               const ChartSet& charts, const Packing& packing, double seconds) {
  std::size_t before = 0;
  for (const Texture& image : old.images) before += image.texel_count();
  Json made = Json::array();
  for (std::size_t i = 0; i < plan.targets.size(); ++i) {
    made.push_back({{"name", plan.names[i]}, {"channels", plan.targets[i].channels}});
  }
  return {{"version", WRAPATLAS_VERSION},
          {"command", "transfer"},
          {"input", a.pack.input},
          {"output", a.pack.output},
          {"width", packing.width},
          {"height", packing.height},
          {"wrap", name_of(kWraps, packing.wrap)},
          {"padding", a.pack.options.padding},
          {"charts", charts.charts.size()},
          {"efficiency", packing.efficiency},
          {"texel_scale", packing.scale},
          {"textures", made},
          {"texels_before", before},
          {"texels", std::size_t{1} * packing.width * packing.height * plan.targets.size()},
          {"images_before", old.images.size()},
          {"seconds", {{"total", seconds}}},
          {"peak_memory_mb", peak_memory_mb()}};
}

/// Exactly, as pack does it.
Status check_result(const PackArguments& a, const Mesh& before, const AtlasMesh& atlas,
                    const Packing& packing, bool v_points_down) {
  CheckOptions options;
  options.width = packing.width;
  options.height = packing.height;
  options.wrap = packing.wrap;
  options.padding = a.options.padding;
  options.margin = a.margin_in_force();
  options.stacked_ok = true;
  options.v_points_down = v_points_down;
  options.threads = a.options.threads;
  const auto report = check_atlas(apply_atlas(before, atlas), &before, options);
  if (!report) return report.error();
  if (report->ok()) return Done{};
  return Error{ErrorKind::check, a.input, "the finished atlas breaks a promise",
               "nothing was written; please report this as a bug"};
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
  if (const Status ok = keep_input(pack, *model); !ok) return report_error(ok.error());
  const auto old = load_textures(*model);
  if (!old) return report_error(inside_input(pack, old.error()));
  if (old->uses.empty()) {
    return report_error({ErrorKind::input, pack.input, "it has no textures on these UVs",
                         "use wrapatlas pack, or another --texcoord"});
  }
  const TexelMesh texels = texel_mesh(*model, *old);
  const auto charts = build_charts(texels.mesh, Stacked::keep);
  if (!charts) return report_error(inside_input(pack, charts.error()));
  const auto packing = pack_texels(pack, *charts, app.count("--resolution") > 0);
  if (!packing) return report_error(inside_input(pack, packing.error()));
  AtlasMesh atlas = export_continuous(texels.mesh, *charts, *packing, model->v_points_down);
  round_texcoords_to_float(atlas);
  if (const Status ok = check_result(pack, texels.mesh, atlas, *packing, model->v_points_down);
      !ok) {
    return report_error(ok.error());
  }
  const Plan plan = plan_of(*old, texels.group_count);
  TransferOptions options;
  options.width = packing->width;
  options.height = packing->height;
  options.wrap = packing->wrap;
  options.v_points_down = model->v_points_down;
  options.keep_tangents = old->has_tangents;
  options.threads = pack.options.threads;
  const auto made = [&] {
    ProgressLine line(!pack.quiet);
    options.progress = [&line](double share) {
      line.show(fmt::format("moving textures {:3.0f} %", 100 * share));
      return !interrupted();
    };
    return transfer(model->mesh, apply_atlas(model->mesh, atlas), texels.group, plan.targets,
                    options);
  }();
  if (!made) return report_error(inside_input(pack, made.error()));
  std::vector<NewTexture> textures;
  for (std::size_t i = 0; i < made->size(); ++i) {
    auto png = encode_texture((*made)[i], a.bits);
    if (!png) return report_error(png.error());
    textures.push_back({std::move(*png), plan.names[i], plan.uses[i]});
  }
  OutputTransaction outputs;
  if (const Status ok = save_model(*model, atlas, pack.output, textures); !ok) {
    return report_error(ok.error());
  }
  if (!pack.image.empty()) {
    PictureOptions picture = pack.picture;
    picture.v_points_down = model->v_points_down;
    if (const Status ok = save_atlas_picture(pack.image, charts->charts, *packing, picture); !ok) {
      return report_error(ok.error());
    }
  }
  const Json report = report_of(a, *old, plan, *charts, *packing, seconds_now() - start);
  if (!pack.json.empty()) {
    if (const Status ok = write_json(pack.json, report); !ok) return report_error(ok.error());
  }
  if (const Status ok = outputs.commit(); !ok) return report_error(ok.error());
  if (pack.quiet) return 0;
  say("{}: {} of {:.2f} million texels -> {} of {} x {}, {:.2f} million, {:.1f} % in use, scale "
      "{:.2f}, {:.2f} s -> {}\n",
      pack.input, quantity(old->images.size(), "image"),
      1e-6 * report["texels_before"].get<double>(), quantity(textures.size(), "image"),
      packing->width, packing->height, 1e-6 * report["texels"].get<double>(),
      100 * packing->efficiency, packing->scale, seconds_now() - start, pack.output);
  return 0;
}

}  // namespace

Command make_transfer_command(CLI::App& parser) {
  auto arguments = std::make_shared<TransferArguments>();
  CLI::App& app =
      *parser.add_subcommand("transfer", "Pack a textured model anew and move its textures");
  add_number(app, "--bits", arguments->bits, {8, 16, "bits"},
             "Of each value in the new textures: 8 or 16");
  add_pack_options(app, arguments->pack, "Model with textures: .gltf .glb");
  app.footer(std::string(kPackExitStatus) +
             "Without --resolution the atlas is the smallest at which no texture loses texels.\n"
             "Examples:\n"
             "  wrapatlas transfer prop.glb -o moved.glb --padding 8 --image atlas.png\n"
             "  wrapatlas transfer prop.glb -o moved.glb --resolution 1024 --wrap none");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
