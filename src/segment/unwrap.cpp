// A bare mesh gets UVs: surface, charts, and the charts side by side.
#include "wrapatlas/unwrap.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "mesh/polygon_plane.h"
#include "segment/segment.h"

namespace wrapatlas {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Status check_options(const UnwrapOptions& options) {
  if (!(options.max_stretch >= 1)) {
    return Error{ErrorKind::usage, "max stretch", "no chart has less than 1",
                 "pass 1 or more; 2 is usual"};
  }
  if (!(options.max_extent >= 0)) {
    return Error{ErrorKind::usage, "max extent", "it cannot be negative",
                 "pass 0 for charts of any length; 0.8 to 2 is usual"};
  }
  if (options.flatten.iterations < 1 || options.flatten.iterations > kMostIterations) {
    return Error{ErrorKind::usage, "iterations", "it must be from 1 to 20", "leave it at 2"};
  }
  return Done{};
}

/// Puts charts side by side on shelves, so that no two have a UV in common. The whole is about as
/// wide as high.
class Shelves {
 public:
  /// `area`: of all charts.
  Shelves(Mesh& mesh, double area) : mesh_(mesh), width_(1.5 * std::sqrt(area)) {
    gap_ = width_ > 0 ? 1e-3 * width_ : 1;
    mesh_.texcoords.clear();
    mesh_.corner_texcoord.assign(mesh_.corner_count(), kNone);
  }

  /// Returns the index of the first of the points among the texcoords.
  std::uint32_t add(std::span<const Vec2> points) {
    Box2 box;
    for (const Vec2 p : points) box.add(p);
    const auto first = static_cast<std::uint32_t>(mesh_.texcoords.size());
    if (end_.x > 0 && end_.x + box.size().x > width_) {
      end_ = {0, end_.y + height_ + gap_};
      height_ = 0;
    }
    const Vec2 shift = end_ - box.min;
    for (const Vec2 p : points) mesh_.texcoords.push_back(p + shift);
    end_.x += box.size().x + gap_;
    height_ = std::max(height_, box.size().y);
    return first;
  }

 private:
  Mesh& mesh_;
  double width_, gap_;
  Vec2 end_;
  double height_ = 0;  ///< of the shelf in use
};

bool has_area(const Mesh& mesh, const Surface& surface) {
  const auto is_wide = [&](std::uint32_t face) { return polygon_normal(mesh, face) != Vec3{}; };
  return surface.report.flat_faces < surface.face_count() ||
         std::any_of(surface.folded_faces.begin(), surface.folded_faces.end(), is_wide);
}

double border_length(const CutChart& disc) {
  double sum = 0;
  for (std::uint32_t c = 0; c < disc.corner_point.size(); ++c) {
    if (disc.corner_twin[c] != kNone) continue;
    sum += length(disc.points[disc.corner_point[c]] - disc.points[disc.corner_point[disc.next(c)]]);
  }
  return sum;
}

double area_of(const CutChart& disc) {
  double sum = 0;
  for (const auto& [a, b, c] : disc.triangles) {
    sum += 0.5 * length(cross(disc.points[b] - disc.points[a], disc.points[c] - disc.points[a]));
  }
  return sum;
}

void add_draft(const Surface& surface, const Draft& draft, Shelves& shelves, Unwrapping& result) {
  const auto number = static_cast<std::uint32_t>(result.charts.size());
  result.charts.push_back({static_cast<std::uint32_t>(draft.faces.size()), area_of(draft.disc),
                           border_length(draft.disc), draft.distortion, draft.used_lscm,
                           draft.is_good});
  const std::vector<double> stretch =
      triangle_stretch(draft.disc.points, draft.uv, draft.disc.triangles);
  for (std::size_t t = 0; t < stretch.size(); ++t) {  // of a polygon the worst triangle
    const std::uint32_t face = surface.face_source[draft.faces[draft.disc.triangle_face[t]]];
    result.face_stretch[face] = std::max(result.face_stretch[face], stretch[t]);
  }
  const std::uint32_t first = shelves.add(draft.uv);
  for (std::size_t i = 0; i < draft.faces.size(); ++i) {
    const std::uint32_t face = draft.faces[i];
    result.face_chart[surface.face_source[face]] = number;
    for (std::uint32_t c = surface.face_begin[face]; c < surface.face_begin[face + 1]; ++c) {
      const std::uint32_t within = draft.disc.corner_begin[i] + c - surface.face_begin[face];
      result.mesh.corner_texcoord[surface.corner_source[c]] =
          first + draft.disc.corner_point[within];
    }
  }
}

/// A face that uses a point twice: as it lies in its plane, or a dot if it has no area.
void add_folded(std::uint32_t face, Shelves& shelves, Unwrapping& result) {
  const Mesh& mesh = result.mesh;
  const Vec3 normal = polygon_normal(mesh, face);
  const Plane plane(normal);
  const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
  std::vector<Vec2> flat;
  for (std::uint32_t c = begin; c < end; ++c) {
    flat.push_back(normal == Vec3{} ? Vec2{}
                                    : plane.project(mesh.positions[mesh.corner_position[c]]));
  }
  const std::uint32_t first = shelves.add(flat);
  for (std::uint32_t c = begin; c < end; ++c) {
    result.mesh.corner_texcoord[c] = first + c - begin;
  }
  result.face_chart[face] = static_cast<std::uint32_t>(result.charts.size());
  UnwrappedChart chart;
  chart.faces = 1;
  chart.area = 0.5 * length(normal);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    chart.border_length += length(flat[(i + 1) % flat.size()] - flat[i]);
  }
  result.charts.push_back(chart);
}

}  // namespace

double default_extent(Wrap wrap) { return wrap == Wrap::none ? 0.8 : 1.5; }

Result<Unwrapping> unwrap(const Mesh& mesh, const UnwrapOptions& options) {
  if (const Status ok = check_options(options); !ok) return ok.error();
  if (mesh.face_count() == 0) {
    return Error{ErrorKind::input, "mesh", "it has no faces", "export it again"};
  }
  Unwrapping result;
  const double start = seconds_now();
  auto surface = build_surface(mesh, options.surface);
  if (!surface) return surface.error();
  result.surface_seconds = seconds_now() - start;
  if (!has_area(mesh, *surface)) {
    return Error{ErrorKind::input, "mesh", "its faces have no area",
                 "export it again: the points of each face lie on one line"};
  }
  const auto cut = segment_surface(*surface, options);
  if (!cut) return cut.error();
  result.segment_seconds = seconds_now() - start - result.surface_seconds;

  result.flatten_seconds = cut->flatten_seconds;
  result.mesh = mesh;
  result.surface = surface->report;
  result.face_chart.assign(mesh.face_count(), kNone);
  result.face_stretch.assign(mesh.face_count(), 0);
  double area = 0;
  for (const Draft& draft : cut->charts) area += area_of(draft.disc);
  Shelves shelves(result.mesh, area);
  for (const Draft& draft : cut->charts) add_draft(*surface, draft, shelves, result);
  for (const std::uint32_t face : surface->folded_faces) add_folded(face, shelves, result);
  return result;
}

}  // namespace wrapatlas
