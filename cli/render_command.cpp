// wrapatlas render: a picture of a model with its textures, and how like another picture it is.

#include "wrapatlas/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common.h"
#include "io/file.h"
#include "options.h"
#include "output_paths.h"
#include "render_pictures.h"
#include "wrapatlas/model.h"
#include "wrapatlas/model_textures.h"

namespace wrapatlas::cli {
namespace {

enum class Space { tangent, object };
constexpr Named<Space> kSpaces[] = {{"tangent", Space::tangent}, {"object", Space::object}};
enum class Light { smooth, flat, none };
constexpr Named<Light> kLights[] = {
    {"smooth", Light::smooth}, {"flat", Light::flat}, {"none", Light::none}};
enum class Filter { trilinear, bilinear };
constexpr Named<Filter> kFilters[] = {{"trilinear", Filter::trilinear},
                                      {"bilinear", Filter::bilinear}};

constexpr double kDegree = std::numbers::pi / 180;

struct RenderArguments {
  std::string input, output, texture, normal_map, framed, other, json;
  Space space = Space::tangent;
  Light shade = Light::smooth;
  Filter filter = Filter::trilinear;
  Wrap wrap = Wrap::uv;
  std::optional<double> level, hard_edges;   ///< degrees
  std::optional<double> azimuth, elevation;  ///< degrees
  int texcoord = 0;
  bool no_textures = false, quiet = false;
  RenderOptions options;
};

Status resolve(const CLI::App& app, RenderArguments& a) {
  const bool bare = a.texture.empty() && a.normal_map.empty();
  const std::string no_texture = "no texture is drawn", add = "add --texture or --normal-map";
  const std::string own = "a model's own textures repeat as it says";
  const Ignored ignored[] = {
      {"--space", a.normal_map.empty(), "there is no normal map", "add --normal-map"},
      {"--shade", !a.normal_map.empty(), "the normal map says how it is lit", "leave one out"},
      {"--filter", bare && a.no_textures, no_texture, add},
      {"--wrap", bare, own, add},
      {"--level", bare && a.no_textures, no_texture, add},
      {"--no-textures", !a.texture.empty(), "--texture takes their place anyway", "leave it out"},
      {"--level", a.filter == Filter::bilinear, "bilinear filtering stays on level 0",
       "leave one out"},
      {"--views", a.azimuth || a.elevation, "--azimuth and --elevation are of a single view",
       "leave one out"},
      {"--hard-edges", !a.normal_map.empty() && a.space == Space::object,
       "object space needs no other normals", "leave it out"},
      {"--hard-edges", a.normal_map.empty() && a.shade != Light::smooth, "nothing is smooth",
       "leave it out, or --shade"},
  };
  if (const Status ok = refuse_ignored(app, ignored); !ok) return ok;
  if (!a.output.ends_with(".png")) {
    return usage(a.output, "this picture is of pixels", "write .png");
  }
  RenderOptions& options = a.options;
  if (a.azimuth || a.elevation) {
    options.from = {a.azimuth.value_or(0) * kDegree, a.elevation.value_or(0) * kDegree};
    options.views = 1;
  }
  if (options.size * options.views > kMostTexels) {
    return usage(fmt::format("--views {} --size {}", options.views, options.size),
                 fmt::format("a picture has at most {} pixels a side", kMostTexels),
                 "give less of one of them");
  }
  options.shading = a.shade == Light::none   ? Shading::none
                    : a.shade == Light::flat ? Shading::flat
                                             : Shading::smooth;
  if (!a.normal_map.empty()) {
    options.shading = a.space == Space::object ? Shading::object_normals : Shading::tangent_normals;
  }
  options.wrap = a.wrap;
  options.trilinear = a.filter == Filter::trilinear;
  options.level = a.level.value_or(-1);
  if (a.hard_edges) options.hard_angle = *a.hard_edges * kDegree;
  options.threads = threads_for(options.threads);
  return check_texcoord(a.texcoord, std::span(&a.input, 1));
}

Status check_files(const RenderArguments& a, const Model& model, const Model* framed) {
  const OutputPath outputs[] = {{"-o", a.output}, {"--json", a.json}};
  if (const Status ok = refuse_equal_outputs(outputs); !ok) return ok;
  if (const Status ok = refuse_overwriting(a.input, model, outputs); !ok) return ok;
  if (framed != nullptr) {
    if (const Status ok = refuse_overwriting(a.framed, *framed, outputs); !ok) return ok;
  }
  for (const OutputPath& output : outputs) {
    if (output.path.empty() || output.path == "-") continue;
    for (const std::string& read : {a.texture, a.normal_map, a.other}) {
      if (!read.empty() && same_file(output.path, read)) {
        return usage(fmt::format("{} {}", output.option, output.path),
                     "it would overwrite what is read", "give another name");
      }
    }
    if (const Status ok = check_writable(output.path); !ok) return ok;
  }
  return Done{};
}

Json report_of(const RenderArguments& a, const Rendering& rendering,
               const std::optional<Likeness>& likeness, double seconds) {
  const auto covered = std::count(rendering.covered.begin(), rendering.covered.end(), 1);
  Json report = {{"version", WRAPATLAS_VERSION},
                 {"command", "render"},
                 {"input", a.input},
                 {"output", a.output},
                 {"width", rendering.image.width},
                 {"height", rendering.image.height},
                 {"views", a.options.views},
                 {"threads", a.options.threads},
                 {"covered", covered}};
  if (likeness) {
    report["other"] = a.other;
    // Equal pictures have no finite ratio, and JSON no word for that.
    report["psnr"] = std::isfinite(likeness->psnr) ? Json(likeness->psnr) : Json();
    report["ssim"] = likeness->ssim;
  }
  report["seconds"] = {{"total", seconds}};
  report["peak_memory_mb"] = peak_memory_mb();
  return report;
}

void summarize(const RenderArguments& a, const std::optional<Likeness>& likeness, double seconds) {
  const std::string how_alike = likeness ? fmt::format("; beside {}: PSNR {:.2f} dB, SSIM {:.4f}",
                                                       a.other, likeness->psnr, likeness->ssim)
                                         : "";
  say("{}: {}{}, {:.2f} s -> {}\n", a.input, quantity(std::size_t(a.options.views), "view"),
      how_alike, seconds, a.output);
}

Result<std::optional<Model>> load_framed(const RenderArguments& a) {
  if (a.framed.empty()) return std::optional<Model>();
  LoadOptions options;
  options.in_scene = true;
  options.may_add_set = true;  // it need not have any
  auto model = load_model(a.framed, options);
  if (!model) return model.error();
  return std::optional<Model>(*std::move(model));
}

/// What the model is drawn with, as RenderOptions points to it.
struct Pictures {
  MipMaps color, normals;
  BaseColors own;
};

Status load_pictures(RenderArguments& a, const Model& model, Pictures& pictures) {
  const bool textured = !a.texture.empty() || !a.normal_map.empty();
  if (textured && model.mesh.texcoords.empty()) {
    return Error{ErrorKind::input, a.input, "it has no UVs for a texture",
                 "unwrap it first, or give the model that the texture was made for"};
  }
  const int threads = a.options.threads;
  if (const Status ok = read_maps(a.texture, false, threads, pictures.color); !ok) return ok;
  if (const Status ok = read_maps(a.normal_map, true, threads, pictures.normals); !ok) return ok;
  if (!pictures.color.levels.empty()) a.options.color = &pictures.color;
  if (!pictures.normals.levels.empty()) a.options.normals = &pictures.normals;
  if (!a.texture.empty() || a.no_textures) return Done{};
  auto found = base_colors(model, threads);
  if (!found) {
    say("{}: note: drawn without its textures: {}\n", a.input, found.error().message());
    return Done{};
  }
  pictures.own = *std::move(found);
  a.options.group_colors = pictures.own.groups;
  a.options.face_group = pictures.own.face_group;
  return Done{};
}

int run(const CLI::App& app, RenderArguments& a) {
  const double start = seconds_now();
  if (const Status ok = resolve(app, a); !ok) return report_error(ok.error());
  LoadOptions load_options;
  load_options.texcoord_set = a.texcoord;
  load_options.shading = load_options.in_scene = true;
  const auto model = load_model(a.input, load_options);
  if (!model) return report_error(model.error());
  const auto framed = load_framed(a);
  if (!framed) return report_error(framed.error());
  if (*framed) a.options.framed = &(*framed)->mesh;
  if (const Status ok = check_files(a, *model, *framed ? &**framed : nullptr); !ok) {
    return report_error(ok.error());
  }
  Pictures pictures;
  if (const Status ok = load_pictures(a, *model, pictures); !ok) return report_error(ok.error());
  if (!a.hard_edges) {
    a.options.corner_normals = model->corner_normal;
    a.options.corner_tangents = model->corner_tangent;
  }
  a.options.v_points_down = model->v_points_down;
  const Rendering rendering = render(model->mesh, a.options);
  std::optional<Likeness> likeness;
  if (!a.other.empty()) {
    const auto found = likeness_to(a.other, rendering, a.options.threads);
    if (!found) return report_error(found.error());
    likeness = *found;
  }
  OutputTransaction outputs;
  if (const Status ok = save_texture(a.output, rendering.image); !ok) {
    return report_error(ok.error());
  }
  const double seconds = seconds_now() - start;
  if (!a.json.empty()) {
    if (const Status ok = write_json(a.json, report_of(a, rendering, likeness, seconds)); !ok) {
      return report_error(ok.error());
    }
  }
  if (const Status ok = outputs.commit(); !ok) return report_error(ok.error());
  if (!a.quiet) summarize(a, likeness, seconds);
  return 0;
}

}  // namespace

Command make_render_command(CLI::App& parser) {
  auto arguments = std::make_shared<RenderArguments>();
  RenderArguments& a = *arguments;
  CLI::App& app = *parser.add_subcommand("render", "Draw a model with its textures");
  app.add_option("input", a.input, "Model: .obj .ply .off .stl .gltf .glb")->required();
  app.add_option("-o,--output", a.output, "Where to write the picture")
      ->required()
      ->type_name("FILE.png");
  app.add_option(
         "--texture", a.texture,
         "Its colours, PNG or JPEG, sRGB. Default: those that its materials name (glTF, OBJ)")
      ->type_name("FILE");
  app.add_flag("--no-textures", a.no_textures, "Light grey, whatever its materials name");
  app.add_option("--normal-map", a.normal_map, "PNG or JPEG, as wrapatlas bake makes it")
      ->type_name("FILE");
  add_choice(app, "--space", a.space, kSpaces, "What the normal map is along");
  add_choice(app, "--shade", a.shade, kLights,
             "Without a normal map: by smooth normals, by those of the faces, or no light");
  add_number(
      app, "--hard-edges", a.hard_edges, {0, 180, "degrees"},
      "The model is smooth but for edges whose faces differ by more. Default: the normals in "
      "its file, or smooth everywhere");
  add_choice(app, "--filter", a.filter, kFilters, "How textures are read");
  add_choice(app, "--wrap", a.wrap, kWraps,
             "Axes on which textures repeat; on the others the last texel goes on");
  add_number(app, "--level", a.level, {0, 16},
             "The mip level everywhere. Default: by the size of texels on the picture");
  add_number(app, "--size", a.options.size, {16, 4096, "pixels"}, "Of each view, square");
  add_number(app, "--views", a.options.views, {1, 64, "views"},
             "Side by side: around the model, every second from below");
  add_number(
      app, "--azimuth", a.azimuth, {-360, 360, "degrees"},
      "One view, from there: around y, from z towards x. Default: 0, if --elevation is given");
  add_number(app, "--elevation", a.elevation, {-90, 90, "degrees"},
             "One view, from so far above the horizon. Default: 0, if --azimuth is given");
  app.add_option("--framed-as", a.framed,
                 "A model that the cameras are set up for instead, so that pictures of both lie "
                 "over each other")
      ->type_name("MODEL");
  app.add_option("--compare", a.other,
                 "A picture of the same size: the PSNR and SSIM over all pixels that show this "
                 "model in full")
      ->type_name("FILE");
  add_texcoord(app, a.texcoord);
  add_threads(app, a.options.threads);
  add_json(app, a.json);
  app.add_flag("--quiet", a.quiet, "No summary; what is missing on the picture is still said");
  app.footer(
      "Exit status: 0 written; 2 usage; 3 unusable input or output.\n"
      "Examples:\n"
      "  wrapatlas render scan.ply -o scan.png --views 4\n"
      "  wrapatlas render low.glb -o low.png --views 4 --normal-map normal.png \\\n"
      "    --framed-as scan.ply --compare scan.png");
  return {&app, [arguments, &app] { return run(app, *arguments); }};
}

}  // namespace wrapatlas::cli
