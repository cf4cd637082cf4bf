// Seams: how far off a baked normal map is along the borders of charts and of the atlas, and how
// far inside charts, as seen in pictures of the model from around it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bake/high_surface.h"
#include "commands.h"
#include "mesh/polygon_plane.h"
#include "mesh/triangulate.h"
#include "mesh/union_find.h"
#include "report.h"
#include "wrapatlas/bake.h"
#include "wrapatlas/model.h"
#include "wrapatlas/render.h"

namespace wrapatlas::bench {
namespace {

enum Place : std::size_t { inside, beside_border, chart_border, atlas_border, kPlaces };
constexpr const char* kPlaceNames[] = {"inside charts", "of these, 2 to 6 texels from the border",
                                       "up to 1 texel from a chart's border",
                                       "up to 1 texel from the border of the atlas"};
constexpr int kLevels = 5;

/// What one pixel shows.
struct Pixel {
  Vec2 uv;
  Vec3 truth;            ///< the high mesh's normal there
  double to_border = 0;  ///< of its chart, in texels of level 0
  double to_atlas_border = 0;
};

/// Per face its chart, and per chart the edges that bound it, in texels.
class ChartBorders {
 public:
  ChartBorders(const Mesh& mesh, int width, int height) : chart_(mesh.face_count()) {
    std::map<std::array<double, 4>, std::vector<std::uint32_t>> faces;
    const auto corner = [&](std::uint32_t c) {
      const Vec2 uv = mesh.texcoords[mesh.corner_texcoord[c]];
      return Vec2{width * uv.x, height * uv.y};
    };
    const auto key = [](Vec2 a, Vec2 b) {
      if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
      return std::array<double, 4>{a.x, a.y, b.x, b.y};
    };
    for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
      faces[key(corner(c), corner(c % 3 == 2 ? c - 2 : c + 1))].push_back(c / 3);
    }
    UnionFind sets(mesh.face_count());
    for (const auto& [edge, users] : faces) {
      for (const std::uint32_t face : users) sets.unite(users.front(), face);
    }
    for (std::uint32_t face = 0; face < chart_.size(); ++face) chart_[face] = sets.find(face);
    for (const auto& [edge, users] : faces) {
      if (users.size() > 1) continue;
      edges_[chart_[users.front()]].push_back({{edge[0], edge[1]}, {edge[2], edge[3]}});
    }
  }

  /// `place` in texels.
  [[nodiscard]] double distance(std::uint32_t face, Vec2 place) const {
    double least2 = 1e300;
    const auto found = edges_.find(chart_[face]);
    if (found == edges_.end()) return std::sqrt(least2);
    for (const auto& [a, b] : found->second) {
      const Vec2 ab = b - a, ap = place - a;
      const double size2 = dot(ab, ab);
      const double share = size2 > 0 ? std::clamp(dot(ap, ab) / size2, 0.0, 1.0) : 0;
      const Vec2 off = ap - share * ab;
      least2 = std::min(least2, dot(off, off));
    }
    return std::sqrt(least2);
  }

 private:
  std::vector<std::uint32_t> chart_;
  std::map<std::uint32_t, std::vector<std::pair<Vec2, Vec2>>> edges_;
};

struct Scene {
  Mesh low;  ///< triangles
  bool v_points_down = false;
  std::vector<Pixel> pixels;
};

std::vector<Pixel> visible_pixels(const Scene& scene, const HighSurface& high, double distance,
                                  const SeamBenchOptions& options) {
  RenderOptions view;
  view.views = options.views;
  view.size = options.size;
  const Rendering rendering = render(scene.low, view);
  const CornerVectors normals = smooth_normals(scene.low);
  const int side = options.resolution;
  const ChartBorders borders(scene.low, side, side);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < rendering.face.size(); ++i) {
    const std::uint32_t face = rendering.face[i];
    if (face == kNone || rendering.covered[i] == 0) continue;
    const Vec2 uv = rendering.uv[i];
    std::array<Vec2, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = scene.low.texcoords[scene.low.corner_texcoord[3 * std::size_t{face} + k]];
    }
    const double area = signed_area2(corner[0], corner[1], corner[2]);
    if (area == 0) continue;
    const double b = signed_area2(corner[2], corner[0], uv) / area;
    const double c = signed_area2(corner[0], corner[1], uv) / area;
    const std::array<double, 3> weights{1 - b - c, b, c};
    Vec3 place, normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = 3 * std::size_t{face} + k;
      place = place + weights[k] * scene.low.positions[scene.low.corner_position[at]];
      normal = normal + weights[k] * normals[at];
    }
    const HighPoint point = high.find(place, unit(normal), distance);
    if (!point.by_ray) continue;
    const Vec2 texel{side * uv.x, side * uv.y};
    const auto to_whole = [&](double t) { return std::abs(t - side * std::round(t / side)); };
    pixels.push_back({uv, high.normal(point), borders.distance(face, texel),
                      std::min(to_whole(texel.x), to_whole(texel.y))});
  }
  return pixels;
}

/// Degrees, per place.
using Errors = std::array<std::vector<double>, kPlaces>;

Errors errors_of(const Scene& scene, const MipMaps& maps, int level, Wrap wrap) {
  Errors errors;
  const double texel = std::exp2(level);
  for (const Pixel& pixel : scene.pixels) {
    const Vec2 uv{pixel.uv.x, scene.v_points_down ? pixel.uv.y : 1 - pixel.uv.y};
    Vec2 within = uv;
    if (wrap == Wrap::none) {  // as a texture that does not repeat is looked up
      within = {std::clamp(uv.x, 0.0, 1.0), std::clamp(uv.y, 0.0, 1.0)};
    }
    const TextureValue value = sample_trilinear(maps, within, level, wrap);
    const Vec3 normal = unit(
        Vec3{2.0 * double(value[0]) - 1, 2.0 * double(value[1]) - 1, 2.0 * double(value[2]) - 1});
    const double angle = std::atan2(length(cross(normal, pixel.truth)), dot(normal, pixel.truth));
    const double degrees = angle * 180 / std::numbers::pi;
    const bool at_border = pixel.to_border < texel, at_atlas = pixel.to_atlas_border < texel;
    if (at_border) errors[chart_border].push_back(degrees);
    if (at_atlas && !at_border) errors[atlas_border].push_back(degrees);
    if (at_atlas || at_border) continue;
    errors[inside].push_back(degrees);
    // Charts end where the surface bends: there it has more detail than elsewhere.
    const bool is_beside = pixel.to_border >= 2 * texel && pixel.to_border < 6 * texel;
    if (is_beside) errors[beside_border].push_back(degrees);
  }
  return errors;
}

std::string summary(std::vector<double>& values) {
  if (values.empty()) return "- | - | 0";
  double sum = 0;
  for (const double value : values) sum += value;
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(0.99 * double(values.size() - 1));
  std::nth_element(values.begin(), high, values.end());
  return fmt::format("{:.2f} | {:.1f} | {}", sum / double(values.size()), *high, values.size());
}

void print_table(const Scene& scene, const Texture& map, const char* title, Wrap wrap) {
  const MipMaps maps = make_mip_maps(map, MipFilter::normals);
  fmt::print(
      "\n{}\n\n| level | where | mean error, degrees | 99 % below | pixels |\n"
      "|---:|---|---:|---:|---:|\n",
      title);
  for (int level = 0; level < kLevels; ++level) {
    Errors errors = errors_of(scene, maps, level, wrap);
    for (std::size_t place = 0; place < kPlaces; ++place) {
      fmt::print("| {} | {} | {} |\n", level, kPlaceNames[place], summary(errors[place]));
    }
  }
}

}  // namespace

int bench_seams(const SeamBenchOptions& options) {
  const auto low = load_model(options.low), high = load_model(options.high);
  for (const auto* model : {&low, &high}) {
    if (*model) continue;
    fmt::print(stderr, "{}\n", model->error().message());
    return 1;
  }
  Scene scene{triangulated(low->mesh).mesh, low->v_points_down, {}};
  const Triangulated high_triangles = triangulated(high->mesh);
  BakeSource source;
  source.mesh = &high->mesh;
  source.v_points_down = high->v_points_down;
  BakeOptions bake_options;
  bake_options.width = bake_options.height = options.resolution;
  bake_options.v_points_down = low->v_points_down;
  const BakedMap maps[] = {BakedMap::object_normals};
  const auto baked = bake(scene.low, source, maps, bake_options);
  if (!baked) {
    fmt::print(stderr, "{}\n", baked.error().message());
    return 1;
  }
  const auto surface = HighSurface::build(high_triangles, source, -1, 1);
  if (!surface) return 1;
  scene.pixels = visible_pixels(scene, *surface, baked->distance, options);
  fmt::print("{} on {}: {} x {} texels, {} views of {} pixels\n", options.high, options.low,
             options.resolution, options.resolution, options.views, options.size);
  const Texture& map = baked->maps.front();
  print_table(scene, map, "As baked, repeating", Wrap::uv);
  print_table(scene, map, "Control: clamped instead of repeating", Wrap::none);
  Texture bare = map;
  for (std::size_t i = 0; i < baked->inside.size(); ++i) {
    if (baked->inside[i] != 0) continue;
    std::fill_n(bare.values.data() + 3 * i, 3, 0.5F);
  }
  print_table(scene, bare, "Control: nothing beyond the charts", Wrap::uv);
  return 0;
}

}  // namespace wrapatlas::bench
