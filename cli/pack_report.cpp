#include "pack_report.h"

#include <fmt/format.h>

namespace wrapatlas::cli {

Json pack_json(const PackArguments& arguments, const ChartSet& charts, const Packing& packing,
               const PackOutcome& outcome) {
  const PackOptions& options = arguments.options;
  return {{"version", WRAPATLAS_VERSION},
          {"command", "pack"},
          {"input", arguments.input},
          {"output", arguments.output},
          {"method", name_of(kMethods, options.method)},
          {"wrap", name_of(kWraps, packing.wrap)},
          {"export", name_of(kExports, arguments.export_mode)},
          {"width", packing.width},
          {"height", packing.height},
          {"pages", 1},
          {"charts", charts.charts.size()},
          {"placed", packing.placements.size()},
          {"stacked", charts.stacked},
          {"self_overlapping", charts.self_overlapping},
          {"faces_without_uv", charts.faces_without_uv},
          {"padding", options.padding},
          {"coverage", name_of(kCoverages, options.coverage)},
          {"grid", {packing.grid_width, packing.grid_height}},
          {"rotations", options.rotations},
          {"scale", packing.scale},
          {"efficiency", packing.efficiency},
          {"raster_efficiency", packing.raster_efficiency},
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
}

void print_pack_summary(const PackArguments& arguments, const ChartSet& charts,
                        const Packing& packing, const PackOutcome& outcome) {
  say("{}: {} on {} x {} texels, {:.1f} % in use, {:.2f} s{} -> {}\n", arguments.input,
      quantity(charts.charts.size(), "chart"), packing.width, packing.height,
      100 * packing.efficiency, outcome.total,
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
}

void print_pack_notes(const PackArguments& arguments, const Model& model, const ChartSet& charts) {
  if (arguments.quiet) return;
  const auto note = [&](const std::string& text) {
    say("{}: note: {}\n", arguments.input, printable(text));
  };
  for (const std::string& text : model.remarks) note(text);
  if (charts.faces_without_uv > 0) {
    note(fmt::format("{} faces have no UVs and stay as they are", charts.faces_without_uv));
  }
  if (charts.self_overlapping > 0) {
    note(fmt::format("{} charts overlap themselves in the input", charts.self_overlapping));
  }
  if (arguments.verbose && charts.stacked > 0) {
    note(fmt::format("{} overlap others in the input and are {}", quantity(charts.stacked, "chart"),
                     arguments.stacked == Stacked::keep ? "kept together" : "separated"));
  }
}

}  // namespace wrapatlas::cli
