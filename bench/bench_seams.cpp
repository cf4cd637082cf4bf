// Seams: how far off a baked normal map is along the borders of charts and of the atlas, and how
// far inside charts, as seen in pictures of the model from around it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bake/high_surface.h"
#include "bake/surface_walk.h"
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
constexpr std::size_t kStride = 16;  ///< pixels of which one is compared with a map without seams

/// What one pixel shows.
struct Pixel {
  Vec2 uv;
  std::uint32_t face = kNone;       ///< of the low mesh, and
  std::array<double, 3> weights{};  ///< the place on it
  Vec3 truth;                       ///< the high mesh's normal there
  double to_border = 0;             ///< of its chart, in texels of level 0
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

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

/// A place of the low mesh, and what the high one shows there.
class Projection {
 public:
  Projection(const Mesh& low, const HighSurface& high, double distance)
      : low_(low), high_(high), distance_(distance), normals_(smooth_normals(low)) {}

  [[nodiscard]] HighPoint find(std::uint32_t face, const std::array<double, 3>& weights) const {
    Vec3 normal;
    for (std::size_t k = 0; k < 3; ++k) {
      normal = normal + weights[k] * normals_[3 * std::size_t{face} + k];
    }
    return high_.find(point_at(triangle_of(low_, face), weights), unit(normal), distance_);
  }
  [[nodiscard]] Vec3 normal(const HighPoint& point) const { return high_.normal(point); }

 private:
  const Mesh& low_;
  const HighSurface& high_;
  double distance_;
  CornerVectors normals_;
};

std::array<Vec2, 3> texels_of(const Mesh& mesh, std::uint32_t face, int side) {
  std::array<Vec2, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = double(side) * mesh.texcoords[mesh.corner_texcoord[3 * std::size_t{face} + k]];
  }
  return corner;
}

/// What filtering alone leaves of the truth: the mean over the texels that are read for a pixel,
/// each of them where the surface has it, whatever chart that is on.
class Seamless {
 public:
  Seamless(const Mesh& low, const Projection& projection, const SurfaceWalk& walk, int side)
      : low_(low), projection_(projection), walk_(walk), side_(side) {}

  [[nodiscard]] Vec3 normal(const Pixel& pixel, int level) const {
    constexpr int kAcross = 4;  // samples of a texel
    const double texel = std::exp2(level);
    const Vec2 place = double(side_) * pixel.uv;
    const Vec2 first{std::floor(place.x / texel - 0.5), std::floor(place.y / texel - 0.5)};
    const Vec2 share = (1 / texel) * place - first - Vec2{0.5, 0.5};
    Vec3 sum;
    for (int i = 0; i < 4 * kAcross * kAcross; ++i) {
      const int column = i % (2 * kAcross), row = i / (2 * kAcross);
      const double weight =
          (column < kAcross ? 1 - share.x : share.x) * (row < kAcross ? 1 - share.y : share.y);
      const Vec2 at = first + (1.0 / kAcross) * Vec2{column + 0.5, row + 0.5};
      sum = sum + weight * seen_from(pixel, texel * at - place);
    }
    return unit(sum);
  }

 private:
  /// `by` in texels.
  [[nodiscard]] Vec3 seen_from(const Pixel& pixel, Vec2 by) const {
    const std::array<Vec2, 3> corner = texels_of(low_, pixel.face, side_);
    const Triangle t = triangle_of(low_, pixel.face);
    const WalkEnd end = walk_.go(pixel.face, pixel.weights, along_surface(t, corner, by));
    return projection_.normal(projection_.find(end.triangle, end.weights));
  }

  const Mesh& low_;
  const Projection& projection_;
  const SurfaceWalk& walk_;
  int side_;
};

std::vector<Pixel> visible_pixels(const Scene& scene, const Projection& projection,
                                  const SeamBenchOptions& options) {
  RenderOptions view;
  view.views = options.views;
  view.size = options.size;
  const Rendering rendering = render(scene.low, view);
  const int side = options.resolution;
  const ChartBorders borders(scene.low, side, side);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < rendering.face.size(); ++i) {
    const std::uint32_t face = rendering.face[i];
    if (face == kNone || rendering.covered[i] == 0) continue;
    const std::array<Vec2, 3> corner = texels_of(scene.low, face, side);
    const double area = signed_area2(corner[0], corner[1], corner[2]);
    if (area == 0) continue;
    const Vec2 texel = double(side) * rendering.uv[i];
    const double b = signed_area2(corner[2], corner[0], texel) / area;
    const double c = signed_area2(corner[0], corner[1], texel) / area;
    const std::array<double, 3> weights{1 - b - c, b, c};
    const HighPoint point = projection.find(face, weights);
    if (!point.by_ray) continue;
    const auto to_whole = [&](double t) { return std::abs(t - side * std::round(t / side)); };
    pixels.push_back({rendering.uv[i], face, weights, projection.normal(point),
                      borders.distance(face, texel),
                      std::min(to_whole(texel.x), to_whole(texel.y))});
  }
  return pixels;
}

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

Vec3 read(const Scene& scene, const Pixel& pixel, const MipMaps& maps, int level, Wrap wrap) {
  Vec2 uv{pixel.uv.x, scene.v_points_down ? pixel.uv.y : 1 - pixel.uv.y};
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

/// `shown(pixel, level)` is a normal.
template <typename Shown>
void print_table(const Scene& scene, const char* title, std::size_t stride, Shown&& shown) {
  fmt::print(
      "\n{}\n\n| level | where | mean error, degrees | 99 % below | pixels |\n"
      "|---:|---|---:|---:|---:|\n",
      title);
  for (int level = 0; level < kLevels; ++level) {
    Errors errors;
    for (std::size_t i = 0; i < scene.pixels.size(); i += stride) {
      const Pixel& pixel = scene.pixels[i];
      add_error(pixel, level, degrees_between(shown(pixel, level), pixel.truth), errors);
    }
    for (std::size_t place = 0; place < kPlaces; ++place) {
      fmt::print("| {} | {} | {} |\n", level, kPlaceNames[place], summary(errors[place]));
    }
  }
}

void print_map(const Scene& scene, const Texture& map, const char* title, Wrap wrap,
               std::size_t stride = 1) {
  const MipMaps maps = make_mip_maps(map, MipFilter::normals);
  print_table(scene, title, stride,
              [&](const Pixel& pixel, int level) { return read(scene, pixel, maps, level, wrap); });
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
  const Projection projection(scene.low, *surface, baked->distance);
  scene.pixels = visible_pixels(scene, projection, options);
  fmt::print("{} on {}: {} x {} texels, {} views of {} pixels\n", options.high, options.low,
             options.resolution, options.resolution, options.views, options.size);
  const Texture& map = baked->maps.front();
  print_map(scene, map, "As baked, repeating", Wrap::uv);
  print_map(scene, map, "Control: clamped instead of repeating", Wrap::none);
  Texture bare = map;
  for (std::size_t i = 0; i < baked->inside.size(); ++i) {
    if (baked->inside[i] != 0) continue;
    std::fill_n(bare.values.data() + 3 * i, 3, 0.5F);
  }
  print_map(scene, bare, "Control: nothing beyond the charts", Wrap::uv);
  bake_options.bleed = 0;
  const auto dilated = bake(scene.low, source, maps, bake_options);
  if (!dilated) return 1;
  print_map(scene, dilated->maps.front(), "Control: dilated alone, without --bleed", Wrap::uv);
  const auto walk = SurfaceWalk::build(scene.low);
  if (!walk) return 1;
  const Seamless seamless(scene.low, projection, *walk, options.resolution);
  print_map(scene, map, "As baked, the pixels of the next table", Wrap::uv, kStride);
  print_table(scene, "Without any seams: the filter alone, on the surface itself", kStride,
              [&](const Pixel& pixel, int level) { return seamless.normal(pixel, level); });
  return 0;
}

}  // namespace wrapatlas::bench
