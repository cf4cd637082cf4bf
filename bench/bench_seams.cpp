// Seams: how far off a baked normal map is along the borders of charts and of the atlas, and how
// far inside charts, as seen in pictures of the model from around it; beside the inside where the
// surface bends as much, and at the same places of a second atlas, cut in another way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "commands.h"
#include "mesh/polygon_plane.h"
#include "mesh/triangulate.h"
#include "report.h"
#include "seam_match.h"
#include "seam_pixels.h"
#include "threads/parallel.h"
#include "wrapatlas/bake.h"
#include "wrapatlas/model.h"

namespace wrapatlas::bench {
namespace {

enum Place : std::size_t { inside, beside_border, chart_border, atlas_border, kPlaces };
constexpr const char* kPlaceNames[] = {"inside charts", "of these, 2 to 6 texels from the border",
                                       "up to 1 texel from a chart's border",
                                       "up to 1 texel from the border of the atlas"};
constexpr int kLevels = 5;
constexpr std::size_t kStride = 16;  ///< pixels inside charts of which one is compared with borders
constexpr double kInside = 3;        ///< texels from a border: more than what is read for a pixel

/// A model with an atlas.
struct Atlas {
  Mesh low;  ///< triangles
  bool v_points_down = false;
  int side = 0;  ///< texels
};

/// Degrees, per place.
using Errors = std::array<std::vector<double>, kPlaces>;

void add_error(const Pixel& pixel, int level, double degrees, Errors& errors) {
  const double texel = std::exp2(level);
  const bool at_border = pixel.to_border < texel, at_atlas = pixel.to_atlas_border < texel;
  if (at_border) errors[chart_border].push_back(degrees);
  if (at_atlas && !at_border) errors[atlas_border].push_back(degrees);
  if (at_atlas || at_border) return;
  errors[inside].push_back(degrees);
  // Charts end where the surface bends: there it has more detail than elsewhere.
  const bool is_beside = pixel.to_border >= 2 * texel && pixel.to_border < 6 * texel;
  if (is_beside) errors[beside_border].push_back(degrees);
}

Vec3 read(const Atlas& atlas, Vec2 uv, const MipMaps& maps, int level, Wrap wrap = Wrap::uv) {
  if (!atlas.v_points_down) uv.y = 1 - uv.y;
  if (wrap == Wrap::none) {  // as a texture that does not repeat is looked up
    uv = {std::clamp(uv.x, 0.0, 1.0), std::clamp(uv.y, 0.0, 1.0)};
  }
  const TextureValue value = sample_trilinear(maps, uv, level, wrap);
  return unit(
      Vec3{2.0 * double(value[0]) - 1, 2.0 * double(value[1]) - 1, 2.0 * double(value[2]) - 1});
}

std::string summary(std::vector<double>& values) {
  if (values.empty()) return "- | - | 0";
  double sum = 0;
  for (const double value : values) sum += value;
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(0.99 * double(values.size() - 1));
  std::nth_element(values.begin(), high, values.end());
  return fmt::format("{:.4f} | {:.1f} | {}", sum / double(values.size()), *high, values.size());
}

void print_head(const char* title) {
  fmt::print(
      "\n{}\n\n| level | where | mean error, degrees | 99 % below | pixels |\n"
      "|---:|---|---:|---:|---:|\n",
      title);
}

void print_map(const Atlas& atlas, std::span<const Pixel> pixels, const Texture& map,
               const char* title, Wrap wrap) {
  const MipMaps maps = make_mip_maps(map, MipFilter::normals);
  print_head(title);
  for (int level = 0; level < kLevels; ++level) {
    Errors errors;
    for (const Pixel& pixel : pixels) {
      const Vec3 normal = read(atlas, pixel.uv, maps, level, wrap);
      add_error(pixel, level, degrees_between(normal, pixel.truth), errors);
    }
    for (std::size_t place = 0; place < kPlaces; ++place) {
      fmt::print("| {} | {} | {} |\n", level, kPlaceNames[place], summary(errors[place]));
    }
  }
}

Result<BakeResult> bake_normals(const Atlas& atlas, const BakeSource& source,
                                double bleed = kDefaultBleed) {
  BakeOptions options;
  options.width = options.height = atlas.side;
  options.v_points_down = atlas.v_points_down;
  options.bleed = bleed;
  const BakedMap maps[] = {BakedMap::object_normals};
  return bake(atlas.low, source, maps, options);
}

/// Nothing beyond the charts.
Texture undilated(const BakeResult& baked) {
  Texture bare = baked.maps.front();
  for (std::size_t i = 0; i < baked.inside.size(); ++i) {
    if (baked.inside[i] != 0) continue;
    std::fill_n(bare.values.data() + 3 * i, 3, 0.5F);
  }
  return bare;
}

/// 0 where a face has no UVs.
double area_in_uv(const Mesh& mesh) {
  const auto& corners = mesh.corner_texcoord;
  if (corners.empty() || std::count(corners.begin(), corners.end(), kNone) > 0) return 0;
  double area = 0;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const auto corner = texels_of(mesh, face, 1);
    area += std::abs(signed_area2(corner[0], corner[1], corner[2])) / 2;
  }
  return area;
}

bool are_same_surface(const Mesh& a, const Mesh& b) {
  if (a.corner_count() != b.corner_count()) return false;
  for (std::uint32_t c = 0; c < a.corner_count(); ++c) {
    if (!(a.positions[a.corner_position[c]] == b.positions[b.corner_position[c]])) return false;
  }
  return true;
}

/// An atlas of a surface, and what is read from it.
struct Cutting {
  const Atlas& atlas;
  MipMaps baked, bare;  ///< bare: nothing beyond the charts

  Cutting(const Atlas& of, const BakeResult& result)
      : atlas(of),
        baked(make_mip_maps(result.maps.front(), MipFilter::normals)),
        bare(make_mip_maps(undilated(result), MipFilter::normals)) {}

  [[nodiscard]] double error(const Pixel& pixel, const MipMaps& maps, int level) const {
    const Vec2 uv = uv_at(atlas.low, pixel.face, pixel.weights);
    return degrees_between(read(atlas, uv, maps, level), pixel.truth);
  }
};

/// The same places of a surface that was cut in two ways: where one atlas has the border of a chart
/// and the other the inside of one. `pixels` are of the first.
void print_pair(const Cutting& first, const Cutting& second, std::span<const Pixel> pixels) {
  const Atlas& other = second.atlas;
  const ChartBorders borders(other.low, other.side);
  std::vector<double> to_other_border;
  for (const Pixel& pixel : pixels) {
    const Vec2 texel = double(other.side) * uv_at(other.low, pixel.face, pixel.weights);
    to_other_border.push_back(borders.distance(pixel.face, texel));
  }
  print_head("The same places at a border in one atlas, inside a chart of the other");
  for (int level = 0; level < kLevels; ++level) {
    const double texel = std::exp2(level);
    std::vector<double> at_border, inside_charts, bare;
    std::size_t left_out = 0;  // where both atlases have a border near
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto [least, most] = std::minmax(pixels[i].to_border, to_other_border[i]);
      if (least >= texel) continue;
      if (most < kInside * texel) {
        ++left_out;
        continue;
      }
      const bool is_first = pixels[i].to_border < texel;
      const Cutting& cut = is_first ? first : second;
      const Cutting& whole = is_first ? second : first;
      at_border.push_back(cut.error(pixels[i], cut.baked, level));
      inside_charts.push_back(whole.error(pixels[i], whole.baked, level));
      bare.push_back(cut.error(pixels[i], cut.bare, level));
    }
    fmt::print("| {} | at the border of a chart | {} |\n", level, summary(at_border));
    fmt::print("| {} | the same places inside a chart of the other atlas | {} |\n", level,
               summary(inside_charts));
    fmt::print("| {} | at the border, nothing around charts | {} |\n", level, summary(bare));
    fmt::print("| {} | near borders of both, left out | - | - | {} |\n", level, left_out);
  }
}

/// All pixels at borders of charts beside the inside of charts where the surface bends as much
/// under the texels that are read.
void print_matched(const Cutting& cutting, std::span<const Pixel> pixels,
                   const Seamless& seamless) {
  print_head("Borders of charts, and the inside where the surface bends as much");
  for (int level = 0; level < kLevels; ++level) {
    const double texel = std::exp2(level);
    std::vector<const Pixel*> at_borders, inside_charts;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double least = std::min(pixels[i].to_border, pixels[i].to_atlas_border);
      if (pixels[i].to_border < texel) {
        at_borders.push_back(&pixels[i]);
      } else if (least >= kInside * texel && i % kStride == 0) {
        inside_charts.push_back(&pixels[i]);
      }
    }
    const auto errors = [&](std::span<const Pixel* const> chosen) {
      std::vector<PixelError> off(chosen.size());
      parallel_for(chosen.size(), thread_count(0), [&](std::size_t i) {
        const Pixel& pixel = *chosen[i];
        const Filtered filtered = seamless.at(pixel, level);
        off[i] = {cutting.error(pixel, cutting.baked, level),
                  cutting.error(pixel, cutting.bare, level),
                  degrees_between(filtered.normal, pixel.truth), filtered.spread};
      });
      return off;
    };
    const SpreadMatch match = match_by_spread(errors(at_borders), errors(inside_charts));
    const auto print = [&](const char* where, double mean, std::size_t count) {
      const std::string shown = count > 0 ? fmt::format("{:.4f}", mean) : "-";
      fmt::print("| {} | {} | {} | - | {} |\n", level, where, shown, count);
    };
    const MeanError &border = match.border, &inside = match.inside, &rest = match.without_match;
    print("at the border of a chart", border.map, border.pixels);
    print("there, by filtering alone", border.seamless, border.pixels);
    print("there, nothing around charts", border.bare, border.pixels);
    // The mean over the border's pixels of what there is inside for each.
    print("inside charts, where it bends as much", inside.map, border.pixels);
    print("inside, by filtering alone", inside.seamless, border.pixels);
    fmt::print("| {} | inside, of these classes | - | - | {} |\n", level, inside.pixels);
    print("at borders that bend as no inside", rest.map, rest.pixels);
    print("there, by filtering alone too", rest.seamless, rest.pixels);
  }
}

/// Says what is wrong, and 1.
int fail(const Error& error) {
  fmt::print(stderr, "{}\n", error.message());
  return 1;
}

}  // namespace

int bench_seams(const SeamBenchOptions& options) {
  const auto low = load_model(options.low), other = load_model(options.other),
             high = load_model(options.high);
  for (const auto* model : {&low, &other, &high}) {
    if (!*model) return fail(model->error());
  }
  const Atlas atlas{triangulated(low->mesh).mesh, low->v_points_down, options.resolution};
  Atlas second{triangulated(other->mesh).mesh, other->v_points_down, 0};
  const double area = area_in_uv(atlas.low), second_area = area_in_uv(second.low);
  if (!(area > 0 && second_area > 0)) {
    return fail({ErrorKind::input, "", "both atlases need UVs on all faces", ""});
  }
  if (!are_same_surface(atlas.low, second.low)) {
    return fail({ErrorKind::input, options.other, "is not the surface of " + options.low, ""});
  }
  // Texels of the same size, nearly: sides are halved for each level.
  const int halves = 1 << (kLevels - 1);
  const double side = options.resolution * std::sqrt(area / second_area);
  second.side = halves * static_cast<int>(std::lround(side / halves));

  const Triangulated high_triangles = triangulated(high->mesh);
  BakeSource source;
  source.mesh = &high->mesh;
  source.v_points_down = high->v_points_down;
  const auto baked = bake_normals(atlas, source), dilated = bake_normals(atlas, source, 0),
             second_baked = bake_normals(second, source);
  for (const auto* result : {&baked, &dilated, &second_baked}) {
    if (!*result) return fail(result->error());
  }
  const auto surface = HighSurface::build(high_triangles, source, -1, 1);
  if (!surface) return fail(surface.error());
  const auto walk = SurfaceWalk::build(atlas.low);
  if (!walk) return fail(walk.error());
  const Projection projection(atlas.low, *surface, baked->distance);
  RenderOptions view;
  view.views = options.views;
  view.size = options.size;
  const std::vector<Pixel> pixels = visible_pixels(atlas.low, projection, options.resolution, view);
  fmt::print("{} on {}: {} x {} texels, {} views of {} pixels\n", options.high, options.low,
             options.resolution, options.resolution, options.views, options.size);
  const Texture& map = baked->maps.front();
  print_map(atlas, pixels, map, "As baked, repeating", Wrap::uv);
  print_map(atlas, pixels, map, "Control: clamped instead of repeating", Wrap::none);
  print_map(atlas, pixels, undilated(*baked), "Control: nothing beyond the charts", Wrap::uv);
  print_map(atlas, pixels, dilated->maps.front(), "Control: dilated alone, without --bleed",
            Wrap::uv);
  const Seamless seamless(atlas.low, projection, *walk, options.resolution);
  const Cutting cutting(atlas, *baked);
  print_matched(cutting, pixels, seamless);
  print_pair(cutting, {second, *second_baked}, pixels);
  return 0;
}

}  // namespace wrapatlas::bench
