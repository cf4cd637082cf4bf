// Seams: how far off a baked normal map is along the borders of charts and of the atlas, and how
// far inside charts, as seen in pictures of the model from around it; and at the same places of a
// second atlas, cut in another way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "commands.h"
#include "mesh/polygon_plane.h"
#include "mesh/triangulate.h"
#include "report.h"
#include "seam_pixels.h"
#include "wrapatlas/bake.h"
#include "wrapatlas/model.h"

namespace wrapatlas::bench {
namespace {

enum Place : std::size_t { inside, beside_border, chart_border, atlas_border, kPlaces };
constexpr const char* kPlaceNames[] = {"inside charts", "of these, 2 to 6 texels from the border",
                                       "up to 1 texel from a chart's border",
                                       "up to 1 texel from the border of the atlas"};
constexpr int kLevels = 5;
constexpr std::size_t kStride = 16;  ///< pixels of which one is compared with a map without seams

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
  return fmt::format("{:.2f} | {:.1f} | {}", sum / double(values.size()), *high, values.size());
}

void print_head(const char* title) {
  fmt::print(
      "\n{}\n\n| level | where | mean error, degrees | 99 % below | pixels |\n"
      "|---:|---|---:|---:|---:|\n",
      title);
}

/// `shown(pixel, level)` is a normal.
template <typename Shown>
void print_table(std::span<const Pixel> pixels, const char* title, std::size_t stride,
                 Shown&& shown) {
  print_head(title);
  for (int level = 0; level < kLevels; ++level) {
    Errors errors;
    for (std::size_t i = 0; i < pixels.size(); i += stride) {
      add_error(pixels[i], level, degrees_between(shown(pixels[i], level), pixels[i].truth),
                errors);
    }
    for (std::size_t place = 0; place < kPlaces; ++place) {
      fmt::print("| {} | {} | {} |\n", level, kPlaceNames[place], summary(errors[place]));
    }
  }
}

void print_map(const Atlas& atlas, std::span<const Pixel> pixels, const Texture& map,
               const char* title, Wrap wrap, std::size_t stride = 1) {
  const MipMaps maps = make_mip_maps(map, MipFilter::normals);
  print_table(pixels, title, stride, [&](const Pixel& pixel, int level) {
    return read(atlas, pixel.uv, maps, level, wrap);
  });
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
  constexpr double kInside = 3;  // texels from the border: more than what is read for a pixel
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
    fmt::print("| {} | inside a chart | {} |\n", level, summary(inside_charts));
    fmt::print("| {} | at the border, nothing around charts | {} |\n", level, summary(bare));
    fmt::print("| {} | near borders of both, left out | - | - | {} |\n", level, left_out);
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
  print_map(atlas, pixels, map, "As baked, the pixels of the next table", Wrap::uv, kStride);
  print_table(pixels, "Without any seams: the filter alone, on the surface itself", kStride,
              [&](const Pixel& pixel, int level) { return seamless.normal(pixel, level); });
  print_pair({atlas, *baked}, {second, *second_baked}, pixels);
  return 0;
}

}  // namespace wrapatlas::bench
