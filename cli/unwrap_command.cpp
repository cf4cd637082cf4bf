// wrapatlas unwrap: read a model, cut it into charts, flatten them, and go on as `pack` does.

#include "wrapatlas/unwrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/file.h"
#include "packing_run.h"
#include "unwrap_report.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/view.h"

namespace wrapatlas::cli {
namespace {

enum class Stage { charts, flat, packed };
inline constexpr Named<Stage> kStages[] = {
    {"charts", Stage::charts}, {"flat", Stage::flat}, {"packed", Stage::packed}};

struct UnwrapArguments {
  PackArguments pack;
  UnwrapOptions options;
  std::optional<double> hard_edges;  ///< degrees
  std::optional<double> max_extent;
  bool split_materials = false;
  Stage last = Stage::packed;
  std::string view, heat;  ///< pictures
};

Result<Unwrapping> unwrap_with_progress(UnwrapArguments& arguments, const Mesh& mesh) {
  catch_interrupts();
  ProgressLine line(!arguments.pack.quiet);
  arguments.options.progress = [&line](const UnwrapProgress& progress) {
    line.show(fmt::format("unwrapping {:3.0f} %, {} so far", 100 * progress.fraction,
                          quantity(progress.charts, "chart")));
    return !interrupted();
  };
  auto unwrapping = unwrap(mesh, arguments.options);
  if (!unwrapping) {
    Error error = inside_input(arguments.pack, unwrapping.error());
    if (error.kind == ErrorKind::interrupted) error.remedy = "nothing was written";
    return error;
  }
  return unwrapping;
}

/// `mesh` has the UVs that the charts have.
Status save_view(const UnwrapArguments& arguments, const Mesh& mesh,
                 std::span<const std::uint32_t> face_chart) {
  if (arguments.view.empty()) return Done{};
  ViewOptions options;
  const std::vector<SeamEdge> seams = seam_edges(mesh, face_chart);
  options.seams = seams;
  return save_png(arguments.view, draw_mesh(mesh, colors_of_charts(face_chart), options));
}

/// Writes the charts unpacked: flat, one beside the other, the longer side of the whole being 1; or
/// not even that, each as an object of its own.
int write_unpacked(const UnwrapArguments& arguments, Model& model, Unwrapping& unwrapping,
                   double start, PackOutcome& outcome) {
  OutputTransaction outputs;
  Mesh& mesh = unwrapping.mesh;
  if (const Status ok = save_view(arguments, mesh, unwrapping.face_chart); !ok) {
    return report_error(ok.error());
  }
  if (arguments.last == Stage::charts) {
    model.source.reset();  // a new file: the old one's objects are others
    model.mesh.face_object = unwrapping.face_chart;
    mesh.texcoords.clear();
    mesh.corner_texcoord.assign(mesh.corner_count(), kNone);
  }
  Box2 box;
  for (const Vec2 uv : mesh.texcoords) box.add(uv);
  const double side = std::max(box.size().x, box.size().y);
  for (Vec2& uv : mesh.texcoords) uv = (side > 0 ? 1 / side : 1) * (uv - box.min);
  const PackArguments& pack = arguments.pack;
  const double write_start = seconds_now();
  if (const Status ok = save_model(model, keep_texcoords(mesh), pack.output); !ok) {
    return report_error(ok.error());
  }
  outcome.write = seconds_now() - write_start;
  if (!pack.json.empty()) {
    Json report = {{"version", WRAPATLAS_VERSION},
                   {"command", outcome.command},
                   {"input", pack.input},
                   {"output", pack.output},
                   {"charts", unwrapping.charts.size()}};
    report["seconds"] = {
        {"total", seconds_now() - start}, {"read", outcome.read}, {"write", outcome.write}};
    for (const auto& [stage, seconds] : outcome.stages) report["seconds"][stage] = seconds;
    report["peak_memory_mb"] = peak_memory_mb();
    report.update(outcome.more);
    if (const Status ok = write_json(pack.json, report); !ok) return report_error(ok.error());
  }
  if (const Status ok = outputs.commit(); !ok) return report_error(ok.error());
  if (!pack.quiet) say("{}: {:.2f} s -> {}\n", pack.input, seconds_now() - start, pack.output);
  return 0;
}

/// Stretch of half to four times, each doubling the same step of colour.
Status save_heat(const UnwrapArguments& arguments, const Unwrapping& unwrapping, const Mesh& mesh,
                 const AtlasMesh& atlas, const Packing& packing, bool v_points_down) {
  if (arguments.heat.empty()) return Done{};
  std::vector<double> doublings;
  for (const std::uint32_t face : atlas.face_source) {
    doublings.push_back(std::log2(unwrapping.face_stretch[face]));
  }
  const int size = arguments.pack.picture.size;
  return save_png(arguments.heat,
                  draw_faces_on_atlas(apply_atlas(mesh, atlas), colors_of_values(doublings, -1, 2),
                                      packing.width, packing.height, size, v_points_down));
}

/// Refuses what would be ignored, or cannot be done.
Status check_options(const CLI::App& app, UnwrapArguments& arguments) {
  const bool unpacked = arguments.last != Stage::packed;
  arguments.pack.draws_atlas = !arguments.heat.empty();
  const std::string why = "nothing is packed", remedy = "leave it out, or --stop-after";
  std::vector<Ignored> ignored = packing_options(app, unpacked, why, remedy);
  for (const char* option : {"--heat", "--image", "--verbose"}) {
    ignored.push_back({option, unpacked, why, remedy});
  }
  ignored.push_back({"--heat",
                     arguments.pack.pages.value_or(1) != 1 || arguments.pack.density.has_value(),
                     "it shows one page", "leave it out, or --pages and --density"});
  if (const Status ok = refuse_ignored(app, ignored); !ok) return ok;
  for (const auto& [option, path] :
       {OutputPath{"--view", arguments.view}, {"--heat", arguments.heat}}) {
    if (path.empty()) continue;
    if (const Status ok = check_picture_path(path); !ok) return ok;
    if (!path.ends_with(".png")) return usage(path, "this picture is of pixels", "write .png");
    arguments.pack.more_outputs.push_back({option, path});
  }
  return Done{};
}

int run(const CLI::App& app, UnwrapArguments& arguments) {
  const double start = seconds_now();
  PackArguments& pack = arguments.pack;
  if (const Status ok = check_options(app, arguments); !ok) return report_error(ok.error());
  if (const Status ok = resolve_pack_options(app, pack); !ok) return report_error(ok.error());
  if (const Status ok = check_outputs(pack); !ok) return report_error(ok.error());
  if (arguments.hard_edges) {
    arguments.options.surface.hard_angle = *arguments.hard_edges * std::numbers::pi / 180;
  }
  arguments.options.max_extent = arguments.max_extent.value_or(default_extent(pack.options.wrap));
  arguments.options.threads = pack.options.threads;
  LoadOptions load_options;
  load_options.texcoord_set = pack.texcoord;
  load_options.may_add_set = true;
  load_options.in_scene =
      arguments.last == Stage::charts || leaves_nodes_behind(pack.input, pack.output);
  auto model = load_model(pack.input, load_options);
  if (!model) return report_error(model.error());
  if (const Status ok = keep_input(pack, *model); !ok) return report_error(ok.error());
  if (arguments.split_materials) arguments.options.surface.face_labels = model->face_material;
  PackOutcome outcome;
  outcome.command = "unwrap";
  outcome.read = seconds_now() - start;

  auto unwrapping = unwrap_with_progress(arguments, model->mesh);
  if (!unwrapping) return report_error(unwrapping.error());
  if (model->v_points_down) {
    for (Vec2& uv : unwrapping->mesh.texcoords) uv.y = -uv.y;
  }
  if (!pack.quiet) {
    if (arguments.options.surface.uv_seams && model->mesh.texcoords.empty()) {
      say("{}: note: --keep-seams keeps none: the model has no UVs\n", pack.input);
    }
    if (arguments.split_materials && model->face_material.empty()) {
      say("{}: note: --split-materials cuts nowhere: the model has one material\n", pack.input);
    }
    print_unwrap_notes(pack.input, arguments.options, *unwrapping);
    const Worst worst = worst_of(*unwrapping);
    say("{}: {} in {}, L2 stretch {:.2f} at most, L-infinity {:.1f}, {:.2f} s\n", pack.input,
        quantity(unwrapping->face_chart.size(), "face"),
        quantity(unwrapping->charts.size(), "chart"), worst.l2, worst.linf,
        unwrapping->surface_seconds + unwrapping->segment_seconds);
  }
  outcome.more = unwrap_json(arguments.options, *unwrapping);
  outcome.stages = {{"repair", unwrapping->surface_seconds},
                    {"segment", unwrapping->segment_seconds},
                    {"flatten", unwrapping->flatten_seconds}};
  if (arguments.last != Stage::packed) {
    return write_unpacked(arguments, *model, *unwrapping, start, outcome);
  }
  outcome.write_more = [&](const Mesh& mesh, const AtlasMesh& atlas, const ChartSet& charts,
                           const Packing& packing) -> Status {
    if (const Status ok = save_view(arguments, mesh, charts.face_chart); !ok) return ok;
    return save_heat(arguments, *unwrapping, mesh, atlas, packing, model->v_points_down);
  };
  return pack_mesh(pack, *model, unwrapping->mesh, start, outcome);
}

}  // namespace

Command make_unwrap_command(CLI::App& parser) {
  auto arguments = std::make_shared<UnwrapArguments>();
  CLI::App& app = *parser.add_subcommand("unwrap", "Cut a mesh into charts, flatten and pack them");
  UnwrapOptions& options = arguments->options;
  add_number(app, "--max-stretch", options.max_stretch, {1, 1000},
             "No chart is stretched more, by the measure of --stretch; 1: not at all");
  add_choice(app, "--stretch", options.stretch, kStretches,
             "l2: the root mean square over a chart (Sander et al. 2001), 1 for an isometry; linf: "
             "the largest at any place of it");
  add_number(
      app, "--max-charts", options.max_charts, {0, 1e9, "charts"},
      "Join charts beyond --max-stretch until there are no more than this; parts of the "
      "surface that do not touch stay apart, and unions of over 60,000 triangles or that overlap "
      "themselves are not made. 0: no limit");
  add_number(app, "--max-extent", arguments->max_extent, {0, 1000},
             "Cut charts that do not fit into a square of so many times the side of one that has "
             "the area of the whole surface; 0: no limit. Default: 1.5; with --wrap none 0.8, as a "
             "page that does not wrap holds long charts badly");
  add_choice(
      app, "--flatten", options.flatten.method, kFlattenMethods,
      "labf: linear angle based flattening (Zayer et al. 2007); lscm: least squares conformal "
      "maps");
  add_number(app, "--iterations", options.flatten.iterations, {1, kMostIterations},
             "labf: linear solves, each from the angles of the one before; the paper has 1");
  add_number(app, "--hard-edges", arguments->hard_edges, {0, 180, "degrees"},
             "Cut along edges whose faces differ by more than this");
  app.add_flag("--keep-seams", options.surface.uv_seams,
               "Cut wherever the UVs that the model has are cut");
  app.add_flag("--split-materials", arguments->split_materials,
               "Cut between faces of different materials (OBJ, glTF)");
  app.add_option(
         "--view", arguments->view,
         "Draw the model from in front above and behind below, charts in the colours of --image")
      ->type_name("FILE.png");
  app.add_option(
         "--heat", arguments->heat,
         "Draw the atlas by stretch: dark blue is half (the chart is larger than the surface), "
         "green-blue 1, green 2, yellow four times")
      ->type_name("FILE.png");
  add_choice(app, "--stop-after", arguments->last, kStages,
             "charts: write each chart as an object of its own, without UVs; flat: with UVs, but "
             "not packed; packed: all of it");
  add_pack_options(app, arguments->pack, "Model: .obj .ply .off .stl .gltf .glb");
  app.footer(std::string(kPackExitStatus) +
             "Examples:\n"
             "  wrapatlas unwrap bare.off -o unwrapped.obj --image atlas.png\n"
             "  wrapatlas unwrap scan.ply -o scan.glb --resolution 4096 --max-stretch 1.5");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
