// Options of the command line: each kind, and each one that several sub-commands have, once.
#pragma once

#include <CLI/CLI.hpp>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "names.h"
#include "wrapatlas/charts.h"
#include "wrapatlas/pack.h"
#include "wrapatlas/result.h"

namespace wrapatlas::cli {

Error usage(std::string where, std::string what, std::string remedy);

/// Ends the parsing with a usage error; main reports it.
[[noreturn]] void refuse_option(const std::string& option, const std::string& text,
                                const std::string& what, const std::string& remedy);

/// One of a table's names. `value` may be an optional.
CLI::Option* add_name_option(CLI::App& app, const std::string& option,
                             const std::vector<std::string>& names,
                             std::function<void(std::size_t)> choose, const std::string& help);
template <typename E, std::size_t N, typename Target>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Target& value,
                        const Named<E> (&table)[N], const std::string& help) {
  std::vector<std::string> names;
  for (const Named<E>& row : table) names.emplace_back(row.name);
  CLI::Option* added = add_name_option(
      app, option, names, [&value, &table](std::size_t i) { value = table[i].value; }, help);
  if constexpr (std::is_same_v<E, Target>) added->default_str(name_of(table, value));
  return added;
}

/// Both ends belong to it.
struct Range {
  double low = 0, high = 0;
  const char* unit = "";  ///< for the error: "texels"
};

/// A number within a range; the error names option, value and range. `value` may be an optional.
double parse_number(const std::string& option, const std::string& text, Range range, bool whole);
std::string number_text(double value);
std::string range_text(Range range);
template <typename T>
struct NumberIn {
  using type = T;
};
template <typename T>
struct NumberIn<std::optional<T>> {
  using type = T;
};
template <typename T>
CLI::Option* add_number(CLI::App& app, const std::string& option, T& value, Range range,
                        const std::string& help) {
  using Number = typename NumberIn<T>::type;
  constexpr bool whole = std::is_integral_v<Number>;
  CLI::Option* added = app.add_option_function<std::string>(
      option,
      [&value, option, range](const std::string& text) {
        value = static_cast<Number>(parse_number(option, text, range, whole));
      },
      help);
  added->type_name(range_text(range));
  if constexpr (std::is_arithmetic_v<T>) added->default_str(number_text(double(value)));
  return added;
}

/// Texels, from "N" or "WxH".
struct Resolution {
  int width = 1024, height = 1024;
  bool two_sided = false;  ///< given as WxH
};
CLI::Option* add_resolution(CLI::App& app, Resolution& value);

void add_texcoord(CLI::App& app, int& value);
void add_threads(CLI::App& app, int& value);
void add_bleed(CLI::App& app, double& value);
void add_bits(CLI::App& app, int& value);  ///< 8 or 16
void add_json(CLI::App& app, std::string& path);

/// The number of threads that an option of 0 stands for.
int threads_for(int asked);

/// Only glTF has more than one UV set.
Status check_texcoord(int texcoord, std::span<const std::string> inputs,
                      std::string_view option = "--texcoord");

/// An option that was given although nothing reads it here; the command may not have it at all.
struct Ignored {
  std::string option;
  bool ignored;
  std::string why, remedy;
};
Status refuse_ignored(const CLI::App& app, std::span<const Ignored> options);

}  // namespace wrapatlas::cli
