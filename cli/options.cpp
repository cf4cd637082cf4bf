#include "options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <thread>

#include "wrapatlas/model.h"

namespace wrapatlas::cli {
namespace {

std::string joined(const std::vector<std::string>& words, const char* last) {
  std::string text = words.front();
  for (std::size_t i = 1; i < words.size(); ++i) {
    text += (i + 1 == words.size() ? last : ", ") + words[i];
  }
  return text;
}

Resolution parse_resolution(const std::string& text) {
  const auto bad = [&text]() {
    refuse_option("--resolution", text, "not a size in texels",
                  "give N or WxH, 1 to 65536 each, e.g. 1024 or 2048x1024");
  };
  Resolution size;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, size.width);
  if (first.ec != std::errc{}) bad();
  size.height = size.width;
  if (first.ptr != end) {
    if (*first.ptr != 'x') bad();
    const auto second = std::from_chars(first.ptr + 1, end, size.height);
    if (second.ec != std::errc{} || second.ptr != end) bad();
    size.two_sided = true;
  }
  const auto [shorter, longer] = std::minmax(size.width, size.height);
  if (shorter < 1 || longer > kMostTexels) bad();
  return size;
}

}  // namespace

Error usage(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::usage, std::move(where), std::move(what), std::move(remedy)};
}

void refuse_option(const std::string& option, const std::string& text, const std::string& what,
                   const std::string& remedy) {
  throw CLI::ValidationError(usage(option + " " + text, what, remedy).message());
}

CLI::Option* add_name_option(CLI::App& app, const std::string& option,
                             const std::vector<std::string>& names,
                             std::function<void(std::size_t)> choose, const std::string& help) {
  CLI::Option* added = app.add_option_function<std::string>(
      option,
      [option, names, choose = std::move(choose)](const std::string& text) {
        const auto found = std::find(names.begin(), names.end(), text);
        if (found == names.end()) {
          refuse_option(option, text, "no such choice", "give " + joined(names, " or "));
        }
        choose(static_cast<std::size_t>(found - names.begin()));
      },
      help);
  return added->type_name(fmt::format("{}", fmt::join(names, "|")));
}

double parse_number(const std::string& option, const std::string& text, Range range, bool whole) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  const bool number = read.ec == std::errc{} && read.ptr == end && std::isfinite(value);
  if (number && value >= range.low && value <= range.high && (!whole || value == std::floor(value)))
    return value;
  const std::string remedy = fmt::format("give a {}number{}{} from {} to {}", whole ? "whole " : "",
                                         *range.unit == 0 ? "" : " of ", range.unit,
                                         number_text(range.low), number_text(range.high));
  refuse_option(option, text,
                !number                                   ? "not a number"
                : value < range.low || value > range.high ? "out of range"
                                                          : "not a whole number",
                remedy);
}

std::string number_text(double value) { return fmt::format("{}", value); }

std::string range_text(Range range) {
  return number_text(range.low) + ".." + number_text(range.high);
}

CLI::Option* add_resolution(CLI::App& app, Resolution& value) {
  return app
      .add_option_function<std::string>(
          "--resolution", [&value](const std::string& text) { value = parse_resolution(text); },
          "Texels of the atlas, 1 to 65536 a side")
      ->type_name("N|WxH")
      ->default_str(fmt::format("{}", value.width));
}

void add_texcoord(CLI::App& app, int& value) {
  add_number(app, "--texcoord", value, {0, 15}, "UV set of a glTF: K of TEXCOORD_K");
}

void add_threads(CLI::App& app, int& value) {
  add_number(app, "--threads", value, {0, 1024, "threads"},
             "Threads; 0: as many as the machine has. Changes the result only where "
             "guided searches for a time");
}

void add_bleed(CLI::App& app, double& value) {
  add_number(app, "--bleed", value, {0, double{kMostTexels}, "texels"},
             "Texels by which charts go on over their borders, along the surface, for mip levels "
             "to see; beyond, the nearest texel is repeated");
}

void add_bits(CLI::App& app, int& value) {
  add_name_option(
      app, "--bits", {"8", "16"}, [&value](std::size_t i) { value = i == 0 ? 8 : 16; },
      "Of each value in the pictures that are written")
      ->default_str(fmt::format("{}", value));
}

void add_json(CLI::App& app, std::string& path) {
  app.add_option("--json", path, "Write a report as JSON to a file, or to standard output for -")
      ->type_name("FILE|-");
}

int threads_for(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

Status check_texcoord(int texcoord, std::span<const std::string> inputs, std::string_view option) {
  if (texcoord == 0) return Done{};
  for (const std::string& input : inputs) {
    const auto format = format_from_path(input);
    if (!format || *format == FileFormat::gltf || *format == FileFormat::glb) return Done{};
  }
  return usage(fmt::format("{} {}", option, texcoord),
               fmt::format("{} can hold one UV set only", inputs.front()),
               "leave it out: only glTF files have several sets");
}

Status refuse_ignored(const CLI::App& app, std::span<const Ignored> options) {
  for (const Ignored& option : options) {
    const CLI::Option* known = app.get_option_no_throw(option.option);
    if (option.ignored && known != nullptr && known->count() > 0) {
      return usage(option.option, option.why, option.remedy);
    }
  }
  return Done{};
}

}  // namespace wrapatlas::cli
