// From charts to files: what `pack` and `unwrap` have in common.
#include "packing_run.h"

#include <fmt/format.h>

#include <optional>

#include "io/file.h"
#include "output_paths.h"
#include "wrapatlas/atlas.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::cli {
namespace {

std::optional<Error> check_result(const PackArguments& arguments, const Model& model,
                                  const Mesh& mesh, const AtlasMesh& atlas, const Packing& packing,
                                  PackOutcome& outcome) {
  const double start = seconds_now();
  const bool cut = arguments.export_mode == Export::cut;
  CheckOptions options = promises_of(arguments.options, packing, cut);
  options.stacked_ok = arguments.stacked == Stacked::keep;
  options.v_points_down = model.v_points_down;
  const auto report = check_atlas(apply_atlas(mesh, atlas), &mesh, options);
  outcome.validate = seconds_now() - start;
  if (!report) return inside_input(arguments, report.error());
  outcome.valid = report->ok();
  if (report->ok()) return std::nullopt;
  return broken_promise(arguments.input, *report);
}

/// --density is in texels per unit of surface, and so are errors about it.
Status resolve_density(PackArguments& arguments, double uv_density) {
  if (!arguments.density) return Done{};
  if (uv_density == 0) {
    return Error{ErrorKind::input, arguments.input,
                 "its faces have no area in UV or in space, so there is no texel density",
                 "unwrap the mesh again, or leave out --density"};
  }
  arguments.options.density = *arguments.density / uv_density;
  return Done{};
}

Error as_command(Error error, double uv_density) {
  if (error.kind == ErrorKind::interrupted) error.remedy = "nothing was written";
  return in_units_of_surface(std::move(error), uv_density, "--density ");
}

/// Packs with a line of progress; Ctrl-C ends it with the best so far.
Result<Packing> pack_with_progress(PackArguments& arguments, const ChartSet& charts,
                                   double uv_density) {
  catch_interrupts();
  ProgressLine line(!arguments.quiet);
  arguments.options.progress = [&line](const Progress& progress) {
    line.show(progress);
    return !interrupted();
  };
  auto packing = pack(charts.charts, arguments.options);
  if (!packing) return as_command(inside_input(arguments, packing.error()), uv_density);
  return packing;
}

/// Model, picture and report: all of them, or none.
Status write_outputs(const PackArguments& arguments, const Model& model, const Mesh& mesh,
                     const ChartSet& charts, const AtlasMesh& atlas, const Packing& packing,
                     double run_start, PackOutcome& outcome) {
  const double start = seconds_now();
  OutputTransaction outputs;
  if (Status ok = save_model(model, atlas, arguments.output); !ok) return ok;
  if (!arguments.image.empty()) {
    PictureOptions picture = arguments.picture;
    picture.v_points_down = model.v_points_down;
    if (Status ok = save_atlas_picture(arguments.image, charts.charts, packing, picture); !ok) {
      return ok;
    }
  }
  if (outcome.write_more) {
    if (Status ok = outcome.write_more(mesh, atlas, charts, packing); !ok) return ok;
  }
  outcome.write = seconds_now() - start;
  outcome.total = seconds_now() - run_start;
  if (!arguments.json.empty()) {
    if (Status ok = write_json(arguments.json, pack_json(arguments, charts, packing, outcome));
        !ok) {
      return ok;
    }
  }
  return outputs.commit();
}

}  // namespace

Error broken_promise(const std::string& input, const CheckReport& report) {
  const std::string first = report.findings.empty() ? "" : ": " + report.findings.front().text;
  return {
      ErrorKind::check, input,
      fmt::format("the finished atlas breaks {}{}", quantity(report.violations, "promise"), first),
      "nothing was written; please report this as a bug"};
}

Error inside_input(const PackArguments& arguments, Error error) {
  error.where = arguments.input + (error.where.empty() ? "" : ": " + error.where);
  return error;
}

Status check_outputs(const PackArguments& arguments) {
  const auto format = format_from_path(arguments.output);
  const std::string remedy = "write .obj, .ply, .gltf or .glb";
  if (!format) return Error{format.error().kind, arguments.output, format.error().what, remedy};
  if (*format == FileFormat::off || *format == FileFormat::stl) {
    return usage(arguments.output, "OFF and STL files cannot hold UVs", remedy);
  }
  if (!arguments.image.empty()) {
    if (const Status ok = check_picture_path(arguments.image); !ok) return ok;
  }
  std::vector<OutputPath> outputs = arguments.more_outputs;
  outputs.push_back({"-o", arguments.output});
  outputs.push_back({"--image", arguments.image});
  outputs.push_back({"--json", arguments.json});
  if (const Status ok = refuse_equal_outputs(outputs); !ok) return ok;
  for (const OutputPath& output : outputs) {
    if (output.path.empty() || output.path == "-") continue;
    if (const Status ok = check_writable(output.path); !ok) return ok;
  }
  return Done{};
}

Status keep_input(const PackArguments& arguments, const Model& model) {
  std::vector<OutputPath> outputs = arguments.more_outputs;
  outputs.push_back({"--image", arguments.image});
  outputs.push_back({"--json", arguments.json});
  return refuse_overwriting(arguments.input, model, outputs);
}

int pack_mesh(PackArguments& arguments, const Model& model, const Mesh& mesh, double start,
              PackOutcome& outcome) {
  const double charts_start = seconds_now();
  const auto charts = build_charts(mesh, arguments.stacked);
  if (!charts) return report_error(inside_input(arguments, charts.error()));
  outcome.charts = seconds_now() - charts_start;
  print_pack_notes(arguments, model, *charts);

  outcome.uv_density = uv_density(mesh);
  if (const Status ok = resolve_density(arguments, outcome.uv_density); !ok) {
    return report_error(ok.error());
  }
  const double pack_start = seconds_now();
  const auto packing = pack_with_progress(arguments, *charts, outcome.uv_density);
  if (!packing) return report_error(packing.error());
  outcome.page_efficiency = page_efficiencies(*charts, *packing);
  outcome.pack = seconds_now() - pack_start;

  AtlasMesh atlas = arguments.export_mode == Export::cut
                        ? export_cut(mesh, *charts, *packing, model.v_points_down)
                        : export_continuous(mesh, *charts, *packing, model.v_points_down);
  round_texcoords_to_float(atlas);
  if (const auto error = check_result(arguments, model, mesh, atlas, *packing, outcome)) {
    // The paper's coverage is known to be unsafe; who asks for it gets it, with a warning.
    if (error->kind != ErrorKind::check || arguments.options.coverage != Coverage::center) {
      return report_error(*error);
    }
    say("{}: warning: {} (--coverage center is not safe)\n", arguments.input, error->what);
  }
  if (const Status ok =
          write_outputs(arguments, model, mesh, *charts, atlas, *packing, start, outcome);
      !ok) {
    return report_error(ok.error());
  }
  if (!arguments.quiet) print_pack_summary(arguments, *charts, *packing, outcome);
  return packing->interrupted ? 130 : 0;
}

}  // namespace wrapatlas::cli
