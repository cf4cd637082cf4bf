#include "segment/draft.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "charts/hull.h"
#include "mesh/polygon_plane.h"
#include "parameterize/untangle.h"
#include "segment/seams.h"

namespace wrapatlas {
namespace {

/// Parts that shrink to less than this share of their area get a seam.
constexpr double kShrunk = 0.25;
constexpr int kMostSeamRounds = 2;

/// More than this is split without a look: flattening it takes too long.
constexpr std::size_t kMostTried = 60000;

std::vector<std::uint32_t> merged(const std::vector<std::uint32_t>& a,
                                  const std::vector<std::uint32_t>& b) {
  std::vector<std::uint32_t> all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

void flatten_draft(Draft& draft, const UnwrapOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  draft.uv.clear();
  const auto flat = flatten_disc(draft.disc.points, draft.disc.triangles, options.flatten);
  if (flat) {
    draft.uv = flat->uv;
    untangle(draft.uv, draft.disc.triangles);
  }
  draft.flatten_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!flat) return;
  draft.used_lscm = flat->method == FlattenMethod::lscm;
  draft.distortion = measure_distortion(draft.disc.points, draft.uv, draft.disc.triangles);
}

bool is_unflipped(const Draft& draft) { return !draft.uv.empty() && draft.distortion.flipped == 0; }

bool within_limits(const Draft& draft, const UnwrapOptions& options) {
  return is_unflipped(draft) && !is_stretched(draft, options) &&
         !border_crosses(draft.uv, draft.disc.triangles);
}

/// Longer than a square atlas should have to hold; options.max_extent says when.
bool is_long(const Draft& draft, const FaceShapes& shapes, const UnwrapOptions& options) {
  if (options.max_extent == 0) return false;
  return square_side(convex_hull(draft.uv)) > options.max_extent * std::sqrt(shapes.whole_area);
}

/// A single face needs no solver: it is seen along its normal. Of no area it is a dot.
void lay_in_plane(const FaceShapes& shapes, const UnwrapOptions& options, Draft& draft) {
  const std::vector<Vec3>& points = draft.disc.points;
  const Plane plane(shapes.normal[draft.faces[0]]);
  for (const Vec3& p : points) draft.uv.push_back(plane.project(p - points[0]));
  double flat = 0, space = 0;
  for (const auto& [a, b, c] : draft.disc.triangles) {
    flat += signed_area2(draft.uv[a], draft.uv[b], draft.uv[c]);
    space += length(cross(points[b] - points[a], points[c] - points[a]));
  }
  const double scale = std::sqrt(space / flat);
  if (shapes.area[draft.faces[0]] == 0 || !std::isfinite(scale)) {
    draft.uv.assign(points.size(), {});
    draft.is_good = true;
    return;
  }
  for (Vec2& p : draft.uv) p = scale * p;
  draft.distortion = measure_distortion(points, draft.uv, draft.disc.triangles);
  draft.is_good = within_limits(draft, options);
}

}  // namespace

bool is_stretched(const Draft& draft, const UnwrapOptions& options) {
  constexpr double kRounding = 1e-9;  // a flat chart is good where no stretch is allowed
  const Distortion& found = draft.distortion;
  const double stretch = options.stretch == StretchMeasure::l2 ? found.l2 : found.linf;
  return is_unflipped(draft) && stretch > options.max_stretch * (1 + kRounding);
}

Draft make_draft(const Surface& surface, const Region& region, const FaceShapes& shapes,
                 std::vector<std::uint32_t> seams, const UnwrapOptions& options) {
  Draft draft;
  draft.faces = region.faces;
  draft.seams = std::move(seams);
  draft.disc = cut_to_disc(surface, region, shapes, draft.seams);
  if (draft.faces.size() == 1) {
    lay_in_plane(shapes, options, draft);
    return draft;
  }
  if (draft.disc.triangles.size() > kMostTried) return draft;
  if (draft.disc.is_closed) {
    draft.seams = merged(draft.seams, cut_open(surface, region, draft.disc));
    draft.disc = cut_to_disc(surface, region, shapes, draft.seams);
    if (draft.disc.is_closed) return draft;  // one edge joins two points that lie farthest apart
  }
  flatten_draft(draft, options);
  for (int round = 0; round < kMostSeamRounds; ++round) {
    if (draft.uv.empty()) break;
    if (is_unflipped(draft) && !is_stretched(draft, options)) break;
    const auto more = seams_to_shrunk(surface, region, draft.disc, draft.uv, kShrunk);
    if (more.empty()) break;
    draft.seams = merged(draft.seams, more);
    draft.disc = cut_to_disc(surface, region, shapes, draft.seams);
    flatten_draft(draft, options);
  }
  draft.is_good = within_limits(draft, options) && !is_long(draft, shapes, options);
  return draft;
}

}  // namespace wrapatlas
