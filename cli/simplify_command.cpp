// wrapatlas simplify: the same shape in fewer triangles.

#include "wrapatlas/simplify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common.h"
#include "io/file.h"
#include "options.h"
#include "output_paths.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/model.h"

namespace wrapatlas::cli {
namespace {

/// Triangles, or a share of those that there are.
struct FaceTarget {
  std::uint32_t faces = 0;
  std::optional<double> percent;

  [[nodiscard]] std::uint32_t of(std::size_t triangles) const {
    if (!percent) return faces;
    const double share = std::round(*percent / 100 * static_cast<double>(triangles));
    return static_cast<std::uint32_t>(std::max(1.0, share));
  }
};

struct SimplifyArguments {
  std::string input, output, json;
  FaceTarget target;
  SimplifyOptions options;
  bool quiet = false;
};

FaceTarget parse_target(const std::string& text) {
  FaceTarget target;
  if (text.ends_with('%')) {
    target.percent =
        parse_number("--faces", text.substr(0, text.size() - 1), {1e-6, 100, "%"}, false);
  } else {
    target.faces =
        static_cast<std::uint32_t>(parse_number("--faces", text, {1, 4e9, "triangles"}, true));
  }
  return target;
}

Status check_outputs(const SimplifyArguments& arguments) {
  const std::string remedy = "write .obj, .ply, .gltf or .glb";
  const auto format = format_from_path(arguments.output);
  if (!format) return Error{format.error().kind, arguments.output, format.error().what, remedy};
  if (*format == FileFormat::off || *format == FileFormat::stl) {
    return usage(arguments.output, "OFF and STL files are read, but not written", remedy);
  }
  const OutputPath outputs[] = {{"-o", arguments.output}, {"--json", arguments.json}};
  if (const Status ok = refuse_equal_outputs(outputs); !ok) return ok;
  for (const OutputPath& output : outputs) {
    if (output.path.empty() || output.path == "-") continue;
    if (const Status ok = check_writable(output.path); !ok) return ok;
  }
  return Done{};
}

Result<Simplification> simplify_with_progress(SimplifyArguments& arguments, const Mesh& mesh) {
  catch_interrupts();
  ProgressLine line(!arguments.quiet);
  arguments.options.progress = [&line](const SimplifyProgress& progress) {
    line.show(fmt::format("simplifying {:3.0f} %, {} left", 100 * progress.fraction,
                          quantity(progress.faces, "triangle")));
    return !interrupted();
  };
  auto result = simplify(mesh, arguments.options);
  if (result) return result;
  Error error = result.error();
  error.where = arguments.input + (error.where.empty() ? "" : ": " + error.where);
  if (error.kind == ErrorKind::interrupted) error.remedy = "nothing was written";
  return error;
}

bool is_unchanged(const SimplifyArguments& arguments, const SimplifyReport& report) {
  return report.faces_before <= arguments.options.target_faces;
}

/// Notes on what is not as one may expect; `model` as it was read.
void print_notes(const SimplifyArguments& arguments, const Model& model,
                 const SimplifyReport& report) {
  const auto note = [&](const std::string& text) { say("{}: note: {}\n", arguments.input, text); };
  if (is_unchanged(arguments, report)) {
    note(fmt::format("it has {}, no more than --faces asks for: written as it is",
                     quantity(report.faces_before, "triangle")));
    return;
  }
  const bool has_uvs = !model.mesh.texcoords.empty();
  if (arguments.options.keep_uv_seams && !has_uvs) {
    note("--keep-seams keeps none: the model has no UVs");
  }
  if (has_uvs && !arguments.options.keep_uv_seams) {
    note("its UVs are not kept; --keep-seams does so");
  }
  if (!model.face_material.empty()) note("its materials, textures and normals are not kept");
  if (report.dropped_faces > 0) {
    note(quantity(report.dropped_faces, "triangle") + " using a point twice: left out");
  }
  if (report.surface.turned_faces > 0) {
    note(quantity(report.surface.turned_faces, "face") +
         " wound against the rest of the surface: turned");
  }
  if (report.fixed_vertices > 0) {
    note(fmt::format("{} not moved: parts of the surface touch there{}",
                     quantity(report.fixed_vertices, "vertex", "vertices"),
                     arguments.options.keep_uv_seams ? ", or seams meet or end" : ""));
  }
  if (report.faces_after > arguments.options.target_faces) {
    const bool seams = arguments.options.keep_uv_seams && has_uvs;
    note(
        fmt::format("{} remain, more than the {} of --faces: each collapse left would change the "
                    "topology{} turn a triangle over; {}",
                    quantity(report.faces_after, "triangle"), arguments.options.target_faces,
                    seams ? ", part a seam or" : " or",
                    seams ? "without --keep-seams more can go"
                          : "small pieces that are not needed had better go before"));
  }
}

Json report_json(const SimplifyArguments& arguments, const SimplifyReport& report, bool has_uvs) {
  const SurfaceReport& surface = report.surface;
  return {{"version", WRAPATLAS_VERSION},
          {"command", "simplify"},
          {"input", arguments.input},
          {"output", arguments.output},
          {"target", arguments.options.target_faces},
          {"faces_before", report.faces_before},
          {"faces", report.faces_after},
          {"refused", report.refused},
          {"uvs", has_uvs},
          {"volume_before", report.volume_before},
          {"volume", report.volume_after},
          {"components", surface.components},
          {"border_edges", surface.border_edges},
          {"fixed_vertices", report.fixed_vertices},
          {"dropped_faces", report.dropped_faces},
          {"turned_faces", surface.turned_faces}};
}

std::string summary(const SimplifyReport& report, bool has_uvs) {
  std::string text =
      fmt::format("{} of {}", report.faces_after, quantity(report.faces_before, "triangle"));
  if (report.surface.border_edges == 0 && report.volume_before != 0) {
    text +=
        fmt::format(", volume {:+.2g} %", 100 * (report.volume_after / report.volume_before - 1));
  }
  return text + (has_uvs ? "" : ", no UVs");
}

int run(SimplifyArguments& arguments) {
  const double start = seconds_now();
  if (const Status ok = check_outputs(arguments); !ok) return report_error(ok.error());
  LoadOptions load_options;
  load_options.in_scene = true;
  load_options.may_add_set = true;  // it need not have any
  auto model = load_model(arguments.input, load_options);
  if (!model) return report_error(model.error());
  const OutputPath report_path[] = {{"--json", arguments.json}};
  if (const Status ok = refuse_overwriting(arguments.input, *model, report_path); !ok) {
    return report_error(ok.error());
  }
  const double simplify_start = seconds_now();
  arguments.options.target_faces =
      arguments.target.of(model->mesh.corner_count() - 2 * model->mesh.face_count());
  auto made = simplify_with_progress(arguments, model->mesh);
  if (!made) return report_error(made.error());
  const SimplifyReport& report = made->report;
  const double write_start = seconds_now();

  OutputTransaction outputs;
  if (!arguments.quiet) print_notes(arguments, *model, report);
  if (!is_unchanged(arguments, report)) {
    model->source.reset();  // a new file: nothing in the old one belongs to these faces
    model->mesh = std::move(made->mesh);
  } else if (!leaves_nodes_behind(arguments.input, arguments.output)) {
    load_options.in_scene = false;  // nodes stay, and meshes as they are below them
    model = load_model(arguments.input, load_options);
    if (!model) return report_error(model.error());
  }
  const bool has_uvs = !model->mesh.texcoords.empty();
  if (const Status ok = save_model(*model, keep_texcoords(model->mesh), arguments.output); !ok) {
    return report_error(ok.error());
  }
  const double end = seconds_now();
  if (!arguments.json.empty()) {
    Json object = report_json(arguments, report, has_uvs);
    object["seconds"] = {{"total", end - start},
                         {"read", simplify_start - start},
                         {"simplify", write_start - simplify_start},
                         {"write", end - write_start}};
    object["peak_memory_mb"] = peak_memory_mb();
    if (const Status ok = write_json(arguments.json, object); !ok) return report_error(ok.error());
  }
  if (const Status ok = outputs.commit(); !ok) return report_error(ok.error());
  if (!arguments.quiet) {
    say("{}: {}, {:.2f} s -> {}\n", arguments.input, summary(report, has_uvs), end - start,
        arguments.output);
  }
  return 0;
}

}  // namespace

Command make_simplify_command(CLI::App& parser) {
  auto arguments = std::make_shared<SimplifyArguments>();
  CLI::App& app = *parser.add_subcommand("simplify", "Make a mesh of fewer triangles");
  app.add_option("input", arguments->input, "Model: .obj .ply .off .stl .gltf .glb")->required();
  app.add_option("-o,--output", arguments->output, "Written: .obj .ply .gltf .glb")
      ->required()
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--faces",
         [arguments](const std::string& text) { arguments->target = parse_target(text); },
         "Triangles to end with, or a share of those that there are, as 1%")
      ->required()
      ->type_name("N|P%");
  app.add_flag("--keep-seams", arguments->options.keep_uv_seams,
               "Keep the UVs; points on their seams move along these alone");
  add_json(app, arguments->json);
  app.add_flag("--quiet", arguments->quiet, "No progress, no notes, no summary");
  app.footer(
      "Exit status: 0 written; 2 usage; 3 unusable input or output; 130 interrupted.\n"
      "Examples:\n"
      "  wrapatlas simplify scan.ply -o low.obj --faces 1%\n"
      "  wrapatlas simplify prop.glb -o low.glb --faces 5000 --keep-seams");
  return {&app, [arguments] { return run(*arguments); }};
}

}  // namespace wrapatlas::cli
