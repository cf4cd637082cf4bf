// wrapatlas report: the results of bench as a page.

#include "common.h"
#include "evaluate/report.h"

namespace wrapatlas::cli {
namespace {

struct ReportArguments {
  std::string results, output;
  bool quiet = false;
};

int run(const ReportArguments& arguments) {
  if (const Status ok = write_report(arguments.results, arguments.output); !ok) {
    return report_error(ok.error());
  }
  if (!arguments.quiet) say("{} -> {}/index.html\n", arguments.results, arguments.output);
  return 0;
}

}  // namespace

Command make_report_command(CLI::App& parser) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App& app = *parser.add_subcommand("report", "Show the results of bench as a page");
  app.add_option("results", arguments->results, "The folder that bench -o made")
      ->required()
      ->type_name("DIR");
  app.add_option("-o,--output", arguments->output,
                 "Folder for index.html, which has all in it, and the plots and tables as files")
      ->required()
      ->type_name("DIR");
  app.add_flag("--quiet", arguments->quiet, "No summary");
  app.footer(
      "Exit status: 0 written; 2 usage; 3 unusable input or output.\n"
      "Example:\n"
      "  wrapatlas report results -o report");
  return {&app, [arguments] { return run(*arguments); }};
}

}  // namespace wrapatlas::cli
