#include "common.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "io/file.h"
#include "wrapatlas/model.h"

namespace wrapatlas::cli {
namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

void on_interrupt(int) { interrupt_flag = 1; }

}  // namespace

int exit_status(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::check:
      return 1;
    case ErrorKind::usage:
      return 2;
    case ErrorKind::input:
    case ErrorKind::output:
      return 3;
    case ErrorKind::no_packing:
      return 4;
    case ErrorKind::interrupted:
      return 130;
  }
  return 3;
}

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  // The JSON writer knows what is valid UTF-8: it puts U+FFFD where it is not.
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

void say_text(const std::string& text) noexcept {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

Status print_text(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) {
    return Done{};
  }
  return Error{ErrorKind::output, "standard output", "cannot write", "check where it goes"};
}

int report_error(const Error& error) {
  say("wrapatlas: error: {}\n", printable(error.message()));
  return exit_status(error.kind);
}

std::string quantity(std::size_t count, const std::string& noun, const std::string& plural) {
  return fmt::format("{} {}", count, count == 1 ? noun : (plural.empty() ? noun + "s" : plural));
}

Status write_json(const std::string& path, const Json& object) {
  const std::string text =
      object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  return path == "-" ? print_text(text) : write_file(path, text);
}

bool leaves_nodes_behind(const std::string& input, const std::string& output) {
  const auto from = format_from_path(input), to = format_from_path(output);
  return from && to && !keeps_all(*to, *from);
}

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double peak_memory_mb() {
  // getrusage() begins with the peak of the process that started this one.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::strtod(line.c_str() + 6, nullptr) / 1024;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second Ctrl-C ends the program at once
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_flag != 0; }

ProgressLine::ProgressLine(bool wanted) : active_(wanted && ::isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (shown_) say("\r\033[K");
}

void ProgressLine::show(const Progress& progress) {
  std::string text = fmt::format("packing {:3.0f} %", 100 * progress.fraction);
  if (progress.best_efficiency > 0) {
    text +=
        fmt::format(", best so far {:.1f} % of the atlas in use", 100 * progress.best_efficiency);
  }
  show(text + " (Ctrl-C keeps the best)");
}

void ProgressLine::show(const std::string& text) {
  if (!active_) return;
  shown_ = true;
  say("\r\033[K{}", text);
  std::fflush(stderr);
}

}  // namespace wrapatlas::cli
