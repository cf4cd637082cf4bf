// What the sub-commands share: exit statuses, errors, JSON, progress, interruption.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas::cli {

using Json = nlohmann::ordered_json;

/// 0 done, 1 a check failed, 2 usage, 3 unusable input or output, 4 no packing, 130 interrupted.
int exit_status(ErrorKind kind);

/// One line of valid UTF-8 without control characters: what a file holds may be put into it.
std::string printable(std::string text);

/// Writes to stderr; that it cannot be written is nobody's concern.
void say_text(const std::string& text) noexcept;
template <typename... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_text(fmt::format(format, std::forward<Values>(values)...));
}

/// Writes to standard output and flushes it.
Status print_text(const std::string& text);

/// Prints the one line on stderr and returns the exit status.
int report_error(const Error& error);

/// "1 chart", "2 charts"; the plural is the noun with an s unless it is given.
std::string quantity(std::size_t count, const std::string& noun, const std::string& plural = "");

/// A sub-command registered with the parser; run it if it was chosen.
struct Command {
  CLI::App* app;
  std::function<int()> run;
};
Command make_pack_command(CLI::App& parser);
Command make_check_command(CLI::App& parser);
Command make_info_command(CLI::App& parser);
Command make_unwrap_command(CLI::App& parser);
Command make_simplify_command(CLI::App& parser);
Command make_bake_command(CLI::App& parser);
Command make_transfer_command(CLI::App& parser);
Command make_bench_command(CLI::App& parser);
Command make_render_command(CLI::App& parser);
Command make_report_command(CLI::App& parser);

/// Writes the object to a file, or to standard output for "-".
Status write_json(const std::string& path, const Json& object);

double seconds_now();

/// Whether the output's format cannot hold the input's nodes, which then have to be applied
/// (LoadOptions::in_scene).
bool leaves_nodes_behind(const std::string& input, const std::string& output);
double peak_memory_mb();

/// Ctrl-C sets a flag from here on, instead of ending the program.
void catch_interrupts();
bool interrupted();

/// Shows a line of progress on stderr while it lives, if stderr is a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void show(const Progress& progress);
  void show(const std::string& text);

 private:
  bool active_;
  bool shown_ = false;
};

}  // namespace wrapatlas::cli
