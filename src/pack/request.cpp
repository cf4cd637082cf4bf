#include "pack/request.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace wrapatlas {
namespace {

std::optional<double> positive_number(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end || !(value > 0)) return std::nullopt;
  return value;
}

/// Width to height.
std::optional<double> parse_ratio(std::string_view text) {
  if (text == "square") return 1;
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto across = positive_number(text.substr(0, colon));
  const auto up = positive_number(text.substr(colon + 1));
  if (!across || !up) return std::nullopt;
  const double ratio = *across / *up;
  if (!(ratio <= 1024 && ratio >= 1.0 / 1024)) return std::nullopt;
  return ratio;
}

}  // namespace

double default_padding(int width, int height) {
  return std::max(2.0, std::max(width, height) / 256.0);
}

bool can_wrap(Method method) { return method == Method::modulo || method == Method::guided; }

const std::vector<MethodOption>& method_options() {
  static const std::vector<MethodOption> options{
      {"time", {Method::guided}},
      {"moves", {Method::guided}},
      {"density", {Method::guided}},
      {"pages", {Method::guided}},
      {"udim", {Method::guided}},
      {"rotations",
       {Method::guided, Method::modulo, Method::swg03, Method::zsgs04, Method::lprm02}},
      {"scale-start", {Method::modulo, Method::swg03, Method::zsgs04, Method::lprm02}},
      {"rotation-base", {Method::modulo, Method::swg03, Method::zsgs04}},
      {"lambda", {Method::modulo}},
      {"no-inner", {Method::modulo}},
      {"all-sides", {Method::zsgs04}},
      {"seed", {Method::guided}},
  };
  return options;
}

Status set_aspect(PackOptions& options, std::string_view text, std::string_view name) {
  const auto refuse = [&](std::string what, std::string remedy) {
    return Error{ErrorKind::usage, fmt::format("{}{}", name, text), std::move(what),
                 std::move(remedy)};
  };
  if (text == "search" || text == "pow2") {
    options.aspect = text == "search" ? Aspect::search : Aspect::pow2;
    return Done{};
  }
  const auto ratio = parse_ratio(text);
  if (!ratio) {
    return refuse("not an aspect ratio",
                  "give square, search, pow2 or W:H, e.g. 2:1, at most 1024:1");
  }
  const double stretch = std::sqrt(*ratio);
  const auto texels = [&](double side) {
    const double block = options.block;
    return static_cast<int>(std::max(1.0, std::round(side / block)) * block);
  };
  const int width = texels(options.width * stretch), height = texels(options.height / stretch);
  if (std::max(width, height) > kMostTexels) {
    return refuse(fmt::format("makes {} x {} texels", width, height),
                  "lower --resolution: 65536 texels a side are the limit");
  }
  options.width = width;
  options.height = height;
  return Done{};
}

double margin_in_force(const PackOptions& options) {
  return options.margin < 0 ? options.padding / 2 : options.margin;
}

Error in_units_of_surface(Error error, double uv_density, std::string_view option) {
  if (!(error.density_that_fits > 0)) return error;
  const double fits = error.density_that_fits * uv_density;
  const double unit = std::pow(10, std::floor(std::log10(fits)) - 4);
  error.remedy = fmt::format("{}{:.5g} would fit, or raise --resolution", option,
                             std::floor(fits / unit) * unit);
  return error;
}

}  // namespace wrapatlas
