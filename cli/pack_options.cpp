#include "pack_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "pack/request.h"
#include "wrapatlas/model.h"

namespace wrapatlas::cli {
namespace {

constexpr const char* kPackingGroup = "Packing";  ///< of options, in --help

void add_promise_options(CLI::App& app, PackArguments& a) {
  add_resolution(app, a.resolution);
  app.add_option(
         "--aspect", a.aspect,
         "Shape of the atlas at the area of --resolution N; search: the best ratio found "
         "from 1:8 to 8:1 (of 31, as in the paper; guided also goes on from them to others "
         "where it separates charts); pow2: the best whose sides are powers of two. Default: as "
         "--resolution says")
      ->type_name("square|W:H|search|pow2");
  add_choice(app, "--wrap", a.wrap, kWraps,
             "Axes on which charts may wrap around. Default: uv; none for the earlier packers");
  add_choice(app, "--export", a.export_mode, kExports,
             "continuous: whole charts, UVs may exceed 1 where they wrap; cut: faces are split at "
             "the border so that all UVs lie in [0,1]");
  add_number(app, "--padding", a.padding, {0, 4096, "texels"},
             "Texels between charts, kept exactly. Default: max(2, longer side / 256)");
  add_number(app, "--margin", a.margin, {0, double{kMostTexels}, "texels"},
             "Texels to a side that does not wrap. Default: half the padding");
  add_number(app, "--block", a.options.block, {1, 64, "texels"},
             "No two charts share a block of N x N texels (4 for BCn compression)");
}

void add_page_options(CLI::App& app, PackArguments& a) {
  add_number(
      app, "--density", a.density, {1e-9, 1e9, "texels"},
      "guided: a fixed scale: so many texels along one unit of the model's surface, in units "
      "of the file's positions. It is the mean over the mesh, for all charts keep one scale: "
      "texels per UV unit times the root of (area in UV / area in space). As many pages of "
      "--resolution are filled as that takes. Default: the largest scale that fits");
  add_number(app, "--pages", a.pages, {1, double{kMostPages}, "pages"},
             "guided: at most so many pages of --resolution. Page p, from 0 on, is the UV tile "
             "that begins at (p mod 10, p / 10). Default: 1, or with --density as many as needed");
  app.add_flag("--udim", a.udim,
               "guided: pages are UDIM tiles 1001, 1002, ...: nothing wraps, so that each chart "
               "lies within its tile");
}

void add_search_options(CLI::App& app, PackArguments& a) {
  PackOptions& options = a.options;
  add_number(
      app, "--time", options.time, {0, 1e6, "seconds"},
      "guided: how long to search; 0: as long as it takes to fill one domain after the other "
      "until one is too small");
  add_number(app, "--moves", options.moves, {0, 1e15, "moves"},
             "guided: search for so many moves of charts instead of a time, so that the result is "
             "the same on every machine; 0: --time counts");
  add_method_options(app, options, a.no_inner);
}

void add_output_options(CLI::App& app, PackArguments& a) {
  add_json(app, a.json);
  app.add_option(
         "--image", a.image,
         "Draw the atlas: .png or .svg. Several pages are in one picture, as they lie in UV "
         "space: page 0 at the lower left, ten to a row")
      ->type_name("FILE");
  add_number(app, "--image-size", a.picture.size, {16, 8192, "pixels"},
             "Pixels along the longer side of the atlas (a page) in the picture; fewer where the "
             "picture would be longer than 16384");
  app.add_flag("--image-tiles", a.picture.tile2x2,
               "Draw the atlas twice along each axis that wraps, to show how it goes on");
  app.add_flag("--quiet", a.quiet, "No progress, no summary, no notes");
  app.add_flag("--verbose", a.verbose, "A longer summary, more notes");
}

Status refuse_useless(const CLI::App& app, const PackArguments& a) {
  const Wrap wrap = a.options.wrap;
  if (const Status ok = refuse_ignored(app, options_of_other_methods({&a.options.method, 1}));
      !ok) {
    return ok;
  }
  const std::string no_picture = "no picture is drawn", add_picture = "add --image FILE";
  const Ignored ignored[] = {
      {"--image-size", a.image.empty() && !a.draws_atlas, no_picture, add_picture},
      {"--image-tiles", a.image.empty(), no_picture, add_picture},
      {"--image-tiles", wrap == Wrap::none, "nothing wraps, so there is nothing to repeat",
       "leave it out"},
      {"--margin", wrap == Wrap::uv, "both axes wrap, so there are no sides to keep away from",
       "leave it out, or give --wrap u, v or none"},
      {"--time", a.options.moves > 0, "--moves counts instead", "give one of them"},
      {"--moves", a.options.pages != 1, "pages are filled by best fit, which counts no moves",
       "leave it out, or give --time"},
      {"--verbose", a.quiet, "it contradicts --quiet", "give one of them"},
  };
  return refuse_ignored(app, ignored);
}

/// --resolution and --aspect together give the size in texels.
Status resolve_size(PackArguments& a) {
  const Resolution& size = a.resolution;
  PackOptions& options = a.options;
  options.width = size.width;
  options.height = size.height;
  if (a.aspect.empty()) return Done{};
  if (size.two_sided) {
    return usage("--aspect " + a.aspect, "--resolution WxH already gives the shape",
                 "leave out --aspect, or give --resolution N");
  }
  return set_aspect(options, a.aspect, "--aspect ");
}

}  // namespace

void add_method_options(CLI::App& app, PackOptions& options, bool& no_inner) {
  add_number(
      app, "--rotations", options.rotations, {1, 3600, "angles"},
      "Angles each chart is tried at (lprm02 has one of its own). guided: in best fit; when it "
      "separates charts it has more of its own");
  add_choice(app, "--rotation-base", options.rotation_base, kRotationBases,
             "Angles counted from the chart's input axes (the paper), or from its smallest box");
  add_number(
      app, "--grid", options.grid, {0, 8192, "cells"},
      "Cells along the longer side of the search grid; finer is slower and, as a rule, "
      "denser. 0: guided, a cell to a texel up to 2048, or 4096 for more than 200 charts; the "
      "others 256, more for many charts");
  add_choice(app, "--coverage", options.coverage, kCoverages,
             "When a cell belongs to a chart: conservative (safe), or center (the paper's; charts "
             "may overlap by part of a cell)");
  add_number(app, "--scale-start", options.start_upper, {0.1, 1},
             "Upper end of the scale search at its start, in parts of the scale that would fill "
             "the atlas; the paper prints 0.9");
  add_number(app, "--lambda", options.lambda, {0, 1e6},
             "modulo: how much worse placements count that lie on top of the packing");
  app.add_flag("--no-inner", no_inner, "modulo: leave out the four inner strategies");
  app.add_flag("--all-sides", options.all_sides, "zsgs04: try all four sides for every chart");
  add_number(app, "--seed", options.seed, {0, 4294967295},
             "guided: another number, another packing. The other methods draw no random numbers");
}

std::vector<Ignored> options_of_other_methods(std::span<const Method> methods) {
  std::vector<std::string_view> names;
  for (const Method method : methods) names.push_back(name_of(kMethods, method));
  const std::string why = fmt::format("{} {} no use for it", fmt::join(names, ", "),
                                      names.size() == 1 ? "has" : "have");
  std::vector<Ignored> ignored;
  for (const auto& [name, readers] : method_options()) {
    ignored.push_back({fmt::format("--{}", name),
                       std::find_first_of(methods.begin(), methods.end(), readers.begin(),
                                          readers.end()) == methods.end(),
                       why,
                       fmt::format("leave it out, or use {}", name_of(kMethods, readers.front()))});
  }
  return ignored;
}

std::vector<Ignored> packing_options(const CLI::App& app, bool are_ignored, const std::string& why,
                                     const std::string& remedy) {
  std::vector<Ignored> ignored;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group() != kPackingGroup) continue;
    ignored.push_back({option->get_name(), are_ignored, why, remedy});
  }
  return ignored;
}

void add_pack_options(CLI::App& app, PackArguments& a, const char* input_help) {
  app.add_option("input", a.input, input_help)->required();
  app.add_option("-o,--output", a.output,
                 "Where to write it: .obj .ply .gltf .glb. The input's format keeps all else as "
                 "it is; another one gets faces and UVs")
      ->required()
      ->type_name("FILE");
  add_texcoord(app, a.texcoord);
  add_threads(app, a.options.threads);
  add_output_options(app, a);
  const std::string group = app.option_defaults()->get_group();
  app.option_defaults()->group(kPackingGroup);
  add_choice(
      app, "--method", a.options.method, kMethods,
      "guided (the densest), modulo (Noell & Stricker 2011), or an earlier packer: these three "
      "cannot wrap");
  add_promise_options(app, a);
  add_page_options(app, a);
  add_search_options(app, a);
  app.option_defaults()->group(group);
}

Status resolve_pack_options(const CLI::App& app, PackArguments& a) {
  PackOptions& options = a.options;
  if (const Status ok = resolve_size(a); !ok) return ok;
  options.wrap = a.wrap.value_or(can_wrap(options.method) && !a.udim ? Wrap::uv : Wrap::none);
  if (a.udim && options.wrap != Wrap::none) {
    return usage(fmt::format("--wrap {}", name_of(kWraps, options.wrap)),
                 "a chart must not cross the border of a UDIM tile", "leave it out, or --udim");
  }
  options.pages = a.pages.value_or(a.density ? 0 : 1);
  if (!can_wrap(options.method) && options.wrap != Wrap::none) {
    return usage(fmt::format("--wrap {}", name_of(kWraps, options.wrap)),
                 fmt::format("{} cannot wrap around the border", name_of(kMethods, options.method)),
                 "use --method guided or modulo, or --wrap none");
  }
  options.padding = a.padding.value_or(default_padding(options.width, options.height));
  options.margin = a.margin.value_or(-1);
  options.inner = !a.no_inner;
  if (options.method == Method::lprm02) {
    options.rotations = 1;
    if (app.count("--rotations") > 0) {
      a.notes.emplace_back("lprm02 has one orientation a chart, whatever --rotations says");
    }
  }
  options.threads = threads_for(options.threads);
  if (const Status ok = refuse_useless(app, a); !ok) return ok;
  return check_texcoord(a.texcoord, std::span(&a.input, 1));
}

}  // namespace wrapatlas::cli
