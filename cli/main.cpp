// The wrapatlas command: one sub-command per file.

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <iterator>
#include <new>
#include <string>
#include <vector>

#include "common.h"
#include "suggestion.h"

namespace {

/// For the first option that the command does not have: "did you mean --padding? ", or nothing.
std::string meant_option(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;  // not in the help
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  for (int i = 2; i < argc; ++i) {
    const std::string given(argv[i], std::strcspn(argv[i], "="));
    if (!given.starts_with("--") || command.get_option_no_throw(given) != nullptr) continue;
    const std::string nearest = wrapatlas::cli::nearest_name(given.substr(2), names);
    return nearest.empty() ? "" : fmt::format("did you mean --{}? else ", nearest);
  }
  return "";
}

int run(int argc, char** argv) {
  using namespace wrapatlas::cli;
  CLI::App parser{
      "wrapatlas cuts meshes into charts and packs them into texture atlases on the torus: charts\n"
      "may wrap around the atlas border.\n"
      "Exit status: 0 done; 1 a check failed; 2 usage; 3 unusable input or output;\n"
      "4 no packing found; 130 interrupted."};
  parser.name("wrapatlas");
  parser.set_version_flag("--version", "wrapatlas " WRAPATLAS_VERSION);
  parser.set_help_all_flag("--help-all", "Help on every sub-command");
  parser.require_subcommand(1);
  parser.get_formatter()->column_width(34);
  parser.footer(
      "wrapatlas COMMAND --help lists the options of a command as --option CHOICES=DEFAULT or\n"
      "--option LOWEST..HIGHEST=DEFAULT.\n"
      "A first try:\n"
      "  wrapatlas info model.glb\n"
      "  wrapatlas pack model.glb -o packed.glb --resolution 2048 --padding 4 --image atlas.png\n"
      "  wrapatlas unwrap bare.obj -o unwrapped.obj --image atlas.png\n"
      "  wrapatlas simplify scan.ply -o low.obj --faces 1%\n"
      "  wrapatlas check packed.glb --ref model.glb --resolution 2048 --padding 4 --wrap uv");

  const Command commands[] = {make_pack_command(parser),     make_check_command(parser),
                              make_info_command(parser),     make_unwrap_command(parser),
                              make_simplify_command(parser), make_bake_command(parser),
                              make_transfer_command(parser), make_render_command(parser),
                              make_bench_command(parser),    make_report_command(parser)};
  const bool named = argc > 1 && argv[1][0] != '-';
  const auto* const chosen = std::find_if(
      std::begin(commands), std::end(commands),
      [&](const Command& command) { return named && command.app->get_name() == argv[1]; });
  if (named && chosen == std::end(commands)) {
    std::vector<std::string> names;
    for (const Command& command : commands) names.push_back(command.app->get_name());
    const std::string nearest = nearest_name(argv[1], names);
    return report_error(
        {wrapatlas::ErrorKind::usage, argv[1], "no such command",
         (nearest.empty() ? "" : fmt::format("did you mean {}? ", nearest)) +
             "use unwrap, pack, simplify, bake, transfer, render, check, info, bench "
             "or report; wrapatlas --help says more"});
  }
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ValidationError& error) {  // ours alone, and complete: see options.h
    return report_error({wrapatlas::ErrorKind::usage, "", error.what(), ""});
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return parser.exit(error);
    if (!named)
      return report_error({wrapatlas::ErrorKind::usage, "", error.what(), "see wrapatlas --help"});
    const bool unknown = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    return report_error({wrapatlas::ErrorKind::usage, "", error.what(),
                         (unknown ? meant_option(*chosen->app, argc, argv) : "") +
                             fmt::format("see wrapatlas {} --help", argv[1])});
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return wrapatlas::cli::report_error({wrapatlas::ErrorKind::input, "", "out of memory",
                                         "use a smaller model or a machine with more memory"});
  } catch (const std::exception& error) {
    return wrapatlas::cli::report_error(
        {wrapatlas::ErrorKind::input, "", error.what(), "please report this as a bug"});
  }
}
