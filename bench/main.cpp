// wrapatlas_bench: programs that time one stage each and print it beside something known.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "chart_files.h"
#include "commands.h"
#include "report.h"

namespace {

using namespace wrapatlas::bench;

void add_chart_options(CLI::App& app, ChartOptions& options) {
  app.add_option("folder", options.folder, "Models with UVs: a folder, or one file")
      ->capture_default_str();
  app.add_option("--stride", options.stride, "Take every N-th file alone")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--runs", options.runs, "Runs, of which the median counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Benchmarks of wrapatlas; ratios say how often something known took the time.");
  app.require_subcommand(1);
  ChartOptions charts;
  charts.folder = default_chart_folder().string();
  PackBenchOptions pack;
  IoBenchOptions io;

  CLI::App& pack_app = *app.add_subcommand("pack", "The four packers, beside the paper's times");
  add_chart_options(pack_app, charts);
  pack_app.add_option("--aspect-runs", pack.aspect_runs, "Runs of the 31 aspect ratios; 0: none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  pack_app.add_option("--aspect-threads", pack.aspect_threads, "Threads for the 31 aspect ratios")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI::App& raster_app =
      *app.add_subcommand("raster", "Rasterisation, beside a test of every cell of every triangle");
  add_chart_options(raster_app, charts);
  CLI::App& slide_app = *app.add_subcommand("slide", "Sliding charts, beside the plain loop");
  add_chart_options(slide_app, charts);
  CLI::App& io_app =
      *app.add_subcommand("io", "Reading and writing, beside reading the bytes and the numbers");
  io_app.add_option("--triangles", io.triangles, "Size of the files, about")
      ->check(CLI::Range(2, 20000000))
      ->capture_default_str();
  io_app.add_option("--runs", io.runs, "Runs, of which the median counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  io_app.add_option("--keep", io.keep, "Only write the two files, into this folder, and keep them");
  CLI::App& mesh_app = *app.add_subcommand("mesh", "Welding and triangulating");
  FlattenBenchOptions flatten;
  flatten.folder = (default_chart_folder().parent_path() / "psb").string();
  if (!std::filesystem::exists(flatten.folder)) flatten.folder = default_chart_folder().string();
  CLI::App& flatten_app = *app.add_subcommand("flatten", "Angle based flattening, beside LSCM");
  flatten_app.add_option("folder", flatten.folder, "Models, with or without UVs")
      ->capture_default_str();
  flatten_app.add_option("--stride", flatten.stride, "Take every N-th file alone")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  SeamBenchOptions seams;
  CLI::App& seams_app = *app.add_subcommand(
      "seams",
      "Errors of a baked normal map along borders, beside those inside charts and "
      "those of a second atlas");
  seams_app.add_option("low", seams.low, "Model with a packed atlas")->required();
  seams_app.add_option("other", seams.other, "The same, cut into other charts")->required();
  seams_app.add_option("high", seams.high, "Model to be baked")->required();
  seams_app.add_option("--resolution", seams.resolution, "Texels of the atlas, a side")
      ->capture_default_str();
  seams_app.add_option("--views", seams.views, "Pictures around the model")->capture_default_str();
  seams_app.add_option("--size", seams.size, "Pixels of each, a side")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  print_machine();
  if (pack_app.parsed()) return bench_pack(charts, pack);
  if (raster_app.parsed()) return bench_raster(charts);
  if (slide_app.parsed()) return bench_slide(charts);
  if (mesh_app.parsed()) return bench_mesh();
  if (flatten_app.parsed()) return bench_flatten(flatten);
  if (seams_app.parsed()) return bench_seams(seams);
  return io_app.parsed() ? bench_io(io) : 2;
}
