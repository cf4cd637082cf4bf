#include "pack_report.h"

#include <fmt/format.h>

#include <filesystem>

namespace wrapatlas::cli {
namespace {

/// An OBJ in another folder does not find the material files that it names.
void note_material_files(const PackArguments& arguments, const Model& model) {
  const std::filesystem::path input = arguments.input, output = arguments.output;
  const auto format = format_from_path(output);
  if (!format || *format != FileFormat::obj) return;
  for (const std::string& name : model.material_files) {
    std::error_code none;
    const auto from = input.parent_path() / name, to = output.parent_path() / name;
    if (!std::filesystem::exists(from, none) || std::filesystem::exists(to, none)) continue;
    say("{}: note: {}\n", arguments.input,
        printable(fmt::format("{} will look for its materials in {}: copy {} there",
                              output.string(), to.string(), from.string())));
  }
}

}  // namespace

std::vector<double> page_efficiencies(const ChartSet& charts, const Packing& packing) {
  std::vector<double> efficiency(static_cast<std::size_t>(packing.pages), 0);
  const double unit = packing.scale * packing.scale / (double{1} * packing.width * packing.height);
  for (std::size_t i = 0; i < packing.placements.size(); ++i) {
    efficiency[static_cast<std::size_t>(packing.placements[i].page)] +=
        unit * charts.charts[i].area;
  }
  return efficiency;
}

Json pack_json(const PackArguments& arguments, const ChartSet& charts, const Packing& packing,
               const PackOutcome& outcome) {
  const PackOptions& options = arguments.options;
  Json report = {
      {"version", WRAPATLAS_VERSION},
      {"command", outcome.command},
      {"input", arguments.input},
      {"output", arguments.output},
      {"method", name_of(kMethods, options.method)},
      {"wrap", name_of(kWraps, packing.wrap)},
      {"export", name_of(kExports, arguments.export_mode)},
      {"width", packing.width},
      {"height", packing.height},
      {"pages", packing.pages},
      {"udim", arguments.udim},
      {"charts", charts.charts.size()},
      {"placed", packing.placements.size()},
      {"stacked", charts.stacked},
      {"stacked_mode", name_of(kStacked, arguments.stacked)},
      {"all_stacks_found", charts.all_stacks_found},
      {"self_overlapping", charts.self_overlapping},
      {"faces_without_uv", charts.faces_without_uv},
      {"texcoord", arguments.texcoord},
      {"aspect", arguments.aspect.empty() ? Json() : Json(arguments.aspect)},
      {"padding", options.padding},
      {"margin", packing.wrap == Wrap::uv ? Json() : Json(arguments.margin_in_force())},
      {"block", options.block},
      {"coverage", name_of(kCoverages, options.coverage)},
      {"grid", {packing.grid_width, packing.grid_height}},
      {"rotations", options.rotations},
      {"scale", packing.scale},
      {"density", outcome.uv_density > 0 ? Json(packing.scale * outcome.uv_density) : Json()},
      {"efficiency", packing.efficiency},
      {"page_efficiency", outcome.page_efficiency},
      {"raster_efficiency", packing.raster_efficiency},
      {"unpadded_efficiency", unpadded_efficiency(charts.charts, packing)},
      {"packings", packing.packings},
      {"valid", outcome.valid},
      {"interrupted", packing.interrupted},
      {"seconds",
       {{"total", outcome.total},
        {"read", outcome.read},
        {"charts", outcome.charts},
        {"pack", outcome.pack},
        {"raster", packing.raster_seconds},
        {"place", packing.place_seconds},
        {"validate", outcome.validate},
        {"write", outcome.write}}},
      {"peak_memory_mb", peak_memory_mb()},
      {"seed", options.seed},
      {"threads", options.threads}};
  for (const auto& [stage, seconds] : outcome.stages) report["seconds"][stage] = seconds;
  report.update(outcome.more);
  return report;
}

void print_pack_summary(const PackArguments& arguments, const ChartSet& charts,
                        const Packing& packing, const PackOutcome& outcome) {
  const std::string pages =
      packing.pages > 1 ? fmt::format("{} pages of ", packing.pages) : std::string();
  const std::string density =
      outcome.uv_density > 0
          ? fmt::format(", {:.4g} texels per unit", packing.scale * outcome.uv_density)
          : std::string();
  say("{}: {} on {}{} x {} texels, {:.1f} % in use{}, {:.2f} s{} -> {}\n", arguments.input,
      quantity(charts.charts.size(), "chart"), pages, packing.width, packing.height,
      100 * packing.efficiency, density, outcome.total,
      packing.interrupted ? " (interrupted: the best so far)" : "", arguments.output);
  if (!arguments.verbose) return;
  const PackOptions& options = arguments.options;
  say("  method {}, wrap {}, padding {} texels, {}, grid {} x {}\n",
      name_of(kMethods, options.method), name_of(kWraps, packing.wrap), options.padding,
      quantity(static_cast<std::size_t>(options.rotations), "rotation"), packing.grid_width,
      packing.grid_height);
  say("  {}, scale {:.6g} texels per UV unit, raster {:.3f} s, place {:.3f} s\n",
      quantity(static_cast<std::size_t>(packing.packings), "packing"), packing.scale,
      packing.raster_seconds, packing.place_seconds);
  say("  {:.1f} % in use if the charts grew in place until two touch\n",
      100 * unpadded_efficiency(charts.charts, packing));
  for (std::size_t page = 0; packing.pages > 1 && page < outcome.page_efficiency.size(); ++page) {
    const PageTile tile = page_tile(static_cast<int>(page));
    say("  page {} (tile {}): {:.1f} % in use\n", page,
        1001 + tile.column + kPageColumns * tile.row, 100 * outcome.page_efficiency[page]);
  }
}

void print_pack_notes(const PackArguments& arguments, const Model& model, const ChartSet& charts) {
  if (arguments.quiet) return;
  const auto note = [&](const std::string& text) {
    say("{}: note: {}\n", arguments.input, printable(text));
  };
  for (const std::string& text : arguments.notes) note(text);
  for (const std::string& text : model.remarks) note(text);
  note_material_files(arguments, model);
  const std::size_t bare = charts.faces_without_uv, folded = charts.self_overlapping;
  if (bare > 0) {
    note(fmt::format("{} no UVs and {} as {}", quantity(bare, "face has", "faces have"),
                     bare == 1 ? "stays" : "stay", bare == 1 ? "it is" : "they are"));
  }
  if (charts.crossing_faces == 1) {
    note(fmt::format("face {} crosses itself in UV: its convex hull is kept free for it",
                     charts.first_crossing_face));
  } else if (charts.crossing_faces > 1) {
    note(
        fmt::format("{} faces cross themselves in UV (face {} is the first): the convex hull of "
                    "each is kept free for it",
                    charts.crossing_faces, charts.first_crossing_face));
  }
  if (folded > 0) {
    note(fmt::format("{} in the input",
                     quantity(folded, "chart overlaps itself", "charts overlap themselves")));
  }
  if (!charts.all_stacks_found) {
    note(arguments.stacked == Stacked::keep
             ? "not all charts that overlap others were found: some are separated"
             : "not all charts that overlap others were looked for; all are separated");
  }
  if (arguments.verbose && charts.stacked > 0) {
    note(fmt::format("{} overlap others in the input and are {}", quantity(charts.stacked, "chart"),
                     arguments.stacked == Stacked::keep ? "kept together" : "separated"));
  }
}

}  // namespace wrapatlas::cli
