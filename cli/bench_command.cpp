// wrapatlas bench: many meshes by several packers, every packing checked, results kept in a folder.

#include <fmt/format.h>

#include <algorithm>

#include "common.h"
#include "evaluate/evaluate.h"
#include "pack_options.h"

namespace wrapatlas::cli {
namespace {

struct BenchArguments {
  std::vector<std::string> inputs;
  std::string output;
  bool paper = false;
  std::vector<std::string> methods{"lprm02", "swg03", "zsgs04", "modulo", "guided"};
  std::vector<double> times{1};
  Wrap wrap = Wrap::uv;
  Resolution resolution;
  std::string aspect = "square";
  std::optional<double> padding;
  bool no_inner = false, quiet = false;
  Setting setting;
  int threads = 0;
};

/// What --paper stands for; an option that is given itself keeps what it says.
void apply_paper(const CLI::App& app, BenchArguments& a) {
  const auto is_open = [&](const char* option) { return app.count(option) == 0; };
  PackOptions& pack = a.setting.pack;
  if (is_open("--methods")) a.methods = {"lprm02", "swg03", "zsgs04", "modulo"};
  if (is_open("--resolution")) a.resolution = {256, 256, false};
  if (is_open("--aspect")) a.aspect = "search";
  if (is_open("--padding")) a.padding = 0;
  if (is_open("--coverage")) pack.coverage = Coverage::center;
  if (is_open("--scale-start")) pack.start_upper = 0.9;
  if (is_open("--grid")) pack.grid = 256;
}

Status add_contender(BenchArguments& a, const std::string& name) {
  const auto method = value_of(kMethods, name);
  if (!method) {
    return usage("--methods " + name, "no such method",
                 "use lprm02, swg03, zsgs04, modulo, guided");
  }
  const bool can_wrap = *method == Method::modulo || *method == Method::guided;
  Contender contender{name, *method, can_wrap ? a.wrap : Wrap::none, 0};
  std::vector<Contender>& all = a.setting.contenders;
  if (*method != Method::guided) {
    all.push_back(contender);
    return Done{};
  }
  for (const double time : a.times) {
    contender.time = time;
    contender.name = fmt::format("guided {} s", number_text(time));
    all.push_back(contender);
  }
  return Done{};
}

Status resolve(const CLI::App& app, BenchArguments& a) {
  if (a.paper) apply_paper(app, a);
  for (const std::string& name : a.methods) {
    if (const Status ok = add_contender(a, name); !ok) return ok;
  }
  const std::vector<Contender>& all = a.setting.contenders;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool again = std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const Contender& c) { return c.name == all[i].name; });
    if (again) return usage("--methods", all[i].name + " is named twice", "name each once");
  }
  std::vector<Method> methods;
  for (const Contender& contender : all) methods.push_back(contender.method);
  std::vector<Ignored> ignored = options_of_other_methods(methods);
  ignored.push_back({"--times",
                     std::find(methods.begin(), methods.end(), Method::guided) == methods.end(),
                     "guided does not take part", "leave it out, or add guided to --methods"});
  if (const Status ok = refuse_ignored(app, ignored); !ok) return ok;
  if (a.aspect != "square" && a.aspect != "search") {
    return usage("--aspect " + a.aspect, "not a choice of bench", "use square or search");
  }
  PackOptions& pack = a.setting.pack;
  a.setting.all_shapes = a.aspect == "search";
  pack.width = a.resolution.width;
  pack.height = a.resolution.height;
  if (a.setting.all_shapes && pack.width != pack.height) {
    return usage("--aspect search", "--resolution WxH already gives the shape",
                 "give --resolution N");
  }
  pack.padding = a.padding.value_or(std::max(2.0, std::max(pack.width, pack.height) / 256.0));
  pack.inner = !a.no_inner;
  return Done{};
}

std::string minutes(double seconds) {
  return seconds < 90 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60);
}

/// "psb-1: 3 charts; lprm02 0.412, ...": a line for people.
std::string line_of(const MeshResult& result, const Setting& setting) {
  if (!result.error.empty()) return result.error;
  std::string line =
      fmt::format("{}: {};", result.facts.id, quantity(result.facts.charts, "chart"));
  for (const Contender& contender : setting.contenders) {
    double best = 0;
    for (const Run& run : result.runs) {
      if (run.contender == contender.name) best = std::max(best, run.packing.efficiency);
    }
    line += fmt::format(" {} {:.3f}", contender.name, best);
  }
  return line;
}

/// How many meshes and runs of the results failed, the first few in words.
Result<std::size_t> tell_failures(const std::string& folder) {
  const auto results = read_results(folder);
  if (!results) return results.error();
  std::vector<std::string> failures;
  for (const MeshResult& result : *results) {
    if (!result.error.empty()) failures.push_back(result.error);
    for (const Run& run : result.runs) {
      if (run.error.empty()) continue;
      failures.push_back(fmt::format("{}, {}, {} x {}: {}", result.facts.id, run.contender,
                                     run.packing.width, run.packing.height, run.error));
    }
  }
  constexpr std::size_t kTold = 10;
  for (std::size_t i = 0; i < std::min(kTold, failures.size()); ++i) {
    say("failed: {}\n", printable(failures[i]));
  }
  if (failures.size() > kTold) say("and {} more; see runs.csv\n", failures.size() - kTold);
  return failures.size();
}

int run(const CLI::App& app, BenchArguments& a) {
  if (const Status ok = resolve(app, a); !ok) return report_error(ok.error());
  const auto meshes = find_meshes(a.inputs);
  if (!meshes) return report_error(meshes.error());
  const auto store = Store::open(a.output, a.setting);
  if (!store) return report_error(store.error());
  catch_interrupts();
  const double start = seconds_now();
  const auto outcome = [&] {
    ProgressLine line(!a.quiet);
    return evaluate(*meshes, a.setting, *store, a.threads, [&](const EvaluateProgress& progress) {
      if (progress.result && !a.quiet) {
        say("[{}/{}] {}\n", progress.done, progress.all,
            printable(line_of(*progress.result, a.setting)));
      }
      line.show(fmt::format("{} of {} meshes, {} left", progress.done, progress.all,
                            progress.done > 0 ? minutes(progress.seconds_left) : "?"));
      return !interrupted();
    });
  }();
  if (!outcome) return report_error(outcome.error());
  if (outcome->interrupted) {
    return report_error({ErrorKind::interrupted, a.output, "stopped; what is done is kept",
                         "the same command goes on"});
  }
  const auto failures = tell_failures(a.output);
  if (!failures) return report_error(failures.error());
  if (!a.quiet) {
    say("{}, {} of them done before, {}, {} -> {}/runs.csv\n",
        quantity(meshes->size(), "mesh", "meshes"), outcome->done_before,
        quantity(*failures, "failure"), minutes(seconds_now() - start), a.output);
  }
  return *failures > 0 ? 1 : 0;
}

}  // namespace

Command make_bench_command(CLI::App& parser) {
  auto arguments = std::make_shared<BenchArguments>();
  BenchArguments& a = *arguments;
  CLI::App& app = *parser.add_subcommand("bench", "Compare packers over many meshes");
  app.add_option("inputs", a.inputs,
                 "Models, or folders of models (not those in folders within): .obj .ply .off .stl "
                 ".gltf .glb. Models without UVs are unwrapped first, once")
      ->required()
      ->type_name("PATH");
  app.add_option("-o,--output", a.output,
                 "Folder of the results. One that has some already is gone on with")
      ->required()
      ->type_name("DIR");
  app.add_flag("--paper", a.paper,
               "The setting of Noell & Stricker 2011: --methods lprm02,swg03,zsgs04,modulo "
               "--resolution 256 --grid 256 --coverage center --padding 0 --scale-start 0.9 "
               "--aspect search, but for what is given beside it");
  app.add_option("--methods", a.methods, "Packers, in the order of the tables")
      ->delimiter(',')
      ->type_name("METHOD,...")
      ->default_str("lprm02,swg03,zsgs04,modulo,guided");
  app.add_option_function<std::vector<std::string>>(
         "--times",
         [&a](const std::vector<std::string>& texts) {
           a.times.clear();
           for (const std::string& text : texts) {
             a.times.push_back(parse_number("--times", text, {0, 1e6, "seconds"}, false));
           }
         },
         "guided: seconds of its search; it takes part once for each")
      ->delimiter(',')
      ->type_name("SECONDS,...")
      ->default_str("1");
  add_choice(app, "--wrap", a.wrap, kWraps, "Axes that wrap, for the methods that can");
  add_resolution(app, a.resolution);
  app.add_option("--aspect", a.aspect,
                 "square: --resolution alone; search: 31 shapes of its area as well")
      ->type_name("square|search")
      ->capture_default_str();
  add_number(app, "--padding", a.padding, {0, 4096, "texels"},
             "Texels between charts. Default: max(2, longer side / 256)");
  add_method_options(app, a.setting.pack, a.no_inner);
  add_number(app, "--max-stretch", a.setting.unwrap.max_stretch, {1, 1000},
             "Of meshes that are unwrapped: no chart has more L2 stretch");
  app.add_flag("--unwrap", a.setting.unwrap_all, "Unwrap meshes that have UVs too");
  add_threads(app, a.threads);
  app.add_flag("--quiet", a.quiet, "No progress, no summary");
  app.footer(
      "Every packing is timed on one thread and checked as wrapatlas check does; meshes share the\n"
      "cores. Killed or interrupted, the same command goes on with the meshes that are missing.\n"
      "Exit status: 0 done; 1 a mesh or a run failed (the others are there); 2 usage;\n"
      "3 unusable input or output; 130 interrupted.\n"
      "Examples:\n"
      "  wrapatlas bench meshes/ -o results --paper\n"
      "  wrapatlas bench a.obj b.glb -o results --methods modulo,guided --times 0,1,10");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
