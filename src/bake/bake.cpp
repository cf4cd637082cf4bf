// What baking needs before it can begin: options that make sense, surfaces, a distance.
#include "wrapatlas/bake.h"

#include <fmt/format.h>

#include <algorithm>

#include "bake/baker.h"
#include "bake/drawable.h"
#include "mesh/triangulate.h"
#include "threads/parallel.h"

namespace wrapatlas {
namespace {

Error usage(const char* where, const char* what, const char* remedy) {
  return {ErrorKind::usage, where, what, remedy};
}

/// What comes beside the meshes, one entry for each of their parts.
Status check_arrays(const Mesh& low, const BakeSource& high, const BakeOptions& o) {
  const auto fits = [](std::size_t size, std::size_t wanted) {
    return size == 0 || size == wanted;
  };
  if (high.mesh == nullptr) return usage("high mesh", "there is none", "pass one");
  if (!fits(o.corner_normals.size(), low.corner_count()) ||
      !fits(high.corner_normals.size(), high.mesh->corner_count())) {
    return usage("corner normals", "not one for each corner", "pass one for each, or none");
  }
  if (!fits(o.corner_tangents.size(), low.corner_count())) {
    return usage("corner tangents", "not one for each corner", "pass one for each, or none");
  }
  if (!fits(high.corner_color.size(), high.mesh->corner_count())) {
    return usage("corner colours", "not one for each corner", "pass one for each, or none");
  }
  if (high.group_colors.empty()) return Done{};
  if (high.face_group.size() != high.mesh->face_count() ||
      *std::max_element(high.face_group.begin(), high.face_group.end()) >=
          high.group_colors.size()) {
    return usage("face groups", "not one of the groups for each face", "pass one for each");
  }
  return Done{};
}

Status check_options(const BakeSource& high, std::span<const BakedMap> maps, const BakeOptions& o) {
  if (Status size = check_texture_size(o.width, o.height); !size) return size;
  if (o.samples < 1 || o.samples > 16) return usage("samples", "not from 1 to 16", "2 is usual");
  if (!(o.distance >= 0) || !(o.occlusion_distance >= 0)) {
    return usage("distance", "less than 0", "0 chooses one");
  }
  if (!(o.bleed >= 0)) return usage("bleed", "less than 0", "0 leaves it to dilation");
  if (o.occlusion_rays < 1 || o.occlusion_rays > 65536) {
    return usage("occlusion rays", "not from 1 to 65536", "64 is usual");
  }
  if (maps.empty()) return usage("maps", "there are none to bake", "name one");
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (std::find(maps.begin(), maps.begin() + static_cast<std::ptrdiff_t>(i), maps[i]) !=
        maps.begin() + static_cast<std::ptrdiff_t>(i)) {
      return usage("maps", "one is asked for twice", "name each once");
    }
  }
  const bool color = std::find(maps.begin(), maps.end(), BakedMap::color) != maps.end();
  const bool textured =
      high.color != nullptr || std::any_of(high.group_colors.begin(), high.group_colors.end(),
                                           [](const GroupColor& of) { return of.maps != nullptr; });
  if (color && textured && high.mesh->texcoords.empty()) {
    return usage("color", "the high mesh has no UVs for its texture", "give both");
  }
  if (color && !textured && high.group_colors.empty() && high.corner_color.empty()) {
    return usage("color", "the high mesh has no colours", "give a texture, or some per corner");
  }
  return Done{};
}

int channels_of(BakedMap map, const BakeSource& high) {
  if (map == BakedMap::occlusion) return 1;
  return map == BakedMap::color && high.color != nullptr ? high.color->channels : 3;
}

/// Twice the largest distance of a point or a middle of a face to the high mesh.
double search_distance(const Mesh& low, const RayScene& scene) {
  double farthest = 0;
  const auto look = [&](const Vec3& place) {
    if (const auto point = scene.nearest_point(place)) {
      farthest = std::max(farthest, point->distance);
    }
  };
  std::vector<bool> seen(low.positions.size());
  for (const std::uint32_t i : low.corner_position) {
    if (!seen[i]) look(low.positions[i]);
    seen[i] = true;
  }
  for (std::uint32_t face = 0; face < low.face_count(); ++face) {
    look(point_at(triangle_of(low, face), {1.0 / 3, 1.0 / 3, 1.0 / 3}));
  }
  return std::max(2 * farthest, 1e-4 * scene.diagonal());
}

/// Where one mesh is a speck beside the other, numbers of 32 bits tell nothing apart.
Status check_places(const BakeResult& result, const RayScene& scene) {
  constexpr double kMost = 1e6, kLeast = 1e-150;
  const double times = result.extent / scene.diagonal();
  if (scene.diagonal() > kLeast && times < kMost) return Done{};
  return Error{ErrorKind::input, "high mesh",
               fmt::format("both meshes together are {:.2g} times as large", times),
               "bring them to one place and one size"};
}

void set_box(const Mesh& low, const Mesh& high, BakeResult& result) {
  Vec3 least{1e300, 1e300, 1e300}, most{-1e300, -1e300, -1e300};
  for (const Mesh* mesh : {&low, &high}) {
    for (const std::uint32_t i : mesh->corner_position) {
      const Vec3& p = mesh->positions[i];
      least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
  }
  const Vec3 size = most - least;
  const double longest = std::max({size.x, size.y, size.z});
  result.low_corner = least;
  result.extent = longest > 0 ? longest : 1;
}

/// Faces with a corner outside, as BakeResult counts them.
std::size_t count_outside(const Mesh& low, const BakeOptions& o) {
  const auto beyond = [](double at, int texels) {
    return at * texels < -1 || at * texels > texels + 1.0;
  };
  const auto is_outside = [&](std::uint32_t at) {
    if (at == kNone) return false;
    const Vec2 uv = low.texcoords[at];
    return (!wraps_u(o.wrap) && beyond(uv.x, o.width)) ||
           (!wraps_v(o.wrap) && beyond(uv.y, o.height));
  };
  std::size_t count = 0;
  for (std::size_t face = 0; face < low.face_count(); ++face) {
    const auto begin = low.corner_texcoord.begin();
    const bool outside =
        std::any_of(begin + low.face_begin[face], begin + low.face_begin[face + 1], is_outside);
    count += outside ? 1 : 0;
  }
  return count;
}

}  // namespace

Result<BakeResult> bake(const Mesh& low, const BakeSource& high, std::span<const BakedMap> maps,
                        const BakeOptions& options) {
  for (const Mesh* mesh : {&low, high.mesh}) {
    if (mesh != nullptr && mesh->face_count() == 0) {
      return Error{ErrorKind::input, mesh == &low ? "low mesh" : "high mesh", "it has no faces",
                   "export it again"};
    }
  }
  if (const Status ok = check_arrays(low, high, options); !ok) return ok.error();
  if (const Status ok = check_options(high, maps, options); !ok) return ok.error();
  const int threads = thread_count(options.threads);
  const Triangulated low_triangles = triangulated(low), high_triangles = triangulated(*high.mesh);
  BakeResult result;
  const TexelSamples samples(low_triangles.mesh, options.width, options.height, options.wrap,
                             options.v_points_down, options.samples);
  if (Status ok = check_samples(samples, low_triangles, "low mesh"); !ok) return ok.error();
  result.faces_without_uv = samples.faces_without_uv();
  result.faces_outside = count_outside(low_triangles.mesh, options);
  if (result.faces_without_uv == low_triangles.mesh.face_count()) {
    return Error{ErrorKind::input, "low mesh", "no face has UVs to bake on", "unwrap it first"};
  }
  const auto high_surface =
      HighSurface::build(high_triangles, high, options.high_hard_angle, threads);
  if (!high_surface) return high_surface.error();
  const LowSurface low_surface(
      low_triangles.mesh,
      corner_frames(low_triangles,
                    corner_normals(low_triangles, options.corner_normals, options.hard_angle),
                    options.corner_tangents, options.v_points_down));
  set_box(low, *high.mesh, result);
  if (Status ok = check_places(result, high_surface->scene()); !ok) return ok.error();
  result.distance = options.distance > 0
                        ? options.distance
                        : search_distance(low_triangles.mesh, high_surface->scene());
  for (const BakedMap map : maps) {
    result.maps.emplace_back(options.width, options.height, channels_of(map, high));
  }
  result.inside.assign(result.maps.front().texel_count(), 0);
  auto bleed = Bleed::build(low_triangles.mesh, samples, options.width, options.height,
                            options.wrap, options.bleed);
  if (!bleed) return bleed.error();
  Baker baker({low_surface, *high_surface, samples, *bleed, maps, options, result});
  if (!baker.run(threads)) return Error{ErrorKind::interrupted, "", "stopped", ""};
  if (result.texels_used == 0) {
    return Error{ErrorKind::input, "low mesh", "no face lies within the atlas",
                 "move its UVs into [0, 1], or let the atlas wrap"};
  }
  for (Texture& map : result.maps) dilate(map, baker.reached(), options.wrap, options.threads);
  return result;
}

}  // namespace wrapatlas
