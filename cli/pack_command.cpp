// wrapatlas pack: read a model, pack its charts, check the result, write it.

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "common.h"
#include "io/file.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/model.h"
#include "wrapatlas/picture.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::cli {
namespace {

struct PackArguments {
  std::string input, output, resolution = "1024", aspect, wrap, json, image;
  std::string method = "modulo", export_mode = "continuous", stacked = "separate";
  std::string coverage = "conservative", rotation_base = "input";
  std::optional<double> padding, margin;
  int texcoord = 0;
  bool quiet = false, verbose = false, image_tiles = false, no_inner = false;
  PackOptions options;
};

/// What happened, for the report.
struct Outcome {
  double read = 0, charts = 0, pack = 0, validate = 0, write = 0;
  bool valid = true;
};

Error usage(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::usage, std::move(where), std::move(what), std::move(remedy)};
}

Error inside_input(const PackArguments& arguments, Error error) {
  error.where = arguments.input + (error.where.empty() ? "" : ": " + error.where);
  return error;
}

/// --resolution and --aspect together give the size in texels.
Status resolve_size(const PackArguments& arguments, PackOptions& options) {
  const auto size = parse_resolution(arguments.resolution);
  if (!size) return size.error();
  options.width = size->width;
  options.height = size->height;
  const std::string& aspect = arguments.aspect;
  if (aspect.empty()) return Done{};
  if (size->two_sided) {
    return usage("--aspect " + aspect, "--resolution WxH already gives the shape",
                 "leave out --aspect, or give --resolution N");
  }
  if (aspect == "search") {
    options.search_aspect = true;
    return Done{};
  }
  double across = 1, up = 1;
  if (aspect != "square") {
    const std::size_t colon = aspect.find(':');
    const bool numbers = colon != std::string::npos &&
                         CLI::detail::lexical_cast(aspect.substr(0, colon), across) &&
                         CLI::detail::lexical_cast(aspect.substr(colon + 1), up);
    if (!numbers || !(across > 0 && up > 0) || across / up > 1024 || up / across > 1024) {
      return usage("--aspect " + aspect, "not an aspect ratio",
                   "give square, search or W:H, e.g. 2:1, at most 1024:1");
    }
  }
  const double stretch = std::sqrt(across / up);
  const auto texels = [&](double side) {
    const double block = options.block;
    return static_cast<int>(std::max(1.0, std::round(side / block)) * block);
  };
  options.width = texels(size->width * stretch);
  options.height = texels(size->height / stretch);
  return Done{};
}

Status resolve_options(PackArguments& arguments) {
  PackOptions& options = arguments.options;
  options.method = parse_method(arguments.method);
  if (const Status ok = resolve_size(arguments, options); !ok) return ok;
  const bool can_wrap = options.method == Method::modulo;
  options.wrap =
      arguments.wrap.empty() ? (can_wrap ? Wrap::uv : Wrap::none) : parse_wrap(arguments.wrap);
  if (!can_wrap && options.wrap != Wrap::none) {
    return usage("--wrap " + arguments.wrap,
                 fmt::format("{} cannot wrap around the border", arguments.method),
                 "use --method modulo, or --wrap none");
  }
  options.padding =
      arguments.padding.value_or(std::max(2.0, std::max(options.width, options.height) / 256.0));
  options.margin = arguments.margin.value_or(-1);
  options.coverage = arguments.coverage == "center" ? Coverage::center : Coverage::conservative;
  options.rotation_base =
      arguments.rotation_base == "box" ? RotationBase::box : RotationBase::input;
  options.inner = !arguments.no_inner;
  return Done{};
}

std::optional<Error> check_result(const PackArguments& arguments, const Model& model,
                                  const AtlasMesh& atlas, const Packing& packing,
                                  Outcome& outcome) {
  const double start = seconds_now();
  CheckOptions options;
  options.width = packing.width;
  options.height = packing.height;
  // A cut atlas must hold without any wrapping; the margin is then none's concern.
  const bool cut = arguments.export_mode == "cut";
  options.wrap = cut ? Wrap::none : packing.wrap;
  options.padding = arguments.options.padding;
  options.margin =
      arguments.options.margin < 0 ? arguments.options.padding / 2 : arguments.options.margin;
  if (cut && packing.wrap != Wrap::none) options.margin = 0;
  options.stacked_ok = arguments.stacked == "keep";
  options.threads = arguments.options.threads;
  const auto report = check_atlas(apply_atlas(model.mesh, atlas), &model.mesh, options);
  outcome.validate = seconds_now() - start;
  if (!report) return inside_input(arguments, report.error());
  outcome.valid = report->ok();
  if (report->ok()) return std::nullopt;
  const std::string first = report->findings.empty() ? "" : ": " + report->findings.front().text;
  return Error{ErrorKind::check, arguments.input,
               fmt::format("the finished atlas breaks {} promises{}", report->violations, first),
               "nothing was written; please report this as a bug"};
}

Json to_json(const PackArguments& arguments, const ChartSet& charts, const Packing& packing,
             const Outcome& outcome, double total) {
  return {{"version", WRAPATLAS_VERSION},
          {"command", "pack"},
          {"input", arguments.input},
          {"output", arguments.output},
          {"method", arguments.method},
          {"wrap", wrap_name(packing.wrap)},
          {"export", arguments.export_mode},
          {"width", packing.width},
          {"height", packing.height},
          {"pages", 1},
          {"charts", charts.charts.size()},
          {"placed", packing.placements.size()},
          {"stacked", charts.stacked},
          {"self_overlapping", charts.self_overlapping},
          {"faces_without_uv", charts.faces_without_uv},
          {"padding", arguments.options.padding},
          {"coverage", arguments.coverage},
          {"grid", {packing.grid_width, packing.grid_height}},
          {"rotations", arguments.options.rotations},
          {"scale", packing.scale},
          {"efficiency", packing.efficiency},
          {"raster_efficiency", packing.raster_efficiency},
          {"packings", packing.packings},
          {"valid", outcome.valid},
          {"interrupted", packing.interrupted},
          {"seconds",
           {{"total", total},
            {"read", outcome.read},
            {"charts", outcome.charts},
            {"pack", outcome.pack},
            {"raster", packing.raster_seconds},
            {"place", packing.place_seconds},
            {"validate", outcome.validate},
            {"write", outcome.write}}},
          {"peak_memory_mb", peak_memory_mb()},
          {"seed", arguments.options.seed},
          {"threads", arguments.options.threads}};
}

void print_summary(const PackArguments& arguments, const ChartSet& charts, const Packing& packing,
                   double total) {
  say("{}: {} charts on {} x {} texels, {:.1f} % in use, {:.2f} s{} -> {}\n", arguments.input,
      charts.charts.size(), packing.width, packing.height, 100 * packing.efficiency, total,
      packing.interrupted ? " (interrupted: the best so far)" : "", arguments.output);
  if (!arguments.verbose) return;
  say("  method {}, wrap {}, padding {} texels, {} rotations, grid {} x {}\n", arguments.method,
      wrap_name(packing.wrap), arguments.options.padding, arguments.options.rotations,
      packing.grid_width, packing.grid_height);
  say("  {} packings, scale {:.6g} texels per UV unit, raster {:.3f} s, place {:.3f} s\n",
      packing.packings, packing.scale, packing.raster_seconds, packing.place_seconds);
}

void print_remarks(const PackArguments& arguments, const Model& model, const ChartSet& charts) {
  if (arguments.quiet) return;
  const auto remark = [&](const std::string& text) {
    say("{}: note: {}\n", arguments.input, printable(text));
  };
  for (const std::string& text : model.remarks) remark(text);
  if (charts.faces_without_uv > 0) {
    remark(fmt::format("{} faces have no UVs and stay as they are", charts.faces_without_uv));
  }
  if (charts.self_overlapping > 0) {
    remark(fmt::format("{} charts overlap themselves in the input", charts.self_overlapping));
  }
  if (arguments.verbose && charts.stacked > 0) {
    remark(fmt::format("{} charts overlap others in the input and are {}", charts.stacked,
                       arguments.stacked == "keep" ? "kept together" : "separated"));
  }
}

/// What can be known of the outputs before the work begins.
Status check_outputs(const PackArguments& arguments) {
  const auto format = format_from_path(arguments.output);
  if (!format) return format.error();
  if (*format == FileFormat::off || *format == FileFormat::stl) {
    return usage(arguments.output, "OFF and STL files cannot hold UVs",
                 "write .obj, .ply, .gltf or .glb");
  }
  if (arguments.image.empty()) return Done{};
  return check_picture_path(arguments.image);
}

int run(PackArguments& arguments) {
  const double start = seconds_now();
  if (const Status ok = resolve_options(arguments); !ok) return report_error(ok.error());
  if (const Status ok = check_outputs(arguments); !ok) return report_error(ok.error());
  Outcome outcome;
  LoadOptions load_options;
  load_options.texcoord_set = arguments.texcoord;
  const auto model = load_model(arguments.input, load_options);
  if (!model) return report_error(model.error());
  outcome.read = seconds_now() - start;

  const double charts_start = seconds_now();
  auto charts =
      build_charts(model->mesh, arguments.stacked == "keep" ? Stacked::keep : Stacked::separate);
  if (!charts) {
    return report_error(inside_input(arguments, charts.error()));
  }
  outcome.charts = seconds_now() - charts_start;
  print_remarks(arguments, *model, *charts);

  const double pack_start = seconds_now();
  catch_interrupts();
  std::optional<ProgressLine> line(std::in_place, !arguments.quiet);
  arguments.options.progress = [&line](const Progress& progress) {
    line->show(progress);
    return !interrupted();
  };
  auto packing = pack(charts->charts, arguments.options);
  line.reset();
  if (!packing) {
    return report_error(inside_input(arguments, packing.error()));
  }
  outcome.pack = seconds_now() - pack_start;

  AtlasMesh atlas = arguments.export_mode == "cut"
                        ? export_cut(model->mesh, *charts, *packing)
                        : export_continuous(model->mesh, *charts, *packing);
  round_texcoords_to_float(atlas);
  if (const auto error = check_result(arguments, *model, atlas, *packing, outcome)) {
    // The paper's coverage is known to be unsafe; who asks for it gets it, with a warning.
    if (error->kind != ErrorKind::check || arguments.options.coverage != Coverage::center) {
      return report_error(*error);
    }
    say("{}: warning: {} (--coverage center is not safe)\n", arguments.input, error->what);
  }

  const double write_start = seconds_now();
  OutputTransaction outputs;
  if (const Status ok = save_model(*model, atlas, arguments.output); !ok) {
    return report_error(ok.error());
  }
  if (!arguments.image.empty()) {
    PictureOptions picture;
    picture.v_points_down = model->v_points_down;
    picture.tile2x2 = arguments.image_tiles;
    const Status ok = save_atlas_picture(arguments.image, charts->charts, *packing, picture);
    if (!ok) return report_error(ok.error());
  }
  outcome.write = seconds_now() - write_start;

  const double total = seconds_now() - start;
  if (!arguments.json.empty()) {
    const Status ok =
        write_json(arguments.json, to_json(arguments, *charts, *packing, outcome, total));
    if (!ok) return report_error(ok.error());
  }
  if (const Status ok = outputs.commit(); !ok) return report_error(ok.error());
  if (!arguments.quiet) print_summary(arguments, *charts, *packing, total);
  return packing->interrupted ? 130 : 0;
}

}  // namespace

Command make_pack_command(CLI::App& parser) {
  auto arguments = std::make_shared<PackArguments>();
  PackArguments& a = *arguments;
  CLI::App& app = *parser.add_subcommand("pack", "Pack the charts of a model that has UVs");
  app.add_option("input", a.input, "Model with UVs: .obj .ply .off .gltf .glb")->required();
  app.add_option("-o,--output", a.output,
                 "Where to write it: .obj .ply .gltf .glb. The input's format keeps all else as "
                 "it is; another one gets faces and UVs")
      ->required();
  app.add_option("--method", a.method,
                 "modulo (Noell & Stricker 2011, the one that wraps), or an earlier packer: "
                 "lprm02, swg03, zsgs04")
      ->check(CLI::IsMember({"modulo", "swg03", "zsgs04", "lprm02"}))
      ->capture_default_str();
  app.add_option("--resolution", a.resolution, "Texels of the atlas: N or WxH")
      ->capture_default_str();
  app.add_option("--aspect", a.aspect,
                 "Shape of the atlas at the area of --resolution N: square, W:H, or search (the "
                 "best of 31 ratios from 1:8 to 8:1)");
  add_wrap_option(app, a.wrap,
                  "Axes on which charts may wrap around: uv (default of modulo), u, v, none");
  app.add_option("--export", a.export_mode,
                 "continuous: whole charts, UVs may exceed 1 where they wrap; cut: faces are "
                 "split at the border so that all UVs lie in [0,1]")
      ->check(CLI::IsMember({"continuous", "cut"}))
      ->capture_default_str();
  app.add_option("--padding", a.padding,
                 "Texels between charts, kept exactly. Default: max(2, resolution / 256)");
  app.add_option("--margin", a.margin,
                 "Texels to a side that does not wrap. Default: half the padding")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--block", a.options.block,
                 "No two charts share a block of N x N texels (4 for BCn compression)")
      ->capture_default_str();
  app.add_option("--stacked", a.stacked,
                 "Charts that lie on each other in the input: separate, or keep (they go on "
                 "sharing texels)")
      ->check(CLI::IsMember({"separate", "keep"}))
      ->capture_default_str();
  app.add_option("--texcoord", a.texcoord, "UV set of a glTF: K of TEXCOORD_K")
      ->check(CLI::Range(0, 15))
      ->capture_default_str();
  app.add_option("--rotations", a.options.rotations, "Angles each chart is tried at")
      ->capture_default_str();
  app.add_option("--rotation-base", a.rotation_base,
                 "Angles counted from the chart's input axes (the paper), or from its smallest box")
      ->check(CLI::IsMember({"input", "box"}))
      ->capture_default_str();
  app.add_option("--grid", a.options.grid,
                 "Cells along the longer side of the search grid; finer is slower and, as a rule, "
                 "denser. 0: 256, more for many charts")
      ->capture_default_str();
  app.add_option("--coverage", a.coverage,
                 "When a cell belongs to a chart: conservative (safe), or center (the paper's; "
                 "charts may overlap by part of a cell)")
      ->check(CLI::IsMember({"conservative", "center"}))
      ->capture_default_str();
  app.add_option("--scale-start", a.options.start_upper,
                 "Upper end of the scale search at its start; the paper prints 0.9")
      ->capture_default_str();
  app.add_option("--lambda", a.options.lambda, "Penalty of outer placements (modulo)")
      ->capture_default_str();
  app.add_flag("--no-inner", a.no_inner, "Leave out the four inner strategies (modulo)");
  app.add_flag("--all-sides", a.options.all_sides, "Try all four sides for every chart (zsgs04)");
  app.add_option("--seed", a.options.seed, "Reported; these methods draw no random numbers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--threads", a.options.threads,
                 "Threads; 0: all of the machine's. Never changes the result")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--json", a.json, "Write a report as JSON to a file, or - for standard output");
  app.add_option("--image", a.image, "Draw the atlas: .png or .svg");
  app.add_flag("--image-tiles", a.image_tiles, "Draw it 2 x 2, to show how it wraps");
  app.add_flag("--quiet", a.quiet, "No progress, no summary, no notes");
  app.add_flag("--verbose", a.verbose, "A longer summary");
  app.footer(
      "Examples:\n"
      "  wrapatlas pack model.glb -o packed.glb --resolution 2048 --image atlas.png\n"
      "  wrapatlas pack model.obj -o packed.obj --wrap none --padding 4\n"
      "  wrapatlas pack model.obj -o packed.obj --aspect search --json -");
  return {&app, [arguments] { return run(*arguments); }};
}

}  // namespace wrapatlas::cli
