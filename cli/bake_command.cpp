// wrapatlas bake: what a detailed mesh looks like, as textures on the atlas of a simpler one.

#include "wrapatlas/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numbers>

#include "bake_output.h"
#include "common.h"
#include "io/file.h"
#include "options.h"
#include "wrapatlas/model.h"
#include "wrapatlas/model_textures.h"

namespace wrapatlas::cli {
namespace {

/// Fills maps and outputs.
Status resolve_maps(BakeArguments& a) {
  a.maps = {a.map};
  a.outputs = {{"-o", a.output}};
  for (const std::string& text : a.also) {
    const std::size_t equals = text.find('=');
    const auto kind = value_of(kBakedMaps, text.substr(0, equals));
    if (equals == std::string::npos || !kind || equals + 1 == text.size()) {
      return usage("--also " + text, "not a kind of map and a file",
                   "give e.g. occlusion=ao.png; kinds are those of --map");
    }
    if (std::find(a.maps.begin(), a.maps.end(), *kind) != a.maps.end()) {
      return usage("--also " + text, "this map is asked for twice", "name each once");
    }
    a.maps.push_back(*kind);
    a.outputs.push_back({"--also", text.substr(equals + 1)});
  }
  for (const OutputPath& output : a.outputs) {
    if (!output.path.ends_with(".png")) {
      return usage(output.path, "maps are written as PNG", "end the name in .png");
    }
  }
  return Done{};
}

Status resolve(const CLI::App& app, BakeArguments& a) {
  if (const Status ok = resolve_maps(a); !ok) return ok;
  const auto has = [&](BakedMap map) {
    return std::find(a.maps.begin(), a.maps.end(), map) != a.maps.end();
  };
  const bool color = has(BakedMap::color), occlusion = has(BakedMap::occlusion);
  const bool normals = std::any_of(a.maps.begin(), a.maps.end(), is_direction);
  const Ignored ignored[] = {
      {"--high-texcoord", !color, "no colour is baked", "add --map color"},
      {"--color-from", !color, "no colour is baked", "add --map color"},
      {"--no-fit", !normals, "no normals are baked", "leave it out"},
      {"--occlusion-rays", !occlusion, "no occlusion is baked", "add --map occlusion"},
      {"--occlusion-distance", !occlusion, "no occlusion is baked", "add --map occlusion"},
  };
  if (const Status ok = refuse_ignored(app, ignored); !ok) return ok;
  constexpr double kDegree = std::numbers::pi / 180;
  if (a.hard_edges) a.options.hard_angle = *a.hard_edges * kDegree;
  if (a.high_hard_edges) a.options.high_hard_angle = *a.high_hard_edges * kDegree;
  a.options.fit = !a.no_fit;
  a.options.width = a.resolution.width;
  a.options.height = a.resolution.height;
  a.options.threads = threads_for(a.options.threads);
  if (const Status ok = check_texcoord(a.high_texcoord, std::span(&a.high, 1), "--high-texcoord");
      !ok) {
    return ok;
  }
  return check_texcoord(a.texcoord, std::span(&a.low, 1));
}

Status check_files(const BakeArguments& a, const Model& low, const Model& high) {
  std::vector<OutputPath> outputs = a.outputs;
  std::size_t levels = 0;
  if (a.mips)
    levels = std::bit_width(static_cast<unsigned>(std::max(a.options.width, a.options.height)));
  for (const OutputPath& map : a.outputs) {
    for (std::size_t level = 1; level < levels; ++level) {
      outputs.push_back({"--mips", level_path(map.path, level)});
    }
  }
  outputs.push_back({"--json", a.json});
  if (const Status ok = refuse_equal_outputs(outputs); !ok) return ok;
  if (const Status ok = refuse_overwriting(a.low, low, outputs); !ok) return ok;
  if (const Status ok = refuse_overwriting(a.high, high, outputs); !ok) return ok;
  for (const OutputPath& output : outputs) {
    if (output.path.empty() || output.path == "-") continue;
    if (!a.color.empty() && same_file(output.path, a.color)) {
      return usage(output.path, "it would overwrite --color-from", "give another name");
    }
    if (const Status ok = check_writable(output.path); !ok) return ok;
  }
  return Done{};
}

Result<Model> load_low(const BakeArguments& a) {
  LoadOptions options;
  options.texcoord_set = a.texcoord;
  options.shading = options.in_scene = true;
  return load_model(a.low, options);
}

Result<Model> load_high(const BakeArguments& a) {
  LoadOptions options;
  options.texcoord_set = a.high_texcoord;
  options.shading = options.in_scene = true;
  options.may_add_set = a.high_texcoord == 0;  // it need not have any
  auto high = load_model(a.high, options);
  if (high) return high;
  Error error = high.error();
  const std::size_t option = error.remedy.find("--texcoord");
  if (option != std::string::npos) error.remedy.insert(option + 2, "high-");
  return error;
}

/// What the colours in a BakeSource point to.
struct HighColors {
  Texture texture;  ///< of --color-from
  BaseColors own;
};

/// Gives the source the colours that are baked: those of --color-from, or the high model's own.
Status add_colors(const BakeArguments& a, const Model& high, HighColors& colors,
                  BakeSource& source) {
  if (!a.color.empty()) {
    auto loaded = load_texture(a.color);
    if (!loaded) return loaded.error();
    colors.texture = std::move(*loaded);
    srgb_to_linear(colors.texture, a.options.threads);
    source.color = &colors.texture;
    return Done{};
  }
  auto found = base_colors(high, a.options.threads);
  if (!found && high.corner_color.empty()) return found.error();
  if (!found && !a.quiet) {
    say("{}: note: baked from the colours of its vertices, without its textures: {}\n", a.high,
        found.error().message());
  }
  if (found) colors.own = *std::move(found);
  source.group_colors = colors.own.groups;
  source.face_group = colors.own.face_group;
  source.corner_color = high.corner_color;
  if (!source.group_colors.empty() || !source.corner_color.empty()) return Done{};
  const bool has_sets = high.format == FileFormat::gltf || high.format == FileFormat::glb;
  return Error{ErrorKind::input, a.high,
               fmt::format("it has no colours: none of its materials{}, and none of its vertices",
                           has_sets ? fmt::format(" by UV set {}", a.high_texcoord) : ""),
               has_sets ? "give --color-from FILE, or --high-texcoord" : "give --color-from FILE"};
}

Result<BakeResult> bake_with_progress(const BakeArguments& a, const Model& low,
                                      const BakeSource& source) {
  BakeOptions options = a.options;
  options.v_points_down = low.v_points_down;
  if (!a.hard_edges) {
    options.corner_normals = low.corner_normal;
    options.corner_tangents = low.corner_tangent;
  }
  catch_interrupts();
  ProgressLine line(!a.quiet);
  options.progress = [&line](double share) {
    line.show(fmt::format("baking {:3.0f} %", 100 * share));
    return !interrupted();
  };
  auto result = bake(low.mesh, source, a.maps, options);
  if (!result) {
    Error error = result.error();
    if (error.kind == ErrorKind::interrupted) {
      return Error{error.kind, a.low, "stopped", "nothing was written"};
    }
    if (error.where == "low mesh") error.where = a.low;
    if (error.where == "high mesh" || error.where == "color") error.where = a.high;
    return error;
  }
  if (result->met) return result;
  return Error{ErrorKind::input, a.low,
               fmt::format("no ray from it met {} within {:.4g}", a.high, result->distance),
               "lay the two over each other, facing alike, or give a larger --distance"};
}

int run(const CLI::App& app, BakeArguments& a) {
  const double start = seconds_now();
  if (const Status ok = resolve(app, a); !ok) return report_error(ok.error());
  const auto low = load_low(a);
  if (!low) return report_error(low.error());
  const auto high = load_high(a);
  if (!high) return report_error(high.error());
  if (const Status ok = check_files(a, *low, *high); !ok) return report_error(ok.error());
  BakeSource source;
  source.mesh = &high->mesh;
  source.v_points_down = high->v_points_down;
  if (!a.high_hard_edges) source.corner_normals = high->corner_normal;
  HighColors colors;
  if (std::find(a.maps.begin(), a.maps.end(), BakedMap::color) != a.maps.end()) {
    if (const Status ok = add_colors(a, *high, colors, source); !ok) {
      return report_error(ok.error());
    }
  }
  const double bake_start = seconds_now();
  auto result = bake_with_progress(a, *low, source);
  if (!result) return report_error(result.error());
  const double baking = seconds_now() - bake_start;
  OutputTransaction outputs;
  for (std::size_t i = 0; i < a.maps.size(); ++i) {
    if (const Status ok = save_map(a, i, result->maps[i]); !ok) return report_error(ok.error());
  }
  const double seconds = seconds_now() - start;
  if (!a.json.empty()) {
    if (const Status ok = write_json(a.json, report_of(a, *result, seconds, baking)); !ok) {
      return report_error(ok.error());
    }
  }
  if (const Status ok = outputs.commit(); !ok) return report_error(ok.error());
  if (!a.quiet) summarize(a, *result, seconds);
  return 0;
}

}  // namespace

Command make_bake_command(CLI::App& parser) {
  auto arguments = std::make_shared<BakeArguments>();
  BakeArguments& a = *arguments;
  CLI::App& app =
      *parser.add_subcommand("bake", "Write a detailed mesh into the atlas of a simpler one");
  app.add_option("low", a.low, "Model with an atlas: .obj .ply .off .gltf .glb")->required();
  app.add_option("high", a.high, "Model to be baked: .obj .ply .off .stl .gltf .glb")->required();
  app.add_option("-o,--output", a.output, "Where to write the map")
      ->required()
      ->type_name("FILE.png");
  add_choice(app, "--map", a.map, kBakedMaps,
             "tangent: normals along tangents as MikkTSpace makes them, green up; object: normals "
             "along the model's axes; position; occlusion: how much of the sky is seen; color: of "
             "the textures that the high model names, or else of its vertices");
  app.add_option("--also", a.also,
                 "Another map in the same run, e.g. occlusion=ao.png; may be repeated")
      ->type_name("KIND=FILE.png");
  add_resolution(app, a.resolution);
  add_choice(app, "--wrap", a.options.wrap, kWraps,
             "Axes on which the atlas repeats, as it was packed");
  add_bits(app, a.bits);
  add_number(app, "--samples", a.options.samples, {1, 16},
             "Places that each texel looks at, squared");
  app.add_flag(
      "--no-fit", a.no_fit,
      "Do not fit normals to how they are filtered: each texel is the mean of its samples, "
      "which is softer");
  add_bleed(app, a.options.bleed);
  add_number(app, "--distance", a.options.distance, {0, 1e30},
             "How far from the low model the high one is looked for, along the normal and back, in "
             "units of the files; 0: twice the largest distance between them, or a little");
  add_number(app, "--hard-edges", a.hard_edges, {0, 180, "degrees"},
             "The low model is smooth but for edges whose faces differ by more, and has to be "
             "rendered so. Default: the normals in its file, or smooth everywhere");
  add_number(app, "--high-hard-edges", a.high_hard_edges, {0, 180, "degrees"},
             "The same of the high model; 0: its faces are flat");
  app.add_option("--color-from", a.color,
                 "Texture of the high model, PNG or JPEG, sRGB; in place of its own colours")
      ->type_name("FILE");
  add_number(app, "--occlusion-rays", a.options.occlusion_rays, {1, 65536}, "Rays of each sample");
  add_number(app, "--occlusion-distance", a.options.occlusion_distance, {0, 1e30},
             "What is farther away hides nothing, in units of the files; 0: no end");
  app.add_flag("--mips", a.mips, "Write the smaller levels too, as MAP.1.png, MAP.2.png, ...");
  add_texcoord(app, a.texcoord);
  add_number(app, "--high-texcoord", a.high_texcoord, {0, 15},
             "UV set by which the high model's colours are read, if it is a glTF");
  add_threads(app, a.options.threads);
  add_json(app, a.json);
  app.add_flag("--quiet", a.quiet, "No progress, no summary, no notes");
  app.footer(
      "Exit status: 0 written; 2 usage; 3 unusable input or output; 130 interrupted.\n"
      "Examples:\n"
      "  wrapatlas bake low.glb scan.ply -o normal.png --resolution 2048\n"
      "  wrapatlas bake low.obj scan.ply -o n.png --map object --bits 16 --also occlusion=ao.png");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
