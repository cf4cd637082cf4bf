// wrapatlas check: the independent exact judge of a finished atlas.

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "check_hints.h"
#include "common.h"
#include "options.h"
#include "output_paths.h"
#include "wrapatlas/model.h"
#include "wrapatlas/validate.h"

namespace wrapatlas::cli {
namespace {

struct CheckArguments {
  std::string input, reference, json;
  Resolution resolution;
  Stacked stacked = Stacked::separate;
  CheckOptions options;
  GivenPromise given;
  std::vector<std::string> hints, unchecked;
  int texcoord = 0;
  bool quiet = false, verbose = false;
};

Json to_json(const CheckArguments& arguments, const CheckReport& report, double seconds) {
  Json findings = Json::array();
  for (const Finding& finding : report.findings) {
    findings.push_back({{"kind", name_of(kViolations, finding.kind)},
                        {"amount", finding.amount},
                        {"text", finding.text}});
  }
  return {
      {"version", WRAPATLAS_VERSION},
      {"command", "check"},
      {"input", arguments.input},
      {"reference", arguments.reference},
      {"pages", report.pages},
      {"wrap", name_of(kWraps, arguments.options.wrap)},
      {"cut", name_of(kWraps, arguments.options.cut)},
      {"width", arguments.options.width},
      {"height", arguments.options.height},
      {"padding", arguments.options.padding},
      {"margin", arguments.options.margin},
      {"stacked", name_of(kStacked, arguments.stacked)},
      {"texcoord", arguments.texcoord},
      {"ok", report.ok()},
      {"violations", report.violations},
      {"charts", report.charts},
      {"faces", report.faces},
      {"faces_without_uv", report.faces_without_uv},
      {"smallest_gap", report.smallest_gap < report.gap_reach ? Json(report.smallest_gap) : Json()},
      {"gaps_sought_below", report.gap_reach},
      {"efficiency", report.efficiency},
      {"scale", report.scale},
      {"findings", findings},
      {"remarks", report.remarks},
      {"hints", arguments.hints},
      {"not_checked", arguments.unchecked},
      {"seconds", {{"total", seconds}}},
      {"peak_memory_mb", peak_memory_mb()},
      {"threads", arguments.options.threads}};
}

/// Defects of the input, a few of them unless all are asked for.
void print_notes(const CheckArguments& arguments, const CheckReport& report) {
  constexpr std::size_t kFew = 3;
  const std::size_t shown =
      arguments.verbose ? report.remarks.size() : std::min(kFew, report.remarks.size());
  for (std::size_t i = 0; i < shown; ++i) {
    say("{}: note: {}\n", arguments.input, report.remarks[i]);
  }
  if (shown < report.remarks.size()) {
    say("{}: note: and {} more like these (--verbose shows all)\n", arguments.input,
        report.remarks.size() - shown);
  }
}

void print_report(const CheckArguments& arguments, const CheckReport& report) {
  const std::string& name = arguments.input;
  const CheckOptions& options = arguments.options;
  print_notes(arguments, report);
  for (const Finding& finding : report.findings) say("{}: {}\n", name, finding.text);
  if (report.violations > report.findings.size()) {
    say("{}: and {} more\n", name, report.violations - report.findings.size());
  }
  for (const std::string& hint : arguments.hints) say("{}: hint: {}\n", name, hint);
  for (const std::string& what : arguments.unchecked) say("{}: not checked: {}\n", name, what);
  say("{}: {}: {}, {:.1f} % in use; {}{} x {} texels, wrap {}, padding {}, margin {}\n", name,
      report.ok() ? "ok" : quantity(report.violations, "violation"),
      quantity(report.charts, "chart"), 100 * report.efficiency,
      options.pages > 1 ? quantity(report.pages, "page") + " of " : "", options.width,
      options.height, name_of(kWraps, options.wrap), options.padding, options.margin);
}

/// glTF counts v from the top, the other formats from the bottom.
void turn_upside_down(Mesh& mesh) {
  for (Vec2& uv : mesh.texcoords) uv.y = 1 - uv.y;
}

Status resolve_options(const CLI::App& app, CheckArguments& arguments) {
  CheckOptions& options = arguments.options;
  options.width = arguments.resolution.width;
  options.height = arguments.resolution.height;
  options.stacked_ok = arguments.stacked == Stacked::keep;
  options.threads = threads_for(options.threads);
  const std::pair<const char*, double> distances[] = {{"--padding", options.padding},
                                                      {"--margin", options.margin}};
  for (const auto& [option, texels] : distances) {
    if (texels < std::min(options.width, options.height)) continue;
    return usage(
        fmt::format("{} {}", option, texels),
        fmt::format("no less than a side of {} x {} texels", options.width, options.height),
        "give less, or the --resolution of the atlas");
  }
  const auto free = [&](bool (*on)(Wrap)) { return on(options.wrap) || on(options.cut); };
  const Ignored ignored[] = {
      {"--margin", free(wraps_u) && free(wraps_v) && options.margin > 0,
       "both axes wrap or were cut, so there are no sides to keep away from",
       "leave it out, or give other --wrap or --cut"},
      {"--cut",
       (wraps_u(options.cut) && wraps_u(options.wrap)) ||
           (wraps_v(options.cut) && wraps_v(options.wrap)),
       "along an axis that wraps no margin is owed anyway", "name other axes, or leave it out"},
      {"--tolerance", arguments.reference.empty(), "there is no source to compare with",
       "add --ref MODEL"},
      {"--verbose", arguments.quiet, "it contradicts --quiet", "give one of them"},
  };
  if (const Status ok = refuse_ignored(app, ignored); !ok) return ok;
  arguments.given = {app.count("--wrap") > 0, app.count("--resolution") > 0,
                     app.count("--padding") > 0};
  const std::string inputs[] = {arguments.input, arguments.reference};
  return check_texcoord(arguments.texcoord, std::span(inputs, arguments.reference.empty() ? 1 : 2));
}

int run(const CLI::App& app, CheckArguments& arguments) {
  const double start = seconds_now();
  if (const Status ok = resolve_options(app, arguments); !ok) return report_error(ok.error());
  const CheckOptions& options = arguments.options;
  LoadOptions load_options;
  load_options.texcoord_set = arguments.texcoord;
  const auto atlas = load_model(arguments.input, load_options);
  if (!atlas) return report_error(atlas.error());
  const OutputPath report_path[] = {{"--json", arguments.json}};
  if (const Status ok = refuse_overwriting(arguments.input, *atlas, report_path); !ok) {
    return report_error(ok.error());
  }
  std::optional<Model> reference;
  if (!arguments.reference.empty()) {
    load_options.in_scene = leaves_nodes_behind(arguments.reference, arguments.input);
    auto loaded = load_model(arguments.reference, load_options);
    if (!loaded) return report_error(loaded.error());
    if (const Status ok = refuse_overwriting(arguments.reference, *loaded, report_path); !ok) {
      return report_error(ok.error());
    }
    reference = std::move(*loaded);
    if (reference->v_points_down != atlas->v_points_down) turn_upside_down(reference->mesh);
  }
  arguments.options.v_points_down = atlas->v_points_down;
  const Mesh* source = reference ? &reference->mesh : nullptr;
  const auto report = check_atlas(atlas->mesh, source, options);
  if (!report) {
    Error error = report.error();
    error.where = arguments.input + (error.where.empty() ? "" : ": " + error.where);
    return report_error(error);
  }
  if (report->charts == 0) {
    return report_error({ErrorKind::input, arguments.input, "no face has UVs, so there is no atlas",
                         "check a model that was packed"});
  }
  if (!arguments.quiet || !arguments.json.empty()) {
    arguments.hints = check_hints(atlas->mesh, source, options, *report, arguments.given);
  }
  arguments.unchecked = unchecked(source != nullptr, options, arguments.given);
  if (!arguments.json.empty()) {
    const Status ok =
        write_json(arguments.json, to_json(arguments, *report, seconds_now() - start));
    if (!ok) return report_error(ok.error());
  }
  if (!arguments.quiet) print_report(arguments, *report);
  return report->ok() ? 0 : 1;
}

}  // namespace

Command make_check_command(CLI::App& parser) {
  auto arguments = std::make_shared<CheckArguments>();
  CheckArguments& a = *arguments;
  CLI::App& app = *parser.add_subcommand(
      "check", "Check a finished atlas exactly: overlap, padding, bounds, and against its source");
  app.add_option("input", a.input, "The packed model")->required();
  app.add_option("--ref,--reference", a.reference,
                 "The model it was packed from: every face must be there, every chart be a copy "
                 "at one common scale, none mirrored");
  add_resolution(app, a.resolution);
  add_choice(app, "--wrap", a.options.wrap, kWraps, "Axes on which the atlas wraps");
  add_number(app, "--padding", a.options.padding, {0, double{kMostTexels}, "texels"},
             "Texels that must lie between charts");
  add_number(app, "--margin", a.options.margin, {0, double{kMostTexels}, "texels"},
             "Texels that must lie between charts and a side, where it neither wraps nor was cut");
  add_number(app, "--pages", a.options.pages, {1, double{kMostPages}, "pages"},
             "Pages the atlas may have: UV tiles, ten to a row (UDIM). A chart is on the one that "
             "its smallest u and v lie on, and is judged among those there");
  add_choice(app, "--cut", a.options.cut, kWraps,
             "Axes along which it was cut (--export cut): charts may reach these sides");
  add_number(app, "--tolerance", a.options.tolerance, {0, double{kMostTexels}, "texels"},
             "Texels by which a chart may differ from a similarity copy of its source");
  add_choice(app, "--stacked", a.stacked, kStacked,
             "keep: charts that overlap in the source may overlap here");
  add_texcoord(app, a.texcoord);
  add_number(app, "--findings", a.options.max_findings, {0, 1e9},
             "How many violations to describe");
  add_threads(app, a.options.threads);
  add_json(app, a.json);
  app.add_flag("--quiet", a.quiet, "Only the exit status");
  app.add_flag("--verbose", a.verbose, "All notes on defects of the input");
  app.footer(
      "Exit status: 0 every promise holds; 1 some do not; 2 usage; 3 unusable input.\n"
      "Example:\n"
      "  wrapatlas check packed.obj --ref model.obj --resolution 1024 --wrap uv --padding 2");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
