// wrapatlas info: what a model holds, and what packing it would work on.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "common.h"
#include "options.h"
#include "output_paths.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/model.h"

namespace wrapatlas::cli {
namespace {

struct InfoArguments {
  std::string input, json;
  int texcoord = 0;
};

/// The numbers of a chart set that packing depends on.
Json describe_charts(const ChartSet& set) {
  std::vector<double> areas;
  Box2 box;
  std::size_t triangles = 0;
  for (const Chart& chart : set.charts) {
    areas.push_back(chart.area);
    triangles += chart.triangles.size();
    if (!chart.box.empty()) {
      box.add(chart.box.min);
      box.add(chart.box.max);
    }
  }
  std::sort(areas.begin(), areas.end());
  return {{"count", set.charts.size()},
          {"triangles", triangles},
          {"area", set.total_area()},
          {"area_smallest", areas.front()},
          {"area_median", areas[areas.size() / 2]},
          {"area_largest", areas.back()},
          {"uv_min", {box.min.x, box.min.y}},
          {"uv_max", {box.max.x, box.max.y}},
          {"stacked", set.stacked},
          {"all_stacks_found", set.all_stacks_found},
          {"self_overlapping", set.self_overlapping},
          {"degenerate", set.degenerate},
          {"faces_without_uv", set.faces_without_uv}};
}

std::string to_text(const InfoArguments& arguments, const Model& model, const Json& charts) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}\n  {}, {}, {}\n", arguments.input,
                 quantity(model.mesh.face_count(), "face"),
                 quantity(model.mesh.positions.size(), "vertex", "vertices"),
                 quantity(model.mesh.texcoords.size(), "UV"));
  if (charts.is_null()) {
    fmt::format_to(out, "  no UVs, so there is nothing to pack\n");
  } else {
    fmt::format_to(out, "  {}, {}\n", quantity(charts["count"].get<std::size_t>(), "chart"),
                   quantity(charts["triangles"].get<std::size_t>(), "triangle"));
    fmt::format_to(out, "  UV range [{:.4g}, {:.4g}] x [{:.4g}, {:.4g}]\n",
                   charts["uv_min"][0].get<double>(), charts["uv_max"][0].get<double>(),
                   charts["uv_min"][1].get<double>(), charts["uv_max"][1].get<double>());
    fmt::format_to(out,
                   "  chart area: total {:.4g}, smallest {:.4g}, median {:.4g}, largest {:.4g}\n",
                   charts["area"].get<double>(), charts["area_smallest"].get<double>(),
                   charts["area_median"].get<double>(), charts["area_largest"].get<double>());
    fmt::format_to(out, "  charts that overlap others: {}{}, that overlap themselves: {}\n",
                   charts["stacked"].get<unsigned>(),
                   charts["all_stacks_found"].get<bool>() ? "" : " or more (search ended early)",
                   charts["self_overlapping"].get<unsigned>());
    fmt::format_to(out, "  charts without area: {}, faces without UVs: {}\n",
                   charts["degenerate"].get<unsigned>(),
                   charts["faces_without_uv"].get<unsigned>());
  }
  for (const std::string& remark : model.remarks)
    fmt::format_to(out, "  note: {}\n", printable(remark));
  return text;
}

int run(const InfoArguments& arguments) {
  if (const Status ok = check_texcoord(arguments.texcoord, std::span(&arguments.input, 1)); !ok) {
    return report_error(ok.error());
  }
  LoadOptions load_options;
  load_options.texcoord_set = arguments.texcoord;
  const auto model = load_model(arguments.input, load_options);
  if (!model) return report_error(model.error());
  const OutputPath report_path[] = {{"--json", arguments.json}};
  if (const Status ok = refuse_overwriting(arguments.input, *model, report_path); !ok) {
    return report_error(ok.error());
  }
  const auto set = build_charts(model->mesh);
  const Json charts = set ? describe_charts(*set) : Json();
  if (arguments.json.empty()) {
    const Status printed = print_text(to_text(arguments, *model, charts));
    return printed ? 0 : report_error(printed.error());
  }
  const Json object = {{"version", WRAPATLAS_VERSION},
                       {"command", "info"},
                       {"input", arguments.input},
                       {"faces", model->mesh.face_count()},
                       {"vertices", model->mesh.positions.size()},
                       {"uvs", model->mesh.texcoords.size()},
                       {"charts", charts},
                       {"remarks", model->remarks}};
  const Status ok = write_json(arguments.json, object);
  return ok ? 0 : report_error(ok.error());
}

}  // namespace

Command make_info_command(CLI::App& parser) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App& app = *parser.add_subcommand("info", "Say what a model holds");
  app.add_option("input", arguments->input, "Model: .obj .ply .off .stl .gltf .glb")->required();
  add_texcoord(app, arguments->texcoord);
  add_json(app, arguments->json);
  app.footer("Exit status: 0 done; 2 usage; 3 unusable input or output.");
  return {&app, [arguments] { return run(*arguments); }};
}

}  // namespace wrapatlas::cli
