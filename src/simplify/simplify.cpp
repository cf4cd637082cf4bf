// Lindstrom & Turk 1998: edges in the order of their cost, each collapsed to the point that
// placement.h says; costs of all edges that the new triangles touch are found anew.
#include "wrapatlas/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "simplify/collapse_mesh.h"
#include "simplify/creases.h"
#include "simplify/edge_queue.h"
#include "simplify/patch_geometry.h"
#include "simplify/placement.h"
#include "simplify/surface_triangles.h"
#include "simplify/uv_wedges.h"

namespace wrapatlas {
namespace {

constexpr std::uint32_t kStepsBetweenReports = 1024;

/// A power of two that brings all coordinates to about 1: exact, and no product overflows.
double scale_of(const std::vector<Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest > 0 ? std::exp2(-std::clamp(std::ilogb(largest), -500, 500)) : 1;
}

class Simplifier {
 public:
  Simplifier(const SurfaceTriangles& triangles, const Surface& surface,
             const SimplifyOptions& options)
      : triangles_(triangles),
        surface_(surface),
        options_(options),
        scale_(scale_of(surface.points)),
        mesh_(surface),
        geometry_(mesh_, surface.points, scale_),
        creases_(triangles.mesh, surface, mesh_, options.keep_uv_seams),
        queue_(mesh_.edge_numbers()),
        is_stale_(mesh_.edge_numbers(), 0),
        ring_mark_(mesh_.vertex_numbers(), 0) {
    if (options.keep_uv_seams) wedges_.emplace(triangles.mesh, surface, mesh_, creases_);
    report_.surface = surface.report;
    report_.dropped_faces = triangles.dropped;
    report_.faces_before = mesh_.face_count();
    report_.fixed_vertices = creases_.fixed_count();
    report_.volume_before = volume();
  }

  /// False: stopped by the caller.
  bool run() {
    const bool enough = mesh_.face_count() <= options_.target_faces;
    for (std::uint32_t e = 0; e < mesh_.edge_numbers() && !enough; ++e) price(e);
    for (std::uint32_t step = 0; mesh_.face_count() > options_.target_faces; ++step) {
      if (step % kStepsBetweenReports == 0 && !go_on()) return false;
      if (queue_.empty()) break;
      collapse_cheapest();
    }
    report_.faces_after = mesh_.face_count();
    report_.volume_after = volume();
    return true;
  }

  Simplification result() {
    Simplification made;
    made.report = report_;
    std::vector<std::uint32_t> place(mesh_.vertex_numbers(), kNone);
    std::vector<std::uint32_t> texcoord(wedges_ ? wedges_->count() : 0, kNone);
    for (std::uint32_t f = 0; f < mesh_.face_numbers(); ++f) {
      if (!mesh_.has_face(f)) continue;
      for (std::uint32_t c = 3 * f; c < 3 * f + 3; ++c) add_corner(c, place, texcoord, made.mesh);
      made.mesh.face_begin.push_back(static_cast<std::uint32_t>(made.mesh.corner_position.size()));
      const std::uint32_t source = surface_.face_source[f];
      made.face_source.push_back(triangles_.source[source]);
      const std::vector<std::uint32_t>& objects = triangles_.mesh.face_object;
      if (!objects.empty()) made.mesh.face_object.push_back(objects[source]);
    }
    return made;
  }

 private:
  [[nodiscard]] double volume() const { return geometry_.volume() / scale_ / scale_ / scale_; }

  [[nodiscard]] bool go_on() const {
    if (!options_.progress) return true;
    const double all = report_.faces_before - options_.target_faces;
    return options_.progress(
        {(report_.faces_before - mesh_.face_count()) / all, mesh_.face_count()});
  }

  void price(std::uint32_t edge) {
    const std::uint32_t c = mesh_.corner_of_edge(edge);
    is_stale_[edge] = 0;
    if (creases_.allow(mesh_, c)) {
      queue_.set(edge, place(mesh_, geometry_, c, creases_.is_seam()).cost);
    } else {
      queue_.remove(edge);
    }
  }

  /// Or takes its edge out of the queue, until something near it changes; or finds its cost anew.
  void collapse_cheapest() {
    const std::uint32_t edge = queue_.top(), c = mesh_.corner_of_edge(edge);
    if (is_stale_[edge] != 0) return price(edge);
    const Vec3 point = place(mesh_, geometry_, c, creases_.is_seam()).point;
    if (!may_collapse(c, point)) {
      queue_.remove(edge);
      ++report_.refused;
      return;
    }
    const std::uint32_t kept = mesh_.vertex(c);
    creases_.before_collapse(mesh_, c);
    if (wedges_) wedges_->apply(mesh_, c);
    for (const std::uint32_t gone : mesh_.collapse(c)) {
      if (gone != kNone) queue_.remove(gone);
    }
    geometry_.move(kept, point);
    price_around(kept);
  }

  [[nodiscard]] bool may_collapse(std::uint32_t c, const Vec3& point) {
    return mesh_.can_collapse(c) && !creases_.closes_chart(mesh_, c) &&
           !geometry_.spoils_triangle(c, point) &&
           (!wedges_ || wedges_->prepare(mesh_, geometry_, creases_, c, point));
  }

  /// The edges of the vertex and those between its neighbours at once; those farther out, of which
  /// one end's triangles have changed, when they become the cheapest.
  void price_around(std::uint32_t v) {
    ++ring_stamp_;
    ring_.clear();
    ring_mark_[v] = ring_stamp_;
    mesh_.each_edge(v, [&](std::uint32_t u, std::uint32_t c) {
      ring_.push_back(u);
      price(mesh_.edge(c));
    });
    for (const std::uint32_t u : ring_) ring_mark_[u] = ring_stamp_;
    for (const std::uint32_t u : ring_) {
      mesh_.each_edge(u, [&](std::uint32_t w, std::uint32_t c) {
        const std::uint32_t edge = mesh_.edge(c);
        if (ring_mark_[w] != ring_stamp_ && queue_.has(edge)) {
          is_stale_[edge] = 1;
        } else if (w != v && (ring_mark_[w] != ring_stamp_ || w < u)) {
          price(edge);
        }
      });
    }
  }

  void add_corner(std::uint32_t c, std::vector<std::uint32_t>& place,
                  std::vector<std::uint32_t>& texcoord, Mesh& mesh) const {
    const std::uint32_t v = creases_.first_at_point(mesh_.vertex(c));
    if (place[v] == kNone) {
      place[v] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(1 / scale_ * geometry_.position(v));
    }
    mesh.corner_position.push_back(place[v]);
    const std::uint32_t wedge = wedges_ ? wedges_->wedge(c) : kNone;
    if (wedge == kNone) {
      mesh.corner_texcoord.push_back(kNone);
      return;
    }
    if (texcoord[wedge] == kNone) {
      texcoord[wedge] = static_cast<std::uint32_t>(mesh.texcoords.size());
      mesh.texcoords.push_back(wedges_->uv(wedge));
    }
    mesh.corner_texcoord.push_back(texcoord[wedge]);
  }

  const SurfaceTriangles& triangles_;
  const Surface& surface_;
  const SimplifyOptions& options_;
  double scale_;
  CollapseMesh mesh_;
  PatchGeometry geometry_;
  Creases creases_;
  EdgeQueue queue_;
  std::optional<UvWedges> wedges_;
  std::vector<std::uint8_t> is_stale_;  ///< per edge
  std::vector<std::uint32_t> ring_, ring_mark_;
  std::uint32_t ring_stamp_ = 0;
  SimplifyReport report_;
};

}  // namespace

Result<Simplification> simplify(const Mesh& mesh, const SimplifyOptions& options) {
  const SurfaceTriangles triangles = surface_triangles(mesh);
  if (triangles.source.empty()) {
    return Error{ErrorKind::input, "", "no face has three points", "export the mesh again"};
  }
  const Result<Surface> surface = build_surface(triangles.mesh);
  if (!surface) return surface.error();
  Simplifier simplifier(triangles, *surface, options);
  if (!simplifier.run()) return Error{ErrorKind::interrupted, "", "stopped before the end", ""};
  return simplifier.result();
}

}  // namespace wrapatlas
